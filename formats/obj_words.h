// The words of extended OBJ that reader and writer share. FORMAT.md says what they mean.
#pragma once

#include <array>
#include <string_view>

namespace mvs::obj {

// The version this library writes, and the newest it reads.
inline constexpr unsigned version = 2;

// Lengths are mm in the file and m in memory; areas go with the square.
inline constexpr int mm = 3, mm2 = 6;

// Indices are MVS_LEAFLET_*, MVS_CHORD_*, MVS_RING_*, less one where those start at 1.
inline constexpr std::array<std::string_view, 1> leaflet_laws = {"spring"};
inline constexpr std::array<std::string_view, 1> chord_laws = {"linear"};
inline constexpr std::array<std::string_view, 8> chord_kinds = {
    "other", "marginal", "rough_zone", "strut", "basal", "commissural", "trunk", "suture"};
inline constexpr std::array<std::string_view, 2> ring_kinds = {"ring", "band"};

}  // namespace mvs::obj
