// *MATERIAL with the laws that leaflets and chordae can have.
#include <algorithm>

#include "formats/abaqus/properties.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// Returns all numbers of a card; a missing number is 0, as in Abaqus.
std::vector<double> numbers_of(const InpCard &card) {
  constexpr size_t most = 64;
  std::vector<double> numbers;
  for (size_t k = 0; k < card.data.size(); ++k) {
    InpRow row = card.row(k);
    while (!row.at_end()) numbers.push_back(row.number("a constant", 0, 0.0));
    if (numbers.size() > most)
      inp_fail(row.line(), "*%s has too many constants", card.keyword.c_str());
  }
  return numbers;
}

void need_constants(const InpCard &card, const std::vector<double> &numbers, size_t count) {
  if (numbers.size() >= count) return;
  inp_fail(card.line, "*%s has %zu constants, it needs %zu", card.keyword.c_str(), numbers.size(),
           count);
}

// The conversion to Pa multiplies by a power of ten and rounds once, which fitted constants allow.
double in_pascal(double value, const InpUnits &units) {
  for (int k = units.stress; k < 0; ++k) value *= 10;
  for (int k = units.stress; k > 0; --k) value /= 10;
  return value;
}

void read_density(InpCard &card, const InpUnits &units, InpMaterial &material) {
  if (card.data.empty()) inp_fail(card.line, "*DENSITY has no number");
  material.density = card.row(0).number("a density", units.density());
}

void read_elastic(InpCard &card, const InpUnits &units, InpMaterial &material) {
  const std::string type = inp_label(card.take("TYPE").value_or("ISOTROPIC"));
  if (!type.starts_with("ISO")) {
    inp_fail(card.line, "*ELASTIC, TYPE=%s is not read: leaflets and chordae take ISOTROPIC",
             quoted(type).c_str());
  }
  std::vector<double> numbers = numbers_of(card);
  need_constants(card, numbers, 1);
  numbers.resize(2);
  material.law = InpMaterial::elastic;
  material.constants = {in_pascal(numbers[0], units), numbers[1]};
}

// *HYPERELASTIC, NEO HOOKE: C10, D1 of W = C10 (I1 - 3) + ..., so that mu = 2 C10.
void read_neo_hooke(const InpCard &card, const InpUnits &units, InpMaterial &material,
                    InpNotes &notes) {
  const std::vector<double> numbers = numbers_of(card);
  need_constants(card, numbers, 1);
  material.law = InpMaterial::neo_hookean;
  material.constants = {2 * in_pascal(numbers[0], units)};
  if (numbers.size() > 1 && numbers[1] != 0) {
    notes.left_out(card.line,
                   "D1 of *HYPERELASTIC, NEO HOOKE is left out: tissue is incompressible");
  }
}

// mu_1, alpha_1 ... mu_N, alpha_N, D_1 ... D_N of W = sum 2 mu_k / alpha_k^2 (l1^alpha_k +
// l2^alpha_k + l3^alpha_k - 3) + ...
void read_ogden(InpCard &card, const InpUnits &units, InpMaterial &material, InpNotes &notes) {
  InpRow order(card.take("N").value_or("1"), card.line);
  const uint64_t terms = order.whole("N");
  if (terms < 1 || terms > 3) inp_fail(card.line, "*HYPERELASTIC, OGDEN is read with N=1 to 3");
  std::vector<double> numbers = numbers_of(card);
  need_constants(card, numbers, 2 * terms);
  const auto volumetric = numbers.begin() + static_cast<std::ptrdiff_t>(2 * terms);
  if (std::any_of(volumetric, numbers.end(), [](double d) { return d != 0; })) {
    notes.left_out(card.line,
                   "D1 ... of *HYPERELASTIC, OGDEN are left out: tissue is incompressible");
  }
  numbers.resize(2 * terms);
  for (size_t k = 0; k < numbers.size(); k += 2) numbers[k] = in_pascal(numbers[k], units);
  material.law = InpMaterial::ogden;
  material.constants = std::move(numbers);
}

void read_hyperelastic(InpCard &card, const InpUnits &units, InpMaterial &material,
                       InpNotes &notes) {
  if (card.take("TEST DATA INPUT")) {
    inp_fail(card.line, "*HYPERELASTIC from test data is not read: give the constants");
  }
  if (card.take("NEO HOOKE")) return read_neo_hooke(card, units, material, notes);
  if (card.take("OGDEN")) return read_ogden(card, units, material, notes);
  const std::string law = card.parameters.empty() ? "" : card.parameters[0].key;
  inp_fail(card.line, "*HYPERELASTIC, %s is not read: known are NEO HOOKE and OGDEN",
           quoted(law).c_str());
}

// The user material of the Texas TriValve (Mathur et al. 2022): C0, bulk modulus, C1, C2 of W = C0
// / 2 (I1 - 3) + C1 / 2 (exp(C2 (I1 - 3)^2) - 1).
void read_user_material(InpCard &card, const InpUnits &units, InpMaterial &material,
                        InpNotes &notes) {
  const bool user = card.take("USER").has_value();
  for (const char *key : {"FORMULATION", "LOCAL DIRECTIONS", "TYPE"}) card.take(key);
  InpRow count(card.take("PROPERTIES").value_or("0"), card.line);
  if (!user || count.whole("PROPERTIES") != 4) {
    inp_fail(card.line,
             "*ANISOTROPIC HYPERELASTIC is read as USER, PROPERTIES=4 alone: C0, bulk modulus, C1, "
             "C2 of W = C0/2 (I1-3) + C1/2 (exp(C2 (I1-3)^2) - 1)");
  }
  const std::vector<double> numbers = numbers_of(card);
  need_constants(card, numbers, 4);
  material.law = InpMaterial::fung;
  material.constants = {in_pascal(numbers[0], units), in_pascal(numbers[2], units), numbers[3]};
  notes.left_out(card.line,
                 "the bulk modulus of a user material is left out: tissue is "
                 "incompressible");
}

using MaterialReader = void (*)(InpCard &, const InpUnits &, InpMaterial &, InpNotes &);
MaterialReader reader_of(const InpCard &card) {
  if (card.is("ELASTIC")) {
    return [](InpCard &c, const InpUnits &u, InpMaterial &m, InpNotes &) { read_elastic(c, u, m); };
  }
  if (card.is("HYPERELASTIC")) return read_hyperelastic;
  if (card.is("ANISOTROPIC HYPERELASTIC")) return read_user_material;
  return nullptr;
}

InpMaterial &add_material(InpCard &card, InpProperties &into) {
  card.used = true;
  const std::string label = card.need("NAME");
  InpMaterial &material = into.materials[label];
  if (material.line != 0) {
    inp_fail(card.line, "material %s stands in line %d already", quoted(label).c_str(),
             material.line);
  }
  material.name = label;
  material.line = card.line;
  return material;
}

}  // namespace

void read_inp_materials(std::vector<InpCard> &cards, const InpUnits &units, InpProperties &into,
                        InpNotes &notes) {
  InpMaterial *material = nullptr;
  for (InpCard &card : cards) {
    if (card.is("MATERIAL")) material = &add_material(card, into);
    const MaterialReader read = reader_of(card);
    if (!read && !card.is("DENSITY")) continue;
    card.used = true;
    if (!material) inp_fail(card.line, "*%s stands before any *MATERIAL", card.keyword.c_str());
    if (!read) {
      read_density(card, units, *material);
      continue;
    }
    if (material->law != InpMaterial::none_given) {
      inp_fail(card.line, "material %s has two laws: the other one is in line %d",
               quoted(material->name).c_str(), material->law_line);
    }
    material->law_line = card.line;
    read(card, units, *material, notes);
  }
}

}  // namespace mvs::core
