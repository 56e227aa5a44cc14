// Parts of the FEBio writer and its XML text. Units are mm, kPa, kg, s, mN.
//
// Feature names are those of the FEBio 4 sources and feature manual (github febiosoftware/FEBio,
// FEBioMech/FEBioMechModule.cpp; febiosoftware/febio-feature-manual).
#pragma once

#include <span>
#include <string>

#include "model/model.h"

namespace mvs::core {

inline constexpr double mm_per_m = 1e3, kpa_per_pa = 1e-3;

// Nested elements, indented by two blanks per level.
class FebText {
 public:
  // <name attributes>; `attributes` as `key="value"`.
  void open(std::string_view name, std::string_view attributes = "");
  void close(std::string_view name);
  // <name attributes>value</name>
  void leaf(std::string_view name, std::string_view value, std::string_view attributes = "");
  void leaf(std::string_view name, double value, std::string_view attributes = "");
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  size_t depth_ = 0;
};

// A number times 10^shift in the fewest digits; a plain decimal, without an exponent, for FEBio's
// formulas.
std::string feb_number(double value, int shift = 0);
std::string feb_plain(double value);
// Returns `key="text"` with reserved characters of XML escaped.
std::string feb_attribute(std::string_view key, std::string_view text);
// Returns comma-separated numbers times 10^shift.
std::string feb_list(std::span<const double> values, int shift = 0);

// The triangles of one leaflet with one thickness.
struct FebDomain {
  std::string name;
  uint32_t leaflet;
  double thickness;  // m
  std::vector<uint32_t> triangles;
};
std::vector<FebDomain> feb_domains(const Valve &valve);

// Writes one material per domain. MVS_E_UNSUPPORTED for a law without a counterpart in FEBio.
void write_feb_materials(const Valve &valve, const std::vector<FebDomain> &domains, FebText &out);
void write_feb_springs(const Valve &valve, FebText &out);
void write_feb_mesh(const Model &model, const std::vector<FebDomain> &domains, FebText &out);
// `boundary_fraction`: where held nodes go, from open to loaded.
void write_feb_mesh_data(const Model &model, const std::vector<FebDomain> &domains,
                         double boundary_fraction, FebText &out);

// Returns whether the law of a leaflet uses fibres.
bool feb_has_fibres(LeafletLawId law);

// Returns the prescribed nodes, ascending.
std::vector<uint32_t> feb_held(const Valve &valve);

}  // namespace mvs::core
