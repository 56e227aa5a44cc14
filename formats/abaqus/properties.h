// Properties of elements of an Abaqus input file: materials, sections, orientations.
#pragma once

#include "formats/abaqus/mesh.h"

namespace mvs::core {

struct InpMaterial {
  enum Law : uint32_t { none_given, elastic, neo_hookean, ogden, fung };
  std::string name;
  int32_t line = 0, law_line = 0;
  Law law = none_given;
  double density = 0;  // kg/m3; 0: not given
  // elastic: E, nu. neo-Hooke: mu. Ogden: mu1, alpha1, ... Fung: C0, C1, C2. Moduli in Pa.
  std::vector<double> constants;
};

// Local directions of elements; `of` holds the directions from a distribution.
struct InpOrientation {
  int32_t line = 0;
  std::array<Vec3, 2> otherwise = {Vec3::UnitX(), Vec3::UnitY()};
  std::map<uint32_t, std::array<Vec3, 2>> of;
  double angle = 0;                // rad, about the third direction
  Vec3 direction = Vec3::UnitX();  // of the fibres, in the rotated axes

  Vec3 fibre(uint32_t element) const;
};

struct InpSection {
  std::string name;  // of the set, as written
  int32_t line = 0;
  std::vector<uint32_t> elements;
  std::string material, orientation;  // labels; the orientation may be empty
  double size = 0;                    // m thickness of shells, m2 area of trusses
};

struct InpProperties {
  std::map<std::string, InpMaterial> materials;
  std::map<std::string, InpOrientation> orientations;
  std::vector<InpSection> shells, trusses;
};

InpProperties read_inp_properties(std::vector<InpCard> &cards, const InpMesh &mesh,
                                  InpNotes &notes);

// Parts of read_inp_properties.
void read_inp_materials(std::vector<InpCard> &cards, const InpUnits &units, InpProperties &into,
                        InpNotes &notes);
void read_inp_orientations(std::vector<InpCard> &cards, const InpMesh &mesh, InpProperties &into,
                           InpNotes &notes);
void read_inp_sections(std::vector<InpCard> &cards, const InpMesh &mesh, InpProperties &into,
                       InpNotes &notes);

}  // namespace mvs::core
