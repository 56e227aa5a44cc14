// Default values of a valve, one function for each kind of part.
#include "model/complete.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "model/orientation.h"
#include "model/topology.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

// Open and loaded positions are used for prescribed nodes only; all others get the rest position.
void complete_places(const Valve &valve, CowVector<Vec3> &places) {
  std::vector<Vec3> complete = valve.rest;
  if (!places.empty()) {
    for (const uint32_t node : valve.annulus) complete[node] = std::as_const(places)[node];
    for (const Head &head : valve.heads) complete[head.node] = std::as_const(places)[head.node];
  }
  places = std::move(complete);
}

void complete_arrays(Valve &valve) {
  complete_places(valve, valve.open);
  complete_places(valve, valve.loaded);
  if (valve.origin.empty()) {
    valve.origin.resize(valve.rest.size());
    std::iota(valve.origin.begin(), valve.origin.end(), 0u);
  }
  if (valve.triangle_thickness.empty()) {
    for (const uint32_t leaflet : valve.triangle_leaflet) {
      valve.triangle_thickness.push_back(valve.leaflets[leaflet].thickness);
    }
  }
}

void complete_scallops(Valve &valve) {
  if (!valve.scallops.empty()) return;
  for (uint32_t l = 0; l < valve.leaflets.size(); ++l) {
    valve.scallops.push_back({0, valve.leaflets[l].name, l});
  }
  valve.triangle_scallop = valve.triangle_leaflet;
}

template <typename Part>
void raise_next_id(const CowVector<Part> &parts, Id &next_id) {
  for (const Part &part : parts) next_id = std::max(next_id, part.id + 1);
}

template <typename Part>
void give_ids(CowVector<Part> &parts, Id &next_id) {
  for (size_t k = 0; k < parts.size(); ++k) {
    if (std::as_const(parts)[k].id == 0) parts[k].id = next_id++;
  }
}

void complete_ids(Valve &valve) {
  for_each_part_list([&](auto list, auto...) { raise_next_id(valve.*list, valve.next_id); });
  for_each_part_list([&](auto list, auto...) { give_ids(valve.*list, valve.next_id); });
}

template <typename Part>
std::set<std::string> names_of(const CowVector<Part> &parts) {
  std::set<std::string> names;
  for (const Part &part : parts) names.insert(part.name);
  return names;
}

// Returns the first unused name of "prefix1", "prefix2", ...
std::string free_name(const std::string &prefix, std::set<std::string> &taken, uint32_t &number) {
  std::string name;
  do {
    name = prefix + std::to_string(++number);
  } while (!taken.insert(name).second);
  return name;
}

void complete_head_names(Valve &valve) {
  std::set<std::string> taken = names_of(valve.heads);
  uint32_t number = 0;
  for (Head &head : valve.heads) {
    if (head.name.empty()) head.name = free_name("PM", taken, number);
  }
}

// The scallop of each leaflet node: that of its first triangle.
std::vector<uint32_t> node_scallops(const Valve &valve) {
  std::vector<uint32_t> scallop(valve.rest.size(), none);
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    for (const uint32_t node : valve.triangles[t]) {
      if (scallop[node] == none) scallop[node] = valve.triangle_scallop[t];
    }
  }
  return scallop;
}

// The papillary head of each node of the chordae, by breadth-first search from the heads.
std::vector<uint32_t> node_heads(const Valve &valve) {
  const Rows chords_at = chords_at_nodes(valve);
  std::vector<uint32_t> head(valve.rest.size(), none), queue;
  for (uint32_t h = 0; h < valve.heads.size(); ++h) {
    head[valve.heads[h].node] = h;
    queue.push_back(valve.heads[h].node);
  }
  for (size_t q = 0; q < queue.size(); ++q) {
    for (const uint32_t c : chords_at[queue[q]]) {
      const uint32_t other = valve.chords.get()[c].other_end(queue[q]);
      if (head[other] != none) continue;
      head[other] = head[queue[q]];
      queue.push_back(other);
    }
  }
  return head;
}

// Names chordae after scallop and number, "P2/3", or after the head, "PM1/2", if they end at a
// branch point.
void complete_chord_names(Valve &valve) {
  const std::vector<uint32_t> scallop = node_scallops(valve), head = node_heads(valve);
  std::set<std::string> taken = names_of(valve.chords);
  std::vector<uint32_t> by_scallop(valve.scallops.size(), 0), by_head(valve.heads.size(), 0);
  for (Chord &chord : valve.chords) {
    if (!chord.name.empty()) continue;
    const uint32_t s = std::min(scallop[chord.a], scallop[chord.b]);
    if (s != none) {
      chord.name = free_name(valve.scallops[s].name + "/", taken, by_scallop[s]);
    } else {
      const uint32_t h = head[chord.a];
      chord.name = free_name(valve.heads[h].name + "/", taken, by_head[h]);
    }
  }
}

void complete_lengths(Valve &valve) {
  for (Chord &chord : valve.chords) {
    if (chord.rest_length == 0) {
      chord.rest_length = (valve.rest[chord.b] - valve.rest[chord.a]).norm();
    }
  }
}

// Projects a direction onto the plane of a triangle and normalises it; returns the first side of
// the triangle if the projection vanishes. A unit vector in the plane is returned unchanged.
Vec3 into_plane(const Valve &valve, const Tri &triangle, const Vec3 &direction) {
  const Vec3 side = valve.rest[triangle[1]] - valve.rest[triangle[0]];
  const Vec3 normal = side.cross(valve.rest[triangle[2]] - valve.rest[triangle[0]]).normalized();
  const double out = direction.dot(normal), length = direction.norm();
  // far above rounding of a unit vector, far below any relevant angle
  constexpr double close = 1e-12;
  if (std::abs(length - 1) < close && std::abs(out) < close) return direction;
  const Vec3 flat = direction - out * normal;
  return flat.norm() > 1e-6 * length ? flat.normalized() : side.normalized();
}

// Fibres are circumferential by default: tangential to a rotation about the axis of the valve.
void complete_fibres(Valve &valve) {
  const bool given = !valve.triangle_fibre.empty();
  const Vec3 centre = annulus_centre(valve);
  const Vec3 axis = annulus_area(valve, centre).normalized();
  valve.triangle_fibre.resize(valve.triangles.size());
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const Tri &triangle = valve.triangles[t];
    const Vec3 middle =
        (valve.rest[triangle[0]] + valve.rest[triangle[1]] + valve.rest[triangle[2]]) / 3;
    Vec3 &fibre = valve.triangle_fibre[t];
    fibre = into_plane(valve, triangle, given ? fibre : Vec3(axis.cross(middle - centre)));
  }
}

}  // namespace

void complete(Valve &valve) {
  complete_arrays(valve);
  complete_scallops(valve);
  complete_ids(valve);
  complete_head_names(valve);
  complete_chord_names(valve);
  complete_lengths(valve);
  complete_fibres(valve);
}

}  // namespace mvs::core
