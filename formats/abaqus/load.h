// Loads of an Abaqus input file: prescribed displacements, pressure, contact.
#pragma once

#include <optional>

#include "formats/abaqus/mesh.h"

namespace mvs::core {

// A surface: sides of shell elements.
struct InpSurface {
  int32_t line = 0;
  std::vector<std::pair<uint32_t, int>> faces;  // element; 1: the side its normal points to, or -1
};

struct InpLoad {
  std::map<uint32_t, Vec3> moved;       // m, by node, at the end of the last step
  std::map<uint32_t, double> pressure;  // Pa, by element, along the normal of its node order
  bool has_contact = false;
  // largest ratio of contact thickness to the shortest edge or diagonal; Abaqus reduces thicker
  // ones
  double max_ratio = 0.6;
};

InpLoad read_inp_load(std::vector<InpCard> &cards, const InpMesh &mesh, InpNotes &notes);

// Parts of read_inp_load.
using InpSurfaces = std::map<std::string, InpSurface>;
InpSurfaces read_inp_surfaces(std::vector<InpCard> &cards, const InpMesh &mesh, InpLoad &into,
                              InpNotes &notes);
void read_inp_contact(std::vector<InpCard> &cards, const InpUnits &units, InpLoad &into,
                      InpNotes &notes);

// The final value of each amplitude.
using InpAmplitudes = std::map<std::string, double>;
InpAmplitudes read_inp_amplitudes(std::vector<InpCard> &cards, InpNotes &notes);
double inp_factor(InpCard &card, const InpAmplitudes &amplitudes);

}  // namespace mvs::core
