// *BOUNDARY, *DSLOAD and *DLOAD of all steps, and *AMPLITUDE.
#include "formats/abaqus/load.h"

#include <algorithm>

#include "formats/text/line.h"

namespace mvs::core {
namespace {

// The constraints of a node by degree of freedom; 4 to 6 are rotations.
struct Held {
  std::array<std::optional<double>, 3> moved;
  int32_t line = 0;
};

class Steps {
 public:
  Steps(const InpMesh &mesh, InpNotes &notes) : mesh_(mesh), notes_(notes) {}

  void begin() { boundary_is_new_ = pressure_is_new_ = false; }
  void boundary(InpCard &card, const InpAmplitudes &amplitudes);
  void pressure(InpCard &card, const InpAmplitudes &amplitudes, const InpSurfaces &surfaces);
  void end(InpLoad &into);

 private:
  void hold(const std::vector<uint32_t> &nodes, uint64_t first, uint64_t last, double by,
            int32_t line);
  void row_of_boundary(InpRow row, double factor);
  void row_of_pressure(InpRow row, const InpCard &card, double factor, const InpSurfaces &surfaces);

  const InpMesh &mesh_;
  InpNotes &notes_;
  std::map<uint32_t, Held> held_;
  std::map<uint32_t, double> pressure_;
  bool boundary_is_new_ = false, pressure_is_new_ = false;  // this step has OP=NEW
};

bool is_new(InpCard &card) {
  const std::string op = inp_label(card.take("OP").value_or("MOD"));
  if (op != "NEW" && op != "MOD") {
    inp_fail(card.line, "OP=%s is neither NEW nor MOD", quoted(op).c_str());
  }
  return op == "NEW";
}

void Steps::hold(const std::vector<uint32_t> &nodes, uint64_t first, uint64_t last, double by,
                 int32_t line) {
  if (first < 1 || last < first || last > 6) {
    inp_fail(line, "degrees of freedom are 1 to 6, from the lower to the higher");
  }
  if (last > 3) {
    notes_.left_out(line,
                    "prescribed rotations (degrees of freedom 4 to 6) are left out: nodes have "
                    "no rotation here");
  }
  for (const uint32_t node : nodes) {
    for (uint64_t dof = first; dof <= std::min<uint64_t>(last, 3); ++dof) {
      held_[node].moved[dof - 1] = by;
      held_[node].line = line;
    }
  }
}

void Steps::row_of_boundary(InpRow row, double factor) {
  const std::vector<uint32_t> nodes = mesh_.named_nodes(row.word(), row.line());
  InpRow words = row;
  const std::string label = inp_label(words.word());
  if (label == "ENCASTRE" || label == "PINNED") {
    return hold(nodes, 1, label == "PINNED" ? 3 : 6, 0, row.line());
  }
  if (!label.empty() && label[0] >= 'A' && label[0] <= 'Z') {
    return notes_.left_out(row.line(), "boundary condition " + quoted(label) +
                                           " is ignored: a node is held in all directions or free");
  }
  const uint64_t first = row.whole("a degree of freedom");
  InpRow ahead = row;
  const bool has_last = !ahead.word().empty();
  const uint64_t last = has_last ? row.whole("a degree of freedom") : first;
  if (!has_last) row.word();
  hold(nodes, first, last, factor * row.number("a displacement", mesh_.units.length, 0.0),
       row.line());
}

void Steps::boundary(InpCard &card, const InpAmplitudes &amplitudes) {
  card.used = true;
  const std::string type = inp_label(card.take("TYPE").value_or("DISPLACEMENT"));
  if (type != "DISPLACEMENT") {
    inp_fail(card.line, "*BOUNDARY, TYPE=%s is not read: give displacements", quoted(type).c_str());
  }
  if (is_new(card) && !boundary_is_new_) {
    held_.clear();
    boundary_is_new_ = true;
  }
  const double factor = inp_factor(card, amplitudes);
  for (size_t k = 0; k < card.data.size(); ++k) row_of_boundary(card.row(k), factor);
}

// *DSLOAD pushes into a surface; *DLOAD pushes elements along their normals.
void Steps::row_of_pressure(InpRow row, const InpCard &card, double factor,
                            const InpSurfaces &surfaces) {
  const std::string_view where = row.word();
  const std::string label = inp_label(row.word());
  if (label != "P") {
    return notes_.left_out(row.line(), "load " + quoted(label) + " of *" + card.keyword +
                                           " is left out: leaflets carry pressure alone");
  }
  const double value = factor * row.number("a pressure", mesh_.units.stress);
  if (card.is("DLOAD")) {
    for (const uint32_t e : mesh_.named_elements(where, row.line())) pressure_[e] = value;
    return;
  }
  const auto surface = surfaces.find(inp_label(where));
  if (surface == surfaces.end()) {
    inp_fail(row.line(), "the file has no surface %s", quoted(where).c_str());
  }
  for (const auto &[element, side] : surface->second.faces) pressure_[element] = -side * value;
}

void Steps::pressure(InpCard &card, const InpAmplitudes &amplitudes, const InpSurfaces &surfaces) {
  card.used = true;
  if (is_new(card) && !pressure_is_new_) {
    pressure_.clear();
    pressure_is_new_ = true;
  }
  const double factor = inp_factor(card, amplitudes);
  for (size_t k = 0; k < card.data.size(); ++k) {
    row_of_pressure(card.row(k), card, factor, surfaces);
  }
}

void Steps::end(InpLoad &into) {
  for (const auto &[node, held] : held_) {
    Vec3 by = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const std::optional<double> &moved = held.moved[static_cast<size_t>(k)];
      by[k] = moved.value_or(0);
      if (moved) continue;
      notes_.left_out(held.line, "a node that is held in some directions is held in all of them");
    }
    into.moved[node] = by;
  }
  into.pressure = std::move(pressure_);
}

}  // namespace

InpAmplitudes read_inp_amplitudes(std::vector<InpCard> &cards, InpNotes &notes) {
  InpAmplitudes amplitudes;
  for (InpCard &card : cards) {
    if (!card.is("AMPLITUDE")) continue;
    card.used = true;
    const std::string name = card.need("NAME");
    const std::string how = inp_label(card.take("DEFINITION").value_or("TABULAR"));
    const std::string value = inp_label(card.take("VALUE").value_or("RELATIVE"));
    if ((how != "TABULAR" && how != "SMOOTH STEP") || value != "RELATIVE") {
      inp_fail(card.line, "*AMPLITUDE is read as TABULAR or SMOOTH STEP with relative values");
    }
    std::vector<double> numbers;
    for (size_t k = 0; k < card.data.size(); ++k) {
      InpRow row = card.row(k);
      while (!row.at_end()) numbers.push_back(row.number("a number", 0, 0.0));
    }
    if (numbers.size() < 2 || numbers.size() % 2 != 0) {
      inp_fail(card.line, "*AMPLITUDE needs pairs of time and value");
    }
    amplitudes[name] = numbers.back();
    notes.chosen("amplitude %s: its last value, %g, counts; how it got there does not",
                 quoted(name).c_str(), numbers.back());
  }
  return amplitudes;
}

double inp_factor(InpCard &card, const InpAmplitudes &amplitudes) {
  const auto name = card.take("AMPLITUDE");
  if (!name) return 1;
  const auto found = amplitudes.find(inp_label(*name));
  if (found == amplitudes.end()) {
    inp_fail(card.line, "the file has no amplitude %s", quoted(*name).c_str());
  }
  return found->second;
}

InpLoad read_inp_load(std::vector<InpCard> &cards, const InpMesh &mesh, InpNotes &notes) {
  InpLoad load;
  const InpSurfaces surfaces = read_inp_surfaces(cards, mesh, load, notes);
  const InpAmplitudes amplitudes = read_inp_amplitudes(cards, notes);
  Steps steps(mesh, notes);
  size_t step_count = 0;
  for (InpCard &card : cards) {
    if (card.is("STEP")) {
      card.used = true;
      for (const char *key : {"NAME", "NLGEOM"}) card.take(key);
      steps.begin();
      ++step_count;
    }
    if (card.is("BOUNDARY")) steps.boundary(card, amplitudes);
    if (card.is("DSLOAD") || card.is("DLOAD")) steps.pressure(card, amplitudes, surfaces);
  }
  steps.end(load);
  if (step_count > 1) notes.chosen("%zu steps: the end of the last one is the load", step_count);
  read_inp_contact(cards, mesh.units, load, notes);
  return load;
}

}  // namespace mvs::core
