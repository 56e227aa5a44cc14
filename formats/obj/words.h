// Words of extended OBJ, shared by reader and writer; FORMAT.md defines them.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace mvs::core::obj {

// The version of the format. A file of another version is refused.
inline constexpr unsigned version = 1;

// Powers of ten of mm (lengths) and mm2 (areas), relative to m and m2.
inline constexpr int mm = 3, mm2 = 6;

// Indices are the numbers of ChordKind, RingKind and the laws, less one where those start at 1.
inline constexpr std::array<std::string_view, 8> chord_kinds = {
    "other", "marginal", "rough_zone", "strut", "basal", "commissural", "trunk", "suture"};
// Words of the laws, in the order of their numbers less one.
template <typename Laws>
std::vector<std::string_view> words_of(const Laws &laws) {
  std::vector<std::string_view> words;
  for (const auto &law : laws) words.push_back(law.word);
  return words;
}

inline constexpr std::array<std::string_view, 2> ring_kinds = {"ring", "band"};

}  // namespace mvs::core::obj
