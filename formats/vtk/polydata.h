// A valve as VTK's PolyData: what the VTP and the HDF5 file both show to other programs.
#pragma once

#include "formats/formats.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {

struct VtkArray {
  std::string name;
  uint32_t components;
  H5Values values;
};

// Cells by the nodes of each, one cell after the other.
struct VtkCells {
  size_t count = 0;
  uint32_t nodes_each = 0;
  std::vector<int64_t> nodes;
};

// In mm. Cell data has a row for each chord, then for each triangle: VTK has lines before polygons.
struct VtkPicture {
  std::vector<double> points;
  VtkCells chords, triangles;
  std::vector<VtkArray> field_data, point_data, cell_data;
};

VtkPicture make_vtk_picture(const Model &model, const State &state,
                            const std::vector<VtpArray> &arrays);

// The same as group VTKHDF of an HDF5 file (VTK HDF file format, version 2.1).
void add_vtk_hdf(H5Tree &tree, VtkPicture current);

}  // namespace mvs::core
