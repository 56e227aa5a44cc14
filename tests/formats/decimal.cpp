// Decimal text: every double is read back bit for bit, at every shift of the decimal point.
#include <bit>
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>

#include "formats/text/decimal.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

std::string text_of(double value, int shift = 0) {
  std::string text;
  append_decimal(text, value, shift);
  return text;
}

bool comes_back(double value, int shift) {
  double back = 0;
  return parse_decimal(text_of(value, shift), back, shift) &&
         std::bit_cast<uint64_t>(back) == std::bit_cast<uint64_t>(value);
}

bool is_number(std::string_view text) {
  double value = 0;
  return parse_decimal(text, value);
}

}  // namespace

TEST_CASE("every_double_is_read_back_at_every_shift") {
  RandomBits random(1);
  size_t lost = 0;
  for (int k = 0; k < 1000000; ++k) {
    const double value = random.number();
    for (const int shift : {0, 3, 6}) lost += !comes_back(value, shift);
  }
  CHECK(lost == 0);
}

TEST_CASE("the_extremes_are_read_back_at_every_shift") {
  using Limits = std::numeric_limits<double>;
  for (const double value :
       {0.0, Limits::denorm_min(), Limits::min(), Limits::max(), 0.1, 1e-3, 1e3, 1e22, 1e23,
        9007199254740993.0, 0.3, 2.0 / 3, 123456789.123456789}) {
    for (const int shift : {-6, -3, 0, 3, 6}) {
      CAPTURE(value);
      CAPTURE(shift);
      CHECK(comes_back(value, shift));
      CHECK(comes_back(-value, shift));
    }
  }
}

TEST_CASE("multiplying_instead_of_shifting_would_lose_bits") {
  RandomBits random(2);
  size_t lost = 0;
  for (int k = 0; k < 10000; ++k) {
    const double metres = std::ldexp(static_cast<double>(random.bits() >> 11), -53);
    lost += metres * 1000 / 1000 != metres;
  }
  CHECK(lost > 0);
}

TEST_CASE("text_is_the_shortest_and_its_point_is_moved") {
  CHECK(text_of(0.0006, 3) == "0.6");
  CHECK(text_of(0.001, 3) == "1");
  CHECK(text_of(0.0123, 3) == "12.3");
  CHECK(text_of(-0.015, 3) == "-15");
  CHECK(text_of(7.853981633974483e-7, 6) == "0.7853981633974483");
  CHECK(text_of(40e6) == "40000000");
  CHECK(text_of(0.0) == "0");
  CHECK(text_of(-0.0, 3) == "-0");
  CHECK(text_of(1e-4) == "0.0001");
  CHECK(text_of(1e-5) == "1e-5");
  CHECK(text_of(1.5e-5) == "1.5e-5");
  CHECK(text_of(1e15) == "1000000000000000");
  CHECK(text_of(1e16) == "1e16");
  CHECK(text_of(std::numeric_limits<double>::denorm_min(), 3) == "5e-321");
  CHECK(text_of(std::numeric_limits<double>::max(), 3) == "1.7976931348623157e311");
}

TEST_CASE("other_notations_of_a_number_are_read") {
  struct Written {
    const char *text;
    double expected;
  };
  const Written all[] = {{"+1", 1},      {"1.", 1},
                         {".5", 0.5},    {"1E3", 1000},
                         {"1e+3", 1000}, {"1e-3", 0.001},
                         {"007", 7},     {"0e99999999999", 0},
                         {"-.5e1", -5},  {"0.000", 0},
                         {"1e-0", 1},    {"1000000000000000000000e-21", 1},
                         {"-0", -0.0},   {"5e-324", std::numeric_limits<double>::denorm_min()}};
  for (const Written &written : all) {
    CAPTURE(written.text);
    double value = -1;
    CHECK(parse_decimal(written.text, value));
    CHECK(std::bit_cast<uint64_t>(value) == std::bit_cast<uint64_t>(written.expected));
  }
}

TEST_CASE("text_that_is_not_a_number_is_refused") {
  for (const std::string text : {"",
                                 "-",
                                 "+",
                                 ".",
                                 "-.",
                                 "e5",
                                 "1e",
                                 "1e+",
                                 "1e-",
                                 "nan",
                                 "NaN",
                                 "inf",
                                 "-inf",
                                 "infinity",
                                 "0x10",
                                 "1,5",
                                 "1.2.3",
                                 "--1",
                                 "+-1",
                                 "-+1",
                                 "1e999",
                                 "-1e999",
                                 "1e-999",
                                 "1f",
                                 "1 ",
                                 " 1",
                                 "1e5.0",
                                 "1d3",
                                 "1e1e1",
                                 "1_000",
                                 "1e99999999999999999999",
                                 "1e-99999999999999999999"}) {
    CAPTURE(text);
    CHECK_FALSE(is_number(text));
  }
  CHECK_FALSE(is_number(std::string_view("1\0", 2)));
  CHECK(is_number(std::string(64, '1')));
  CHECK_FALSE(is_number(std::string(65, '1')));
}

TEST_CASE("the_locale_has_no_effect") {
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new Comma));
  const std::string c_before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char *name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"}) {
    if (std::setlocale(LC_NUMERIC, name)) break;
  }
  CHECK(text_of(1234567.5) == "1234567.5");
  CHECK(is_number("1234567.5"));
  CHECK_FALSE(is_number("1234567,5"));
  std::setlocale(LC_NUMERIC, c_before.c_str());
  std::locale::global(before);
}
