// What a text may hold that is shown and saved.
#pragma once

#include <algorithm>
#include <string_view>

namespace mvs::core {

// That no control character is in it.
inline bool is_plain_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

}  // namespace mvs::core
