// Nodes, shells, surfaces, springs, prescribed displacements and fibres of a FEBio model.
#include <algorithm>
#include <map>

#include "formats/febio/text.h"

namespace mvs::core {
namespace {

constexpr int mm_shift = 3;  // power of ten

std::string corners_of(const Tri &t) {
  return std::to_string(t[0] + 1) + "," + std::to_string(t[1] + 1) + "," + std::to_string(t[2] + 1);
}

std::string with_id(size_t number) {
  return "id=\"" + std::to_string(number) + "\"";
}

void write_nodes(const Valve &valve, FebText &out) {
  out.open("Nodes", "name=\"valve\"");
  for (size_t n = 0; n < valve.rest.size(); ++n) {
    const Vec3 &x = valve.rest[n];
    out.leaf("node", feb_list(std::array{x[0], x[1], x[2]}, mm_shift), with_id(n + 1));
  }
  out.close("Nodes");
}

void write_elements(const Valve &valve, const std::vector<FebDomain> &domains, FebText &out) {
  for (const FebDomain &domain : domains) {
    out.open("Elements", "type=\"tri3\" " + feb_attribute("name", domain.name));
    for (const uint32_t t : domain.triangles) {
      out.leaf("elem", corners_of(valve.triangles[t]), with_id(t + 1));
    }
    out.close("Elements");
  }
}

void write_surfaces(const Valve &valve, FebText &out) {
  out.open("Surface", "name=\"sheet\"");
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    out.leaf("tri3", corners_of(valve.triangles[t]), with_id(t + 1));
  }
  out.close("Surface");
  out.open("SurfacePair", "name=\"sheet with itself\"");
  out.leaf("primary", "sheet");
  out.leaf("secondary", "sheet");
  out.close("SurfacePair");
}

void write_sets(const Valve &valve, FebText &out) {
  std::string held;
  for (const uint32_t node : feb_held(valve)) {
    if (!held.empty()) held += ',';
    held += std::to_string(node + 1);
  }
  out.leaf("NodeSet", held, "name=\"held\"");
  for (const Chord &chord : valve.chords) {
    out.open("DiscreteSet", feb_attribute("name", chord.name));
    out.leaf("delem", std::to_string(chord.a + 1) + "," + std::to_string(chord.b + 1));
    out.close("DiscreteSet");
  }
}

void write_fibres(const Valve &valve, const FebDomain &domain, size_t number, FebText &out) {
  if (!feb_has_fibres(valve.leaflets[domain.leaflet].law)) return;
  out.open("ElementData", "name=\"fibre " + std::to_string(number + 1) + "\" " +
                              feb_attribute("elem_set", domain.name) + " data_type=\"vec3\"");
  for (size_t k = 0; k < domain.triangles.size(); ++k) {
    const Vec3 &fibre = valve.triangle_fibre[domain.triangles[k]];
    out.leaf("e", feb_list(std::array{fibre[0], fibre[1], fibre[2]}),
             "lid=\"" + std::to_string(k + 1) + "\"");
  }
  out.close("ElementData");
}

}  // namespace

std::vector<FebDomain> feb_domains(const Valve &valve) {
  std::map<std::pair<uint32_t, double>, size_t> known;
  std::vector<FebDomain> domains;
  for (uint32_t t = 0; t < valve.triangles.size(); ++t) {
    const uint32_t leaflet = valve.triangle_leaflet[t];
    const double thickness = valve.triangle_thickness[t];
    const auto [place, is_new] = known.emplace(std::pair(leaflet, thickness), domains.size());
    if (is_new) domains.push_back({valve.leaflets[leaflet].name, leaflet, thickness, {}});
    domains[place->second].triangles.push_back(t);
  }
  // a leaflet of several thicknesses: "A", "A, 1.2 mm", ...
  std::map<uint32_t, size_t> count;
  for (FebDomain &domain : domains) {
    if (++count[domain.leaflet] > 1)
      domain.name += ", " + feb_number(domain.thickness, mm_shift) + " mm";
  }
  return domains;
}

std::vector<uint32_t> feb_held(const Valve &valve) {
  std::vector<uint32_t> held = valve.annulus;
  for (const Head &head : valve.heads) held.push_back(head.node);
  std::sort(held.begin(), held.end());
  return held;
}

void write_feb_mesh(const Model &model, const std::vector<FebDomain> &domains, FebText &out) {
  const Valve &valve = model.valve;
  out.open("Mesh");
  write_nodes(valve, out);
  write_elements(valve, domains, out);
  write_surfaces(valve, out);
  write_sets(valve, out);
  out.close("Mesh");
}

// Prescribed displacements of held nodes, and fibres. `lid` counts from 1 within the set.
void write_feb_mesh_data(const Model &model, const std::vector<FebDomain> &domains,
                         double boundary_fraction, FebText &out) {
  const Valve &valve = model.valve;
  out.open("MeshData");
  const std::vector<uint32_t> held = feb_held(valve);
  for (int axis = 0; axis < 3; ++axis) {
    out.open("NodeData", std::string("name=\"held ") + "xyz"[axis] +
                             "\" node_set=\"held\" data_type=\"scalar\"");
    for (size_t k = 0; k < held.size(); ++k) {
      const double by = (model.target(held[k], boundary_fraction) - valve.rest[held[k]])[axis];
      out.leaf("node", feb_number(by, mm_shift), "lid=\"" + std::to_string(k + 1) + "\"");
    }
    out.close("NodeData");
  }
  for (size_t k = 0; k < domains.size(); ++k) write_fibres(valve, domains[k], k, out);
  out.close("MeshData");
}

}  // namespace mvs::core
