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

TEST_CASE("only_whole_characters_are_utf8") {
  for (const char *text : {"", "abc", "\u00e9", "\u4e2d\u6587", "\U0001f600z", "a\x7f"}) {
    CAPTURE(text);
    CHECK(is_utf8(text));
  }
  // Latin-1, cut, overlong, half of a pair, beyond the last, a byte that follows nothing
  for (const char *text :
       {"\xe9", "\xe4\xb8", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\x80", "\u4e2d\xff"}) {
    CAPTURE(text);
    CHECK_FALSE(is_utf8(text));
  }
}

TEST_CASE("a_byte_order_mark_is_dropped_at_the_start_alone") {
  CHECK(without_byte_order_mark("\xef\xbb\xbfv 1") == "v 1");
  CHECK(without_byte_order_mark("\xef\xbb\xbf") == "");
  CHECK(without_byte_order_mark("v\xef\xbb\xbf") == "v\xef\xbb\xbf");
  CHECK(without_byte_order_mark("\xef\xbb") == "\xef\xbb");
}

TEST_CASE("a_long_text_loses_its_middle_and_no_part_of_a_character") {
  CHECK(without_middle("abcdefgh", 8) == "abcdefgh");
  CHECK(without_middle("abcdefghi", 8) == "ab...hi");
  std::string text;
  for (int k = 0; k < 40; ++k) text += "\u4e2d";
  for (size_t most = 10; most < text.size(); ++most) {
    const std::string cut = without_middle(text, most);
    CHECK(cut.size() <= most);
    CHECK(is_utf8(cut));
  }
}
