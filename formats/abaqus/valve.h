// From the mesh of an Abaqus input file to the parts of a valve. Nodes are still those of InpMesh.
#pragma once

#include "formats/abaqus/load.h"
#include "formats/abaqus/properties.h"
#include "model/valve.h"

namespace mvs::core {

// Shells as triangles.
struct InpSheet {
  std::vector<Tri> triangles;         // wound as the file has them
  std::vector<uint32_t> element;      // of each triangle
  std::vector<uint32_t> section;      // of each triangle: index into InpProperties::shells
  std::vector<uint8_t> holds;         // 1: a node of a shell
  std::vector<uint32_t> annulus;      // the loop of the boundary that is prescribed all around
  std::vector<uint8_t> in_free_edge;  // 1: a node of another loop
};
InpSheet make_inp_sheet(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                        InpNotes &notes);

// A chain of trusses of one section whose inner nodes hold nothing else.
struct InpCable {
  uint32_t a, b;       // a: nearer a papillary head
  double rest_length;  // m: of all its trusses
  uint32_t section;    // index into InpProperties::trusses
  uint32_t element;    // its first truss
};
struct InpChordae {
  std::vector<InpCable> cables;
  std::vector<uint32_t> heads;  // in the order of the file
};
InpChordae make_inp_chordae(const InpMesh &mesh, const InpProperties &properties,
                            const InpLoad &load, const InpSheet &sheet, InpNotes &notes);

// All of it together, at rest, with the load of the file set.
Loaded build_inp_valve(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                       InpNotes &notes);

// The name of a leaflet: that of its set without "_Elements", "_Leaflet" and the like.
std::string inp_leaflet_name(std::string_view set);

// What materials are as laws of this library; fails for one that there is none for.
void set_inp_law(Leaflet &leaflet, const InpMaterial &material, InpNotes &notes);
void set_inp_law(Chord &chord, const InpMaterial &material);

}  // namespace mvs::core
