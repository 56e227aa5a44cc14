// Validity of texts that are displayed and saved.
#pragma once

#include <algorithm>
#include <string_view>

namespace mvs::core {

// Returns whether a text has no control character.
inline bool is_plain_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

}  // namespace mvs::core
