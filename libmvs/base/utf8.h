// UTF-8 (RFC 3629): checks of texts, and texts that are cut without a part of a character at the
// cut.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace mvs::core {

// The length of the UTF-8 sequence at the start of a text; 0 for other bytes.
size_t utf8_length(std::string_view text);

// Returns whether a text is whole UTF-8 characters.
bool is_utf8(std::string_view text);

// Returns a text without the byte order mark that some programs write at its start.
inline std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

// How many of the first `most` bytes of a text are whole characters.
inline size_t whole_utf8(std::string_view text, size_t most) noexcept {
  if (text.size() <= most) return text.size();
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;
  return most;
}

// Copies a text, shortened to the array, whose rest becomes 0.
template <size_t size>
void copy_text(char (&to)[size], std::string_view from) noexcept {
  const size_t length = whole_utf8(from, size - 1);
  std::memcpy(to, from.data(), length);
  std::memset(to + length, 0, size - length);
}

// A text of more than `most` bytes with "..." in place of its middle.
std::string without_middle(std::string_view text, size_t most);

// Without the bytes that are not UTF-8, as those of a character that a printf precision cut.
std::string only_utf8(std::string_view text);

}  // namespace mvs::core
