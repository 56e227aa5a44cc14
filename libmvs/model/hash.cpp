// Hash of a model and a state: every field that a later step can depend on, in one fixed order.
#include "base/hash.h"

#include "model/model.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

void add(Hash &hash, const Vec3 &v) {
  for (int k = 0; k < 3; ++k) hash.add(v[k]);
}
void add(Hash &hash, const Tri &triangle) {
  for (const uint32_t node : triangle) hash.add(uint64_t{node});
}
void add(Hash &hash, uint32_t number) {
  hash.add(uint64_t{number});
}
void add(Hash &hash, double number) {
  hash.add(number);
}
void add(Hash &hash, Enum auto kind) {
  hash.add(static_cast<uint64_t>(kind));
}
void add(Hash &hash, const Leaflet &leaflet) {
  hash.add(leaflet.id);
  hash.add(leaflet.name);
  add(hash, leaflet.law);
  hash.add(leaflet.thickness);
  for (const double constant : leaflet.constants) hash.add(constant);
}
void add(Hash &hash, const Scallop &scallop) {
  hash.add(scallop.id);
  hash.add(scallop.name);
  add(hash, scallop.leaflet);
}
void add(Hash &hash, const Chord &chord) {
  hash.add(chord.id);
  hash.add(chord.name);
  for (const uint32_t node : {chord.a, chord.b}) add(hash, node);
  add(hash, chord.kind);
  add(hash, chord.law);
  for (const double number : {chord.rest_length, chord.young, chord.area}) hash.add(number);
  for (const double constant : chord.constants) hash.add(constant);
}
void add(Hash &hash, const Head &head) {
  hash.add(head.id);
  hash.add(head.name);
  add(hash, head.node);
}

template <typename Item>
void add(Hash &hash, const CowVector<Item> &items);
void add(Hash &hash, const Ring &ring) {
  hash.add(ring.id);
  hash.add(ring.name);
  add(hash, ring.kind);
  add(hash, ring.curve);
}

void add(Hash &hash, const CurvePoint &point) {
  for (const double number : point) hash.add(number);
}
void add(Hash &hash, const ChordCurve &curve) {
  hash.add(curve.id);
  hash.add(curve.name);
  add(hash, curve.points);
}

void add(Hash &hash, const Tool &tool) {
  hash.add(tool.id);
  add(hash, tool.kind);
  add(hash, tool.node);
  for (const double number : {tool.radius, tool.length, tool.stiffness, tool.max_force}) {
    hash.add(number);
  }
  for (const Vec3 &v : {tool.position, tool.axis, tool.proxy[0], tool.proxy[1]}) add(hash, v);
  if (!tool.shape) return;
  for (const Vec3 &v : {tool.proxy[2], tool.proxy[3]}) add(hash, v);
  hash.add(uint64_t{tool.shape->bodies().size()});
  for (const ToolBody &body : tool.shape->bodies()) {
    add(hash, body.kind);
    hash.add(body.radius);
    hash.add(uint64_t{body.vertices.size()});
    for (const Vec3 &v : body.vertices.get()) add(hash, v);
  }
}

template <typename Item>
void add(Hash &hash, const CowVector<Item> &items) {
  hash.add(uint64_t{items.size()});
  for (const Item &item : items) add(hash, item);
}

void add(Hash &hash, const Valve &valve) {
  hash.add(valve.name);
  for_each_array([&](auto array) { add(hash, valve.*array); });
  for (const double number :
       {valve.density, valve.contact_thickness, valve.contact_stiffness, valve.bending_scale}) {
    hash.add(number);
  }
  hash.add(valve.next_id);
}

}  // namespace

std::array<uint64_t, 2> hash_of(const Model &model, const State &state) {
  Hash hash;
  add(hash, model.valve);
  add(hash, state.x);
  add(hash, state.v);
  hash.add(state.time);
  hash.add(state.steps);
  hash.add(state.load.pressure);
  hash.add(state.load.boundary_fraction);
  // tools are hashed only if the state ever had one
  if (state.tools_made > 0) {
    hash.add(state.tools_made);
    add(hash, state.tools);
  }
  if (!state.cache.empty()) {
    add(hash, state.cache.version);
    hash.add(state.cache.counter);
    add(hash, state.cache.data);
  }
  return hash.value();
}

}  // namespace mvs::core
