// *SURFACE and contact definitions.
#include <algorithm>

#include "formats/abaqus/load.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

int side_of(std::string_view word, int32_t line, InpNotes &notes) {
  const std::string label = inp_label(word);
  if (label == "SPOS") return 1;
  if (label == "SNEG") return -1;
  if (label.empty()) {
    notes.left_out(line, "a surface of both sides of shells is taken as SPOS");
    return 1;
  }
  inp_fail(line, "%s is not a side of a shell: write SPOS or SNEG", quoted(word).c_str());
}

// MAXRATIO of general contact: Abaqus/Explicit limits the contact thickness of a shell to this
// share of the shortest edge or diagonal of its elements.
void read_max_ratio(InpCard &card, InpLoad &into) {
  const auto value = card.take("MAXRATIO");
  if (!value) return;
  InpRow row(*value, card.line);
  into.max_ratio = row.number("MAXRATIO");
  if (!(into.max_ratio > 0)) inp_fail(card.line, "MAXRATIO has to be above 0");
}

// Pressure-overclosure is ignored: the contact of libmvs is a barrier without this constant.
void read_behaviour(InpCard &card, const InpUnits &units, InpNotes &notes) {
  card.used = true;
  const std::string law = inp_label(card.take("PRESSURE-OVERCLOSURE").value_or("HARD"));
  std::string constant;
  if (law == "LINEAR" && !card.data.empty()) {
    const double slope = card.row(0).number("a contact stiffness", units.stress - units.length);
    constant = format(", %g Pa/m", slope);
  }
  notes.left_out(card.line, "the pressure-overclosure of contact (" + quoted(law) + constant +
                                ") is left out: leaflets touch by this library's own law");
}

}  // namespace

InpSurfaces read_inp_surfaces(std::vector<InpCard> &cards, const InpMesh &mesh, InpLoad &into,
                              InpNotes &notes) {
  InpSurfaces surfaces;
  for (InpCard &card : cards) {
    if (!card.is("SURFACE")) continue;
    card.used = true;
    const std::string type = inp_label(card.take("TYPE").value_or("ELEMENT"));
    if (type != "ELEMENT") {
      inp_fail(card.line, "*SURFACE, TYPE=%s is not read: ELEMENT is", quoted(type).c_str());
    }
    InpSurface &surface = surfaces[card.need("NAME")];
    surface.line = card.line;
    read_max_ratio(card, into);
    for (size_t k = 0; k < card.data.size(); ++k) {
      InpRow row = card.row(k);
      const std::vector<uint32_t> elements = mesh.named_elements(row.word(), row.line());
      const int side = side_of(row.word(), row.line(), notes);
      for (const uint32_t e : elements) surface.faces.emplace_back(e, side);
    }
  }
  return surfaces;
}

void read_inp_contact(std::vector<InpCard> &cards, const InpUnits &units, InpLoad &into,
                      InpNotes &notes) {
  static constexpr std::array plain = {"SURFACE INTERACTION", "CONTACT", "CONTACT INCLUSIONS",
                                       "CONTACT PROPERTY ASSIGNMENT"};
  for (InpCard &card : cards) {
    if (card.is("SURFACE BEHAVIOR")) read_behaviour(card, units, notes);
    if (std::find(plain.begin(), plain.end(), card.keyword) == plain.end()) continue;
    card.used = true;
    for (const char *key : {"NAME", "OP", "ALL EXTERIOR"}) card.take(key);
    if (card.is("CONTACT")) into.has_contact = true;
  }
  if (!into.has_contact) notes.chosen("the file has no *CONTACT; leaflets always touch here");
}

}  // namespace mvs::core
