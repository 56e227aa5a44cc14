// One small surface in every format that is read: a square of two triangles and a polygon of four
// corners beside it, in mm, with the array "label" of its points.
//
//   3 --- 2 --- 5
//   |  /  |     |     triangles 0 1 2, 0 2 3; polygon 1 4 5 2
//   0 --- 1 --- 4
#pragma once

#include <doctest/doctest.h>
#include <bit>
#include <cstring>
#include <string>
#include <vector>

#include "base/error.h"
#include "formats/surface/surface_file.h"
#include "formats/text/base64.h"

namespace mvs::core {

struct SurfaceSample {
  std::string name;  // with the ending that selects the reader
  std::string bytes;
};

// Coordinates that a float holds exactly, but a decimal of few digits as well.
inline const std::vector<Vec3> sample_points = {{-1.5, 0, 2},    {10, 0.25, 2},   {10, 12, -3.5},
                                                {-1.5, 12, 2.5}, {20, 0.5, 2.75}, {20, 12, 0.125}};
inline const std::vector<std::vector<uint32_t>> sample_polygons = {
    {0, 1, 2}, {0, 2, 3}, {1, 4, 5, 2}};
// The polygon of four corners as a fan.
inline const std::vector<Tri> sample_triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};

inline SurfaceFile read_sample(const SurfaceSample &sample, LengthUnit unit = LengthUnit::mm,
                               PatientFrame frame = PatientFrame::unknown) {
  return read_surface_file(sample.bytes, sample.name, {unit, frame});
}

// The error of a file that has to be refused.
inline Error refusal(const SurfaceSample &sample, LengthUnit unit = LengthUnit::mm) {
  try {
    read_sample(sample, unit);
  } catch (const Error &error) {
    return error;
  }
  FAIL("the file was read: ", sample.name);
  return {MVS_OK, "", ""};
}

inline std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The bytes of a number in little or big order.
template <typename Number>
std::string number_bytes(Number number, bool is_big = false) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (is_big == (std::endian::native == std::endian::little)) {
    return {bytes.rbegin(), bytes.rend()};
  }
  return bytes;
}

inline std::string decimal_text(double value) {
  return format("%.17g", value);
}

inline std::string point_lines() {
  std::string text;
  for (const Vec3 &p : sample_points) {
    text += decimal_text(p[0]) + " " + decimal_text(p[1]) + " " + decimal_text(p[2]) + "\n";
  }
  return text;
}

inline std::string polygon_lines() {
  std::string text;
  for (const auto &polygon : sample_polygons) {
    text += std::to_string(polygon.size());
    for (const uint32_t corner : polygon) text += " " + std::to_string(corner);
    text += "\n";
  }
  return text;
}

template <typename Number>
std::string point_bytes(bool is_big) {
  std::string bytes;
  for (const Vec3 &p : sample_points) {
    for (int c = 0; c < 3; ++c) bytes += number_bytes(static_cast<Number>(p[c]), is_big);
  }
  return bytes;
}

SurfaceSample stl_sample(bool is_binary, const std::string &title);
// "ascii", "binary_little_endian", "binary_big_endian"
SurfaceSample ply_sample(const std::string &coding);
SurfaceSample obj_sample();
SurfaceSample off_sample();
SurfaceSample vtk_sample(bool is_binary, bool is_version_5);
// "ascii", "binary", "raw", "base64"; the latter two are appended.
SurfaceSample vtp_sample(const std::string &coding, bool is_compressed = false);
SurfaceSample markups_sample();
SurfaceSample fcsv_sample();
SurfaceSample csv_sample();

// All of these in all their variants.
std::vector<SurfaceSample> surface_samples();
std::vector<SurfaceSample> landmark_samples();

}  // namespace mvs::core
