// The arrays of a .vtp file, decoded again. Python tests check that VTK and meshio read it.
#include <cstring>

#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

std::string base64_decoded(std::string_view text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  uint32_t group = 0;
  int bits = 0;
  for (const char c : text.substr(0, text.find('='))) {
    group = group << 6 | static_cast<uint32_t>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(group >> (bits -= 8) & 255);
  }
  return bytes;
}

// The numbers of the first array of this name after `section`.
template <typename Number>
std::vector<Number> array_of(const std::string &vtp, const std::string &section,
                             const std::string &name) {
  const size_t start = vtp.find("Name=\"" + name + "\"", vtp.find("<" + section + ">"));
  REQUIRE(start != std::string::npos);
  const size_t open = vtp.find('>', start) + 1;
  const std::string bytes = base64_decoded(vtp.substr(open, vtp.find('<', open) - open));
  uint64_t size = 0;
  REQUIRE(bytes.size() >= sizeof size);
  std::memcpy(&size, bytes.data(), sizeof size);
  REQUIRE(size == bytes.size() - sizeof size);
  std::vector<Number> numbers(size / sizeof(Number));
  if (size > 0) std::memcpy(numbers.data(), bytes.data() + sizeof size, size);
  return numbers;
}

}  // namespace

TEST_CASE("every_node_triangle_and_chord_is_in_the_vtp") {
  const Pair pair = moving_valve();
  const Valve &valve = pair.model.valve;
  const std::string vtp = write_vtp(pair.model, pair.state, {});
  const auto points = array_of<double>(vtp, "Points", "Points");
  const auto rest = array_of<double>(vtp, "PointData", "rest_mm");
  REQUIRE(points.size() == 3 * valve.rest.size());
  for (size_t k = 0; k < points.size(); ++k) {
    CHECK(points[k] == pair.state.x[k / 3][static_cast<int>(k % 3)] * 1e3);
    CHECK(rest[k] == valve.rest[k / 3][static_cast<int>(k % 3)] * 1e3);
  }
  const auto polygons = array_of<int64_t>(vtp, "Polys", "connectivity");
  REQUIRE(polygons.size() == 3 * valve.triangles.size());
  for (size_t k = 0; k < polygons.size(); ++k) CHECK(polygons[k] == valve.triangles[k / 3][k % 3]);
  const auto lines = array_of<int64_t>(vtp, "Lines", "connectivity");
  REQUIRE(lines.size() == 2 * valve.chords.size());
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    CHECK(lines[2 * c] == valve.chords[c].a);
    CHECK(lines[2 * c + 1] == valve.chords[c].b);
  }
  CHECK(array_of<int64_t>(vtp, "Polys", "offsets").back() == int64_t(polygons.size()));
  CHECK(array_of<int64_t>(vtp, "Lines", "offsets").back() == int64_t(lines.size()));
}

TEST_CASE("cell_arrays_list_chords_first") {
  const Pair pair = moving_valve();
  const Valve &valve = pair.model.valve;
  const size_t c = valve.chords.size(), m = valve.triangles.size();
  std::vector<double> values;
  for (size_t k = 0; k < 2 * (m + c); ++k) values.push_back(static_cast<double>(k));
  const std::string vtp = write_vtp(pair.model, pair.state, {{"a<b", false, 2, values}});
  const auto back = array_of<double>(vtp, "CellData", "a&lt;b");
  REQUIRE(back.size() == values.size());
  for (size_t k = 0; k < 2 * c; ++k) CHECK(back[k] == values[2 * m + k]);
  for (size_t k = 0; k < 2 * m; ++k) CHECK(back[2 * c + k] == values[k]);
  const auto lengths = array_of<double>(vtp, "CellData", "rest_length_mm");
  const auto ids = array_of<int64_t>(vtp, "CellData", "id");
  const auto scallops = array_of<int32_t>(vtp, "CellData", "scallop");
  for (size_t k = 0; k < c + m; ++k) {
    CHECK((lengths[k] == 0) == (k >= c));
    CHECK(uint64_t(ids[k]) ==
          (k < c ? valve.chords[k].id : valve.leaflets[valve.triangle_leaflet[k - c]].id));
    CHECK(scallops[k] == (k < c ? -1 : int32_t(valve.triangle_scallop[k - c])));
  }
}

TEST_CASE("arrays_of_the_wrong_length_are_refused") {
  const Pair pair = moving_valve();
  for (const bool on_points : {false, true}) {
    try {
      write_vtp(pair.model, pair.state, {{"short", on_points, 1, {1, 2, 3}}});
      CHECK(false);
    } catch (const Error &error) {
      CHECK(error.part == "short");
    }
  }
}
