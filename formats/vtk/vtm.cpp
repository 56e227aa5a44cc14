// VTK XML multiblock dataset: the valve and other surfaces and lines, each in a file of its own.
#include "formats/text/xml.h"
#include "formats/vtk/polydata.h"

namespace mvs::core {

std::vector<NamedFile> write_vtm(const std::string &stem, const Model &model, const State &state,
                                 const std::vector<VtpArray> &arrays,
                                 const std::vector<VtkBlock> &blocks) {
  std::vector<NamedFile> files;
  std::string index =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\">\n"
      "<vtkMultiBlockDataSet>\n";
  const auto add = [&](const std::string &name, std::string bytes) {
    const std::string path = stem + "/" + name + ".vtp";
    index += "<DataSet index=\"" + std::to_string(files.size()) + "\" name=\"" + name +
             "\" file=\"" + xml_escaped(path) + "\"/>\n";
    files.push_back({path, std::move(bytes)});
  };
  add("valve", write_vtp(model, state, arrays));
  for (const VtkBlock &block : blocks) add(block.name, vtp_text(make_vtk_polydata(block)));
  index += "</vtkMultiBlockDataSet>\n</VTKFile>\n";
  files.push_back({stem + ".vtm", std::move(index)});
  return files;
}

}  // namespace mvs::core
