// Finds parts by id; adds and removes nodes, sutures and rings.
#include "base/error.h"
#include "measure/annulus/landmarks.h"
#include "model/part_names.h"
#include "model/valve_arrays.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

template <typename Part>
uint32_t index_of(const CowVector<Part> &parts, Id id) {
  for (uint32_t k = 0; k < parts.size(); ++k) {
    if (parts[k].id == id) return k;
  }
  return none;
}

// Returns "papillary head PM1", or "" for an unknown id.
std::string part_with_id(const Valve &valve, Id id) {
  std::string found;
  for_each_part_list([&](auto list, const char *kind, bool) {
    const uint32_t k = index_of(valve.*list, id);
    if (k != none) found = kind + (" " + (valve.*list)[k].name);
  });
  return found;
}

template <typename Part>
uint32_t find(const Surgery &s, const CowVector<Part> &parts, Id id, const char *kind) {
  const uint32_t k = index_of(parts, id);
  if (k != none) return k;
  const std::string other = part_with_id(s.valve, id);
  const auto number = static_cast<unsigned long long>(id);
  MVS_MUST(other.empty(), MVS_E_ID, kind, "%s: id %llu is %s, not a %s", s.op_name, number,
           other.c_str(), kind);
  MVS_MUST(id >= s.valve.next_id, MVS_E_ID, kind,
           "%s: the %s with id %llu does not exist any more, or not yet: look it up by its name",
           s.op_name, kind, number);
  fail(MVS_E_ID, kind, "%s: no part of this valve ever had id %llu: look it up by its name",
       s.op_name, number);
}

}  // namespace

uint32_t chord_of(const Surgery &s, Id id) {
  return find(s, s.valve.chords, id, "chord");
}
uint32_t head_of(const Surgery &s, Id id) {
  return find(s, s.valve.heads, id, "papillary head");
}
uint32_t scallop_of(const Surgery &s, Id id) {
  return find(s, s.valve.scallops, id, "scallop");
}

uint32_t scallop_or(const Surgery &s, Id id, const char *name) {
  if (id != 0) return scallop_of(s, id);
  for (uint32_t k = 0; k < s.valve.scallops.size(); ++k) {
    if (s.valve.scallops.get()[k].name == name) return k;
  }
  fail(MVS_E_ID, name, "%s: the valve has no scallop named %s: say which one you mean%s", s.op_name,
       name, near_names(name, s.valve.scallops.get()).c_str());
}

uint32_t add_node(Surgery &s, const std::vector<uint32_t> &nodes,
                  const std::vector<double> &weights) {
  const auto mean = [&](const std::vector<Vec3> &positions) {
    Vec3 sum = Vec3::Zero();
    for (size_t k = 0; k < nodes.size(); ++k) sum += weights[k] * positions[nodes[k]];
    return sum;
  };
  const auto index = static_cast<uint32_t>(s.valve.rest.size());
  const Vec3 rest = mean(s.valve.rest), x = mean(s.state.x), v = mean(s.state.v);
  for (CowVector<Vec3> *rows : {&s.valve.rest, &s.valve.open, &s.valve.loaded}) {
    rows->push_back(rest);
  }
  s.valve.origin.push_back(none);
  s.state.x.push_back(x);
  s.state.v.push_back(v);
  return index;
}

void remove_nodes(Surgery &s, const std::vector<uint8_t> &gone) {
  remove_rows(s.state.x, gone);
  remove_rows(s.state.v, gone);
  renumber_grasps(s.state, remove_nodes(s.valve, gone));
}

void open_the_valve(Surgery &s) {
  const State open = initial_state(s.before);
  s.state.x = open.x;
  s.state.v = open.v;
}

Id add_suture(Surgery &s, Suture suture) {
  Chord chord;
  chord.id = new_id(s);
  chord.name = std::move(suture.name);
  chord.a = suture.a;
  chord.b = suture.b;
  chord.kind = ChordKind::suture;
  chord.rest_length = suture.rest_length;
  chord.young = suture.young;
  chord.area = suture.area;
  const Id id = chord.id;
  s.valve.chords.push_back(std::move(chord));
  return id;
}

void set_ring(Surgery &s, const char *name, const char *default_name, RingKind kind,
              std::vector<Vec3> curve) {
  Ring ring;
  ring.id = s.made = new_id(s);
  ring.name = name && *name ? name : default_name;
  ring.kind = kind;
  ring.curve = std::move(curve);
  s.valve.rings = {std::move(ring)};
}

void must_have_no_ring(const Surgery &s, const char *remedy) {
  if (s.valve.rings.empty()) return;
  const Ring &ring = s.valve.rings.get()[0];
  const char *kind = ring.kind == RingKind::band ? "band" : "ring";
  fail(MVS_E_OP, std::string(kind) + " " + ring.name, "%s: %s %s holds the annulus, %s", s.op_name,
       kind, ring.name.c_str(), remedy);
}

// A quarter is the smallest share that is tested to close (OPERATIONS.md), 3 the largest factor of
// annulus_scale.
void must_be_a_perimeter(const Surgery &s, double perimeter, const char *what) {
  constexpr double least = 0.25, largest = 3, rounding = 1e-9;
  const double share = perimeter / Loop(s.before.valve.annulus, s.before.valve.rest).length();
  MVS_MUST(share >= least - rounding, MVS_E_OP, s.op_name,
           "%s: a perimeter of %.1f mm is %.0f %% of the annulus's at rest: the tissue cannot be "
           "gathered below %.0f %%, take a larger %s",
           s.op_name, 1e3 * perimeter, 100 * share, 100 * least, what);
  MVS_MUST(share <= largest + rounding, MVS_E_OP, s.op_name,
           "%s: a perimeter of %.1f mm is %.0f %% of the annulus's at rest: at most %.0f %% are "
           "possible, take a smaller %s",
           s.op_name, 1e3 * perimeter, 100 * share, 100 * largest, what);
}

}  // namespace mvs::core
