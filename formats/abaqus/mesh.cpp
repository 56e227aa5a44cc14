// *NODE and *ELEMENT, and the part that contains them. Sets are in sets.cpp.
#include "formats/abaqus/mesh.h"

#include <algorithm>

#include "base/utf8.h"
#include "formats/abaqus/sets.h"
#include "formats/text/line.h"
#include "model/text.h"

namespace mvs::core {
namespace {

constexpr size_t most_items = size_t{1} << 22;

void check_room(size_t count, int32_t line) {
  if (count >= most_items) inp_fail(line, "the limit is %zu nodes or elements", most_items);
}

// The offset of an instance is ignored, so that nodes keep the coordinates of the file.
void check_place(const InpCard &card) {
  for (size_t k = 0; k < card.data.size(); ++k) {
    InpRow row = card.row(k);
    while (!row.at_end()) {
      if (row.number("a coordinate", 0, 0.0) == 0) continue;
      inp_fail(row.line(), "the instance is moved or turned: write the part where it stands");
    }
  }
}

void name_once(InpCard &card, const char *key, std::string &name) {
  card.used = true;
  const std::string label = card.need(key);
  if (!name.empty() && name != label) {
    inp_fail(card.line, "a second *%s, %s: a file for this reader has one", card.keyword.c_str(),
             quoted(label).c_str());
  }
  name = label;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= name_limit && is_plain_text(text) && is_utf8(text);
}

void read_structure(InpCard &card, InpMesh &mesh) {
  if (card.is("PART")) name_once(card, "NAME", mesh.part);
  if (card.is("INSTANCE")) {
    if (!mesh.instance.empty()) inp_fail(card.line, "a second *INSTANCE: this reader takes one");
    name_once(card, "NAME", mesh.instance);
    card.take("PART");
    check_place(card);
  }
  if (card.is("HEADING")) {
    card.used = true;
    if (!card.data.empty() && is_name(card.data[0].text)) mesh.heading = card.data[0].text;
  }
  static constexpr std::array silent = {"END PART", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY",
                                        "END STEP"};
  if (std::find(silent.begin(), silent.end(), card.keyword) == silent.end()) return;
  card.used = true;
  card.take("NAME");
}

// A repeated node number with the same coordinates is accepted, as in files that list each set in
// full.
void add_node(InpRow row, InpMesh &mesh, std::vector<uint32_t> &into) {
  check_room(mesh.nodes.size(), row.line());
  const uint64_t number = row.whole("a node number");
  const int shift = mesh.units.length;
  Vec3 x;
  for (double &coordinate : x) coordinate = row.number("a coordinate", shift);
  const auto [place, is_new] =
      mesh.node_of.emplace(number, static_cast<uint32_t>(mesh.nodes.size()));
  if (is_new) {
    mesh.nodes.push_back({number, x, row.line()});
  } else if (const InpNode &other = mesh.nodes[place->second]; other.x != x) {
    inp_fail(row.line(), "node %llu stands in line %d already, with other coordinates",
             static_cast<unsigned long long>(number), other.line);
  }
  into.push_back(place->second);
}

void read_nodes(InpCard &card, InpMesh &mesh) {
  card.used = true;
  std::vector<uint32_t> added;
  for (size_t k = 0; k < card.data.size(); ++k) add_node(card.row(k), mesh, added);
  if (const auto name = card.take("NSET")) {
    add_to_inp_set(mesh.node_sets, "", *name, card.line, added);
  }
}

// Returns the number of corners of an element type; 0 for an unsupported type.
size_t corners_of(const std::string &type) {
  if (type == "T3D2") return 2;
  if (type == "S3" || type == "S3R") return 3;
  if (type == "S4" || type == "S4R") return 4;
  return 0;
}

uint32_t node_at(uint64_t number, const InpMesh &mesh, int32_t line) {
  const auto place = mesh.node_of.find(number);
  if (place == mesh.node_of.end()) {
    inp_fail(line, "node %llu is not in the file", static_cast<unsigned long long>(number));
  }
  return place->second;
}

// Reads the element at data line k; a line that ends with a comma may continue in the next.
InpElement element_at(const InpCard &card, size_t &k, size_t corners, const InpMesh &mesh) {
  InpRow row = card.row(k);
  InpElement element{row.whole("an element number"), row.line(), {}};
  while (element.nodes.size() < corners) {
    if (row.at_end() && card.data[k].text.ends_with(',') && k + 1 < card.data.size()) {
      row = card.row(++k);
    }
    element.nodes.push_back(node_at(row.whole("a node number"), mesh, row.line()));
  }
  if (!row.word().empty() || !row.at_end()) {
    inp_fail(row.line(), "the element has more than %zu nodes", corners);
  }
  return element;
}

void skip_elements(InpCard &card, const std::string &type, InpMesh &mesh, InpNotes &notes) {
  for (size_t k = 0; k < card.data.size(); ++k) {
    mesh.skipped.insert(card.row(k).whole("an element number"));
    notes.left_out(card.line, "an element of type " + quoted(type) +
                                  " is left out: a valve is made of S3, S3R, S4, S4R and T3D2");
  }
}

void read_elements(InpCard &card, InpMesh &mesh, InpNotes &notes) {
  card.used = true;
  const std::string type = card.need("TYPE");
  const size_t corners = corners_of(type);
  const auto name = card.take("ELSET");
  if (corners == 0) skip_elements(card, type, mesh, notes);
  std::vector<uint32_t> added;
  for (size_t k = 0; corners > 0 && k < card.data.size(); ++k) {
    check_room(mesh.elements.size(), card.data[k].line);
    InpElement element = element_at(card, k, corners, mesh);
    const auto index = static_cast<uint32_t>(mesh.elements.size());
    const auto [place, is_new] = mesh.element_of.emplace(element.number, index);
    if (!is_new) {
      inp_fail(element.line, "element %llu stands in line %d already",
               static_cast<unsigned long long>(element.number), mesh.elements[place->second].line);
    }
    mesh.elements.push_back(std::move(element));
    added.push_back(index);
  }
  if (name) add_to_inp_set(mesh.element_sets, "", *name, card.line, added);
}

}  // namespace

InpMesh read_inp_mesh(std::vector<InpCard> &cards, const InpUnits &units, InpNotes &notes) {
  InpMesh mesh;
  mesh.units = units;
  for (InpCard &card : cards) {
    read_structure(card, mesh);
    if (card.is("NODE")) read_nodes(card, mesh);
  }
  for (InpCard &card : cards) {
    if (card.is("ELEMENT")) read_elements(card, mesh, notes);
  }
  read_inp_sets(cards, mesh);
  return mesh;
}

}  // namespace mvs::core
