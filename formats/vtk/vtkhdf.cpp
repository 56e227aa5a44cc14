// PolyData as VTK HDF: one partition, with every kind of cells present even if empty.
#include <algorithm>
#include <utility>

#include "formats/vtk/polydata.h"

namespace mvs::core {
namespace {

std::vector<int64_t> one(size_t number) {
  return {static_cast<int64_t>(number)};
}

void add_cell_group(H5Tree &tree, const std::string &path, VtkCells cells) {
  std::vector<int64_t> offsets(cells.count + 1);
  for (size_t k = 0; k <= cells.count; ++k) {
    offsets[k] = static_cast<int64_t>(k * cells.nodes_each);
  }
  tree.arrays[path + "/NumberOfCells"] = {one(cells.count)};
  tree.arrays[path + "/NumberOfConnectivityIds"] = {one(cells.nodes.size())};
  tree.arrays[path + "/Offsets"] = {std::move(offsets)};
  tree.arrays[path + "/Connectivity"] = {std::move(cells.nodes)};
}

void add_arrays(H5Tree &tree, const std::string &path, std::vector<VtkArray> arrays) {
  for (VtkArray &array : arrays) {
    // a slash would create a group
    std::replace(array.name.begin(), array.name.end(), '/', '_');
    const uint32_t columns = array.components == 1 ? 0 : array.components;
    tree.arrays[path + "/" + array.name] = {std::move(array.values), columns};
  }
}

}  // namespace

void add_vtk_hdf(H5Tree &tree, VtkPolyData current) {
  const std::string group = "VTKHDF";
  tree.attributes[{group, "Version"}] = {"", {2, 1}};
  tree.attributes[{group, "Type"}] = {"PolyData"};
  tree.arrays[group + "/NumberOfPoints"] = {one(current.points.size() / 3)};
  tree.arrays[group + "/Points"] = {std::move(current.points), 3};
  add_cell_group(tree, group + "/Vertices", {});
  add_cell_group(tree, group + "/Lines", std::move(current.lines));
  add_cell_group(tree, group + "/Polygons", std::move(current.triangles));
  add_cell_group(tree, group + "/Strips", {});
  add_arrays(tree, group + "/FieldData", std::move(current.field_data));
  add_arrays(tree, group + "/PointData", std::move(current.point_data));
  add_arrays(tree, group + "/CellData", std::move(current.cell_data));
}

}  // namespace mvs::core
