// The words of extended OBJ that reader and writer share. FORMAT.md says what they mean.
#pragma once

#include <array>
#include <string_view>
#include <vector>

namespace mvs::core::obj {

// The newest version that this library reads. It writes the oldest that has all there is to write:
// only a valve in motion needs version 4.
inline constexpr unsigned version = 4, version_at_rest = 3;

// Lengths are mm in the file and m in memory; areas go with the square.
inline constexpr int mm = 3, mm2 = 6;

// Indices are MVS_LEAFLET_LAW_*, MVS_CHORD_KIND_*, MVS_RING_KIND_*, less one where those start
// at 1.
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
