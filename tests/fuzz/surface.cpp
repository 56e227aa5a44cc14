// Any bytes as a file of a surface or of landmarks, in each format: an error with a sentence, or
// points and triangles that are valid.
#include "formats/surface/surface_file.h"

#include "tests/fuzz/fuzz.h"

namespace {

void demand_valid(const mvs::core::SurfaceFile &file) {
  for (const mvs::core::Vec3 &point : file.points) demand(point.allFinite(), "a point is no place");
  for (const mvs::core::Tri &triangle : file.triangles) {
    for (const uint32_t corner : triangle)
      demand(corner < file.points.size(), "a corner is no point");
  }
  for (const mvs::core::SurfaceArray &array : file.arrays) {
    const size_t rows = array.on_points ? file.points.size() : file.triangles.size();
    demand(array.values.size() == rows * array.components, "an array has other rows");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view bytes(reinterpret_cast<const char *>(data), size);
  for (const char *name :
       {"a.stl", "a.ply", "a.obj", "a.off", "a.vtk", "a.vtp", "a.mrk.json", "a.fcsv", "a.csv"}) {
    try {
      demand_valid(mvs::core::read_surface_file(bytes, name, {mvs::core::LengthUnit::mm, {}}));
    } catch (const mvs::core::Error &error) {
      const bool is_known = error.code == MVS_E_FORMAT || error.code == MVS_E_UNSUPPORTED ||
                            error.code == MVS_E_ARGUMENT;
      demand(is_known, "an error of a kind that this reader does not make");
      demand(error.what()[0] != '\0', "an error without a sentence");
    }
  }
  return 0;
}
