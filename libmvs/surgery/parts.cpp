// Finding parts by id, adding nodes and taking them out.
#include "base/error.h"
#include "model/part_names.h"
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

// "papillary head PM1", or "" where no part has the id.
std::string what_is(const Valve &valve, Id id) {
  uint32_t k;
  if ((k = index_of(valve.chords, id)) != none) return "chord " + valve.chords.get()[k].name;
  if ((k = index_of(valve.heads, id)) != none) return "papillary head " + valve.heads.get()[k].name;
  if ((k = index_of(valve.scallops, id)) != none) return "scallop " + valve.scallops.get()[k].name;
  if ((k = index_of(valve.leaflets, id)) != none) return "leaflet " + valve.leaflets.get()[k].name;
  if ((k = index_of(valve.rings, id)) != none) return "ring " + valve.rings.get()[k].name;
  return "";
}

template <typename Part>
uint32_t find(const Surgery &s, const CowVector<Part> &parts, Id id, const char *kind) {
  const uint32_t k = index_of(parts, id);
  if (k != none) return k;
  const std::string other = what_is(s.valve, id);
  const auto number = static_cast<unsigned long long>(id);
  MVS_MUST(other.empty(), MVS_E_ID, kind, "%s: id %llu is %s, not a %s", s.op_name, number,
           other.c_str(), kind);
  MVS_MUST(id >= s.valve.next_id, MVS_E_ID, kind,
           "%s: the %s with id %llu is not there any more, or not yet: look it up by its name",
           s.op_name, kind, number);
  fail(MVS_E_ID, kind, "%s: no part of this valve ever had id %llu: look it up by its name",
       s.op_name, number);
}

// The nodes' new places in the list; `none` for those that go.
std::vector<uint32_t> new_numbers(const std::vector<uint8_t> &gone) {
  std::vector<uint32_t> number(gone.size(), none);
  uint32_t next = 0;
  for (size_t n = 0; n < gone.size(); ++n) {
    if (!gone[n]) number[n] = next++;
  }
  return number;
}

template <typename T>
void keep(CowVector<T> &rows, const std::vector<uint8_t> &gone) {
  std::vector<T> kept;
  for (size_t n = 0; n < gone.size(); ++n) {
    if (!gone[n]) kept.push_back(rows.get()[n]);
  }
  rows = std::move(kept);
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
       name, names_there(s.valve.scallops.get()).c_str());
}

uint32_t Surgery::add_node(const std::vector<uint32_t> &nodes, const std::vector<double> &weights) {
  const auto mean = [&](const std::vector<Vec3> &places) {
    Vec3 sum = Vec3::Zero();
    for (size_t k = 0; k < nodes.size(); ++k) sum += weights[k] * places[nodes[k]];
    return sum;
  };
  const auto index = static_cast<uint32_t>(valve.rest.size());
  const Vec3 rest = mean(valve.rest), x = mean(state.x), v = mean(state.v);
  valve.rest.push_back(rest);
  valve.open.push_back(rest);
  valve.loaded.push_back(rest);
  valve.origin.push_back(none);
  state.x.push_back(x);
  state.v.push_back(v);
  return index;
}

void remove_nodes(Surgery &s, const std::vector<uint8_t> &gone) {
  const std::vector<uint32_t> number = new_numbers(gone);
  Valve &valve = s.valve;
  for (CowVector<Vec3> *rows : {&valve.rest, &valve.open, &valve.loaded, &s.state.x, &s.state.v}) {
    keep(*rows, gone);
  }
  keep(valve.origin, gone);
  for (Tri &triangle : valve.triangles) {
    for (uint32_t &node : triangle) node = number[node];
  }
  for (uint32_t &node : valve.annulus) node = number[node];
  for (Chord &chord : valve.chords) {
    chord.a = number[chord.a];
    chord.b = number[chord.b];
  }
  for (Head &head : valve.heads) head.node = number[head.node];
  renumber_grasps(s.state, number);
}

}  // namespace mvs::core
