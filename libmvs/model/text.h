// Validity of texts that are displayed and saved.
#pragma once

#include <mvs/snapshot.h>

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace mvs::core {

// Bytes of the name of a part, a group or a checkpoint: mvs_part::name without its zero.
inline constexpr size_t name_limit = sizeof(mvs_part::name) - 1;

// Returns whether a text has no control character.
inline bool is_plain_text(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

}  // namespace mvs::core
