// Texts cut to a length keep whole characters.
#include "base/utf8.h"

#include <doctest/doctest.h>

#include "base/error.h"

using namespace mvs::core;

TEST_CASE("a_cut_text_ends_with_a_whole_character") {
  const std::string text = "a\u00e9\u20ac\U0001f600z";  // 1, 2, 3, 4 and 1 bytes
  const size_t whole[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 11, 11};
  for (size_t most = 0; most < std::size(whole); ++most) {
    CAPTURE(most);
    CHECK(whole_utf8(text, most) == whole[most]);
    CHECK(only_utf8(text.substr(0, most)) == text.substr(0, whole[most]));
  }
  char six[6];
  copy_text(six, text);
  CHECK(std::string(six) == "a\u00e9");
  CHECK(six[5] == 0);
}

TEST_CASE("a_name_that_printf_cuts_is_still_utf8") {
  CHECK(format("\"%.2s\" is long", "a\u00e9b") == "\"a\" is long");
  CHECK(format("\"%.3s\" is long", "a\u00e9b") == "\"a\u00e9\" is long");
  const std::string longest(2000, 'x');
  const std::string cut = format("%s", ("x" + std::string(3000, '\xc3')).c_str());
  CHECK(cut == "x");
  CHECK(format("%s", longest.c_str()).size() < longest.size());
}
