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
