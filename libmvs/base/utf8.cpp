// UTF-8 sequences of RFC 3629.
#include "base/utf8.h"

#include <algorithm>

namespace mvs::core {

size_t utf8_length(std::string_view text) {
  const auto byte = [&](size_t k) {
    return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u;
  };
  const auto follows = [&](size_t count) {
    for (size_t k = 1; k <= count; ++k) {
      if ((byte(k) & 0xc0) != 0x80) return false;
    }
    return true;
  };
  const unsigned first = byte(0), second = byte(1);
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first <= 0xdf && follows(1)) return 2;
  if (first >= 0xe0 && first <= 0xef && follows(2)) {
    const bool overlong = first == 0xe0 && second < 0xa0, half = first == 0xed && second > 0x9f;
    return overlong || half ? 0 : 3;
  }
  if (first >= 0xf0 && first <= 0xf4 && follows(3)) {
    const bool overlong = first == 0xf0 && second < 0x90, beyond = first == 0xf4 && second > 0x8f;
    return overlong || beyond ? 0 : 4;
  }
  return 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string without_middle(std::string_view text, size_t most) {
  if (text.size() <= most) return std::string(text);
  const size_t half = (most - 3) / 2;
  size_t end = text.size() - half;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80) ++end;
  return std::string(text.substr(0, whole_utf8(text, half))) + "..." +
         std::string(text.substr(end));
}

std::string only_utf8(std::string_view text) {
  std::string kept;
  while (!text.empty()) {
    const size_t length = utf8_length(text);
    kept += text.substr(0, length);
    text.remove_prefix(std::max<size_t>(length, 1));
  }
  return kept;
}

}  // namespace mvs::core
