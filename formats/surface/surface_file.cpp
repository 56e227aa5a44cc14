// Selects the reader by the ending of a file's name.
#include "formats/surface/surface_file.h"

#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"

namespace mvs::core {
namespace {

struct SurfaceReader {
  std::string_view ending;
  SurfaceParts (*read)(std::string_view bytes);
};

constexpr SurfaceReader surface_readers[] = {
    {".stl", read_stl},   {".ply", read_ply},         {".obj", read_plain_obj},
    {".off", read_off},   {".vtp", read_vtp},         {".vtk", read_vtk_legacy},
    {".fcsv", read_fcsv}, {".csv", read_point_table}, {".json", read_mrk_json},
};

}  // namespace

SurfaceFile read_surface_file(std::string_view bytes, std::string_view name,
                              const SurfaceFileOptions &options) {
  const std::string small = in_small_letters(name);
  for (const SurfaceReader &reader : surface_readers) {
    if (small.ends_with(reader.ending)) return finished_surface(reader.read(bytes), options);
  }
  fail(MVS_E_ARGUMENT, "path",
       "the ending names no format of surfaces or points: known are .stl, .ply, .obj, .off, .vtk, "
       ".vtp, .mrk.json, .fcsv and .csv");
}

}  // namespace mvs::core
