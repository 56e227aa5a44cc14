// JSON values: written values are read back, and no input breaks the reader.
#include <doctest/doctest.h>

#include <limits>

#include "base/error.h"
#include "formats/text/json.h"

using namespace mvs::core;

namespace {

Json sample() {
  Json list = Json::array();
  list.add(0.1);
  list.add(uint64_t{18446744073709551615u});
  list.add(-1e-300);
  list.add("quoted \" and \n and ü");
  list.add(Json());
  return Json::object({{"list", list}, {"inner", Json::object({{"empty", Json::array()}})}});
}

}  // namespace

TEST_CASE("values_are_read_back_as_written") {
  for (const std::string &text : {sample().line(), sample().page()}) {
    const Json back = Json::parse(text);
    CHECK(back.line() == sample().line());
    CHECK(back["list"].items()[0].number() == 0.1);
    CHECK(back["list"].items()[1].whole() == 18446744073709551615u);
    CHECK(back["list"].items()[2].number() == -1e-300);
    CHECK(back["list"].items()[4].is_null());
    CHECK(back["inner"]["empty"].is_array());
    CHECK(back["nowhere"].is_null());
    CHECK_FALSE(back.has("nowhere"));
  }
}

TEST_CASE("a_record_is_one_line") {
  CHECK(sample().line().find('\n') == std::string::npos);
}

TEST_CASE("every_truncation_of_a_text_is_an_error_without_a_crash") {
  const std::string text = sample().page();
  for (size_t cut = 0; cut < text.size(); ++cut) {
    CAPTURE(cut);
    CHECK_THROWS_AS(Json::parse(std::string_view(text).substr(0, cut)), Error);
  }
}

TEST_CASE("unlimited_nesting_is_refused") {
  const std::string deep(1000000, '[');
  CHECK_THROWS_AS(Json::parse(deep), Error);
  CHECK_NOTHROW(Json::parse(std::string(60, '[') + std::string(60, ']')));
}

TEST_CASE("text_that_is_not_utf8_is_written_as_utf8") {
  const std::string line = Json(std::string("a\xff\xfe")).line();
  CHECK_NOTHROW(Json::parse(line));
}

TEST_CASE("of_a_repeated_key_the_first_place_and_the_last_value_count") {
  const Json json = Json::parse(R"({"a": 1, "b": 2, "a": 3, "c": {"d": 4, "d": 5}, "a": 6})");
  CHECK(json.line() == Json::parse(R"({"a": 6, "b": 2, "c": {"d": 5}})").line());
  CHECK_THROWS_WITH_AS(Json::parse(R"({"a": 1, "c": {"d": 4, "e": 0, "d": 5}})", true),
                       "an object of the JSON has \"d\" twice", Error);
  CHECK_NOTHROW(Json::parse(R"({"a": {"b": 1}, "b": {"a": 1}})", true));
  // in n log n: by a search for each of 300,000 keys this took minutes
  std::string text = "{";
  for (int k = 0; k < 300000; ++k) text += format("\"%d\": %d, ", k % 200000, k);
  const Json large = Json::parse(text + "\"end\": 0}");
  CHECK(large.members().size() == 200001);
  CHECK(large["7"].whole() == 200007);
  CHECK(large["150000"].whole() == 150000);
}
