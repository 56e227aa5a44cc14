// A valve as VTK PolyData, for the VTP and HDF5 writers.
#pragma once

#include "formats/formats.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {

struct VtkArray {
  std::string name;
  uint32_t components;
  H5Values values;
};

// Cells as consecutive node indices.
struct VtkCells {
  size_t count = 0;
  uint32_t nodes_each = 0;
  std::vector<int64_t> nodes;
};

// In mm. Cell data has one row per line, then one per triangle: VTK orders lines before polygons.
// The lines of a valve are its chordae.
struct VtkPolyData {
  std::vector<double> points;
  VtkCells lines, triangles;
  std::vector<VtkArray> field_data, point_data, cell_data;
};

VtkPolyData make_vtk_polydata(const Model &model, const State &state,
                              const std::vector<VtpArray> &arrays);

std::string vtp_text(const VtkPolyData &current);
// Lines and triangles on points that are no nodes of the valve.
VtkPolyData make_vtk_polydata(const VtkBlock &block);

// Adds the PolyData as group VTKHDF of an HDF5 file (VTK HDF file format, version 2.1).
void add_vtk_hdf(H5Tree &tree, VtkPolyData current);

}  // namespace mvs::core
