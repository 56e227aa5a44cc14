// Selects the reader by the ending of a file's name.
#include "formats/surface/surface_file.h"

#include "base/error.h"
#include "formats/formats.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"

namespace mvs::core {
namespace {

struct SurfaceReader {
  std::string_view ending;
  SurfaceParts (*read)(std::string_view bytes);
  size_t most_bytes;
};

// Fields of tables and values of JSON take up to 50 times their bytes in memory, numbers 8 times.
constexpr size_t most_text = size_t{16} << 20;

constexpr SurfaceReader surface_readers[] = {
    {".stl", read_stl, max_file_bytes},       {".ply", read_ply, max_file_bytes},
    {".obj", read_plain_obj, max_file_bytes}, {".off", read_off, max_file_bytes},
    {".vtp", read_vtp, max_file_bytes},       {".vtk", read_vtk_legacy, max_file_bytes},
    {".fcsv", read_fcsv, most_text},          {".csv", read_point_table, most_text},
    {".json", read_mrk_json, most_text},
};

// The way in for files that are no surfaces.
const char *hint_for(std::string_view small) {
  for (const char *ending : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".dcm"}) {
    if (small.ends_with(ending)) return "; images and label maps are for mvs-image";
  }
  for (const char *ending : {".inp", ".h5", ".vtm", ".vtkhdf"}) {
    if (small.ends_with(ending)) return "; a file of a whole valve needs no import: mvs close FILE";
  }
  return "";
}

}  // namespace

SurfaceFile read_surface_file(std::string_view bytes, std::string_view name,
                              const SurfaceFileOptions &options) {
  const std::string small = in_small_letters(name);
  for (const SurfaceReader &reader : surface_readers) {
    if (!small.ends_with(reader.ending)) continue;
    MVS_MUST(!bytes.empty(), MVS_E_FORMAT, "path", "the file is empty");
    MVS_MUST(bytes.size() <= reader.most_bytes, MVS_E_MEMORY, "path",
             "the file has %zu bytes, the limit of this format is %zu", bytes.size(),
             reader.most_bytes);
    return finished_surface(reader.read(bytes), options);
  }
  fail(MVS_E_ARGUMENT, "path",
       "the ending names no format of surfaces or points: known are .stl, .ply, .obj, .off, .vtk, "
       ".vtp, .mrk.json, .fcsv and .csv%s",
       hint_for(small));
}

}  // namespace mvs::core
