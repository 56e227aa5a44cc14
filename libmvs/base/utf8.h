// Texts that are cut to a length, without a part of a character (UTF-8, RFC 3629) at the cut.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace mvs::core {

// The bytes of a character that begins with a byte; 1 for a byte that begins none.
inline size_t utf8_length(char first) noexcept {
  const auto byte = static_cast<unsigned char>(first);
  return byte >= 0xf0 && byte < 0xf8 ? 4 : byte >= 0xe0 ? 3 : byte >= 0xc0 ? 2 : 1;
}

inline bool continues_utf8(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// How many of the first `most` bytes of a text are whole characters.
inline size_t whole_utf8(std::string_view text, size_t most) noexcept {
  if (text.size() <= most) return text.size();
  while (most > 0 && continues_utf8(text[most])) --most;
  return most;
}

// Copies a text, shortened to the array, whose rest becomes 0.
template <size_t size>
void copy_text(char (&to)[size], std::string_view from) noexcept {
  const size_t length = whole_utf8(from, size - 1);
  std::memcpy(to, from.data(), length);
  std::memset(to + length, 0, size - length);
}

// Without the beginnings of characters whose other bytes are missing: a printf precision cuts
// names anywhere.
inline std::string without_cut_characters(std::string text) {
  size_t kept = 0;
  for (size_t k = 0; k < text.size();) {
    const size_t length = utf8_length(text[k]);
    size_t there = 1;
    while (there < length && k + there < text.size() && continues_utf8(text[k + there])) ++there;
    if (there == length) {
      text.replace(kept, length, text, k, length);
      kept += length;
    }
    k += there;
  }
  text.resize(kept);
  return text;
}

}  // namespace mvs::core
