// *SHELL SECTION and *SOLID SECTION: leaflets with thickness, chordae with area.
#include "formats/abaqus/properties.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

InpSection read_section(InpCard &card, const InpMesh &mesh, const InpProperties &properties,
                        const char *size, int shift) {
  card.used = true;
  InpSection section;
  section.line = card.line;
  const std::string label = card.need("ELSET");
  const InpSet *set = mesh.find_set(mesh.element_sets, label);
  if (!set) inp_fail(card.line, "the file has no set of elements %s", quoted(label).c_str());
  section.name = set->name;
  section.elements = set->items;
  section.material = card.need("MATERIAL");
  if (!properties.materials.contains(section.material)) {
    inp_fail(card.line, "the file has no material %s", quoted(section.material).c_str());
  }
  if (card.data.empty())
    inp_fail(card.line, "*%s has no line with its %s", card.keyword.c_str(), size);
  section.size = card.row(0).number(size, shift);
  return section;
}

void read_shell(InpCard &card, const InpMesh &mesh, InpProperties &into, InpNotes &notes) {
  for (const char *key : {"COMPOSITE", "NODAL THICKNESS", "SHELL THICKNESS"}) {
    if (card.take(key))
      inp_fail(card.line, "*SHELL SECTION with %s is not read: give one thickness", key);
  }
  InpSection section = read_section(card, mesh, into, "thickness", mesh.units.length);
  if (const auto orientation = card.take("ORIENTATION")) {
    section.orientation = inp_label(*orientation);
    if (!into.orientations.contains(section.orientation)) {
      inp_fail(card.line, "the file has no orientation %s", quoted(*orientation).c_str());
    }
  }
  InpRow row = card.row(0);
  row.word();
  if (!row.word().empty()) {
    notes.left_out(card.data[0].line,
                   "integration points through the thickness of *SHELL SECTION are "
                   "left out: bending is a term of its own here");
  }
  into.shells.push_back(std::move(section));
}

// Checks that each element belongs to exactly one section of its kind.
void check_sections(const InpMesh &mesh, const InpProperties &properties) {
  std::vector<int32_t> line_of(mesh.elements.size(), 0);
  const auto check = [&](const InpSection &section, bool trusses, const char *what) {
    for (const uint32_t e : section.elements) {
      const InpElement &element = mesh.elements[e];
      const auto number = static_cast<unsigned long long>(element.number);
      if ((element.nodes.size() == 2) != trusses) {
        inp_fail(section.line, "element %llu of line %d is not a %s, as the section of %s requires",
                 number, element.line, what, quoted(section.name).c_str());
      }
      if (line_of[e] != 0) {
        inp_fail(section.line, "element %llu has a section in line %d already", number, line_of[e]);
      }
      line_of[e] = section.line;
    }
  };
  for (const InpSection &section : properties.shells) check(section, false, "shell");
  for (const InpSection &section : properties.trusses) check(section, true, "truss");
  for (size_t e = 0; e < line_of.size(); ++e) {
    if (line_of[e] != 0) continue;
    inp_fail(mesh.elements[e].line,
             "element %llu has no section: put its set into a *SHELL SECTION or *SOLID SECTION",
             static_cast<unsigned long long>(mesh.elements[e].number));
  }
}

}  // namespace

void read_inp_sections(std::vector<InpCard> &cards, const InpMesh &mesh, InpProperties &into,
                       InpNotes &notes) {
  for (InpCard &card : cards) {
    if (card.is("SHELL SECTION")) read_shell(card, mesh, into, notes);
    if (card.is("SOLID SECTION")) {
      into.trusses.push_back(read_section(card, mesh, into, "area", 2 * mesh.units.length));
    }
  }
  check_sections(mesh, into);
}

InpProperties read_inp_properties(std::vector<InpCard> &cards, const InpMesh &mesh,
                                  InpNotes &notes) {
  InpProperties properties;
  read_inp_materials(cards, mesh.units, properties, notes);
  read_inp_orientations(cards, mesh, properties, notes);
  read_inp_sections(cards, mesh, properties, notes);
  return properties;
}

}  // namespace mvs::core
