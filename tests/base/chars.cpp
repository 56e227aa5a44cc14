// Decimal text of doubles: the C library's way, for standard libraries without to_chars of double,
// gives the same text and the same number as std::to_chars and std::from_chars.
#include "base/chars.h"

#include <doctest/doctest.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "base/bit_cast.h"

using namespace mvs::core;

namespace {

std::string shortest(double value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value, std::chars_format::scientific).ptr};
}

std::string of_c_library(double value) {
  char text[double_chars];
  return {text, c_library::double_to_chars(text, value)};
}

bool same_text_and_back(double value) {
  const std::string text = of_c_library(value);
  double back = 0;
  return text == shortest(value) && c_library::double_from_chars(text, back) &&
         bit_cast<uint64_t>(back) == bit_cast<uint64_t>(value);
}

}  // namespace

TEST_CASE("c_library_writes_and_reads_doubles_as_to_chars_does") {
  std::mt19937_64 random(7);
  int differing = 0;
  for (int k = 0; k < 100000; ++k) {
    const double value = std::abs(bit_cast<double>(random()));
    if (std::isfinite(value)) differing += !same_text_and_back(value);
  }
  // numbers with few digits, as people write them
  for (int k = 1; k < 100000; ++k) differing += !same_text_and_back(k * 1e-3);
  CHECK(differing == 0);
}

TEST_CASE("c_library_writes_powers_of_two_as_to_chars_does") {
  int differing = 0;
  for (int exponent = -1074; exponent < 1024; ++exponent) {
    differing += !same_text_and_back(std::ldexp(1.0, exponent));
  }
  CHECK(differing == 0);
}

TEST_CASE("c_library_refuses_what_is_no_decimal") {
  double value = 7;
  for (const std::string text :
       {"", "+1", " 1", "1 ", "0x10", "inf", "nan", "1e", "1e999", "--1", "1.2.3"}) {
    CAPTURE(text);
    CHECK_FALSE(c_library::double_from_chars(text, value));
  }
  CHECK(value == 7);
  CHECK(c_library::double_from_chars("-1.5e3", value));
  CHECK(value == -1500);
}
