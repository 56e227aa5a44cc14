// Damaged files: truncated at every 7th byte, bytes changed at random with fixed seeds, words
// replaced. A reader gives a clean error, or a surface whose indices and coordinates are valid.
#include <cmath>
#include <random>

#include "tests/formats/surface/surface_samples.h"

using namespace mvs::core;

namespace {

std::vector<SurfaceSample> all_samples() {
  std::vector<SurfaceSample> samples = surface_samples();
  for (SurfaceSample &sample : landmark_samples()) samples.push_back(std::move(sample));
  return samples;
}

void check_surface(const SurfaceFile &file) {
  bool is_valid = !file.points.empty();
  for (const Vec3 &point : file.points) is_valid = is_valid && point.allFinite();
  for (const Tri &triangle : file.triangles) {
    for (const uint32_t corner : triangle) is_valid = is_valid && corner < file.points.size();
  }
  for (const SurfaceArray &array : file.arrays) {
    const size_t rows = array.on_points ? file.points.size() : file.triangles.size();
    is_valid = is_valid && array.values.size() == rows * array.components;
  }
  CHECK(is_valid);
  CHECK((file.point_names.empty() || file.point_names.size() == file.points.size()));
}

// Whether the file is read; checks the error or the surface.
bool is_read(const SurfaceSample &sample) {
  try {
    check_surface(read_sample(sample));
    return true;
  } catch (const Error &error) {
    const bool is_known = error.code == MVS_E_FORMAT || error.code == MVS_E_UNSUPPORTED ||
                          (error.code == MVS_E_ARGUMENT && error.part == "options.unit");
    CHECK(is_known);
    CHECK(error.what()[0] != '\0');
    return false;
  }
}

// Whether a truncated file has the whole surface. VTK legacy files do not state which sections
// follow: they may end behind one, with the points but without cells.
bool holds_all(const SurfaceSample &sample, size_t size) {
  const SurfaceFile whole = read_sample(sample);
  const SurfaceFile cut = read_sample({sample.name, sample.bytes.substr(0, size)});
  const bool ends_early = sample.name.ends_with(".vtk") && cut.triangles.empty();
  return cut.points.size() == whole.points.size() &&
         (cut.triangles == whole.triangles || ends_early);
}

}  // namespace

TEST_CASE("files_truncated_at_every_7th_byte_are_refused_or_whole") {
  for (const SurfaceSample &sample : all_samples()) {
    CAPTURE(sample.name);
    // tables and OBJ state no counts: a reader cannot see an end between two lines
    const bool has_counts = !sample.name.ends_with("csv") && !sample.name.ends_with(".obj");
    for (size_t size = 0; size < sample.bytes.size(); size += 7) {
      CAPTURE(size);
      const bool was_read = is_read({sample.name, sample.bytes.substr(0, size)});
      if (was_read && has_counts) CHECK(holds_all(sample, size));
    }
  }
}

TEST_CASE("files_with_changed_bytes_are_refused_or_valid") {
  for (const SurfaceSample &sample : all_samples()) {
    CAPTURE(sample.name);
    std::mt19937 random(20261124);
    for (int round = 0; round < 400; ++round) {
      SurfaceSample changed = sample;
      for (int flips = 1 + round % 4; flips > 0; --flips) {
        const size_t at = random() % changed.bytes.size();
        const char bytes[] = {static_cast<char>(random()), '9', '-', ' ', '\n', '\0'};
        changed.bytes[at] = bytes[random() % sizeof bytes];
      }
      is_read(changed);
    }
  }
}

TEST_CASE("files_with_parts_moved_are_refused_or_valid") {
  for (const SurfaceSample &sample : all_samples()) {
    CAPTURE(sample.name);
    std::mt19937 random(7);
    for (int round = 0; round < 200; ++round) {
      std::string bytes = sample.bytes;
      const size_t from = random() % bytes.size(), size = random() % 40,
                   to = random() % bytes.size();
      const std::string part = bytes.substr(from, size);
      if (round % 2 == 0) bytes.erase(from, size);
      is_read({sample.name, bytes.insert(std::min(to, bytes.size()), part)});
    }
  }
}

TEST_CASE("files_of_another_format_are_refused") {
  for (const SurfaceSample &sample : all_samples()) {
    for (const SurfaceSample &other : all_samples()) {
      const auto ending = [](const std::string &name) { return name.substr(name.rfind('.')); };
      if (ending(sample.name) == ending(other.name)) continue;
      is_read({"other" + ending(other.name), sample.bytes});
    }
  }
}
