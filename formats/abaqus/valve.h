// Conversion of an Abaqus mesh to the parts of a valve. Node indices are those of InpMesh.
#pragma once

#include "formats/abaqus/load.h"
#include "formats/abaqus/properties.h"
#include "model/valve.h"

namespace mvs::core {

// Shell elements as triangles.
struct InpSheet {
  std::vector<Tri> triangles;         // with the node order of the file
  std::vector<uint32_t> element;      // of each triangle
  std::vector<uint32_t> section;      // of each triangle: index into InpProperties::shells
  std::vector<uint8_t> holds;         // 1: a node of a shell
  std::vector<uint32_t> annulus;      // the boundary loop whose nodes are all prescribed
  std::vector<uint8_t> in_free_edge;  // 1: a node of another boundary loop
};
InpSheet make_inp_sheet(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                        InpNotes &notes);

// A chain of trusses of one section whose inner nodes belong to no other element.
struct InpCable {
  uint32_t a, b;       // a: nearer a papillary head
  double rest_length;  // m, sum over its trusses
  uint32_t section;    // index into InpProperties::trusses
  uint32_t element;    // its first truss
};
struct InpChordae {
  std::vector<InpCable> cables;
  std::vector<uint32_t> heads;  // in the order of the file
};
InpChordae make_inp_chordae(const InpMesh &mesh, const InpProperties &properties,
                            const InpLoad &load, const InpSheet &sheet, InpNotes &notes);

// Builds the valve at rest, with the load of the file set.
Loaded build_inp_valve(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                       InpNotes &notes);

// The name of a leaflet: its set name without suffixes such as "_Elements" and "_Leaflet".
std::string inp_leaflet_name(std::string_view set);

// Converts a material to a law of libmvs; fails for a material without a corresponding law.
void set_inp_law(Leaflet &leaflet, const InpMaterial &material, InpNotes &notes);
void set_inp_law(Chord &chord, const InpMaterial &material);

}  // namespace mvs::core
