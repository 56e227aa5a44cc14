// Packs preconditioner keys into the numbers of a solver cache and checks them on the way back.
// Layout of version 1, for the active key and then, if there is one, the pending key:
// node count, tool count, pressure, dt, damping, the tools, the positions. A convex tool adds the
// rest of its frame and its bodies.
#include "solve/dynamic/preconditioner_key.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/error.h"
#include "solve/dynamic/cached_preconditioner.h"
#include "solve/solver.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {
namespace {

constexpr uint32_t cache_version = 1;
constexpr size_t key_header = 5;  // numbers in front of the tools

void append(std::vector<double> &data, const Vec3 &v) {
  data.insert(data.end(), v.data(), v.data() + 3);
}

void append(std::vector<double> &data, const Tool &tool) {
  data.insert(data.end(), {static_cast<double>(tool.id), static_cast<double>(tool.kind),
                           static_cast<double>(tool.node), tool.radius, tool.length, tool.stiffness,
                           tool.max_force});
  for (const Vec3 &v : {tool.position, tool.axis, tool.proxy[0], tool.proxy[1]}) append(data, v);
  if (!tool.shape) return;
  for (const Vec3 &v : {tool.proxy[2], tool.proxy[3]}) append(data, v);
  data.push_back(static_cast<double>(tool.shape->bodies().size()));
  for (const ToolBody &body : tool.shape->bodies()) {
    data.insert(data.end(), {static_cast<double>(body.kind), body.radius,
                             static_cast<double>(body.vertices.size())});
    for (const Vec3 &v : body.vertices.get()) append(data, v);
  }
}

void append(std::vector<double> &data, const PreconditionerKey &key) {
  data.insert(data.end(), {static_cast<double>(key.x.size()), static_cast<double>(key.tools.size()),
                           key.pressure, key.dt, key.damping});
  for (const Tool &tool : key.tools) append(data, tool);
  for (const Vec3 &x : key.x) append(data, x);
}

// Takes the numbers of a cache from its front.
class CacheReader {
 public:
  CacheReader(const SolverCache &cache, const Model &model, size_t valve_nodes)
      : model_(model), valve_nodes_(valve_nodes), left_(cache.data.get()) {}

  bool at_end() const { return left_.empty(); }
  PreconditionerKey key() {
    const uint64_t nodes = whole(), tools = whole();
    must(nodes > 0 && nodes <= left_.size() && tools <= left_.size());
    PreconditionerKey key;
    key.pressure = number();
    key.dt = number();
    key.damping = number();
    std::vector<Tool> read;
    for (uint64_t k = 0; k < tools; ++k) read.push_back(tool());
    key.tools = std::move(read);
    must(nodes == valve_nodes_ + tool_points(key.tools));
    std::vector<Vec3> x(nodes);
    for (Vec3 &v : x) v = vector();
    key.x = std::move(x);
    return key;
  }

 private:
  static void must(bool condition) {
    MVS_MUST(condition, MVS_E_FORMAT, "state",
             "the solver cache of the state is damaged or belongs to another valve: settle the "
             "valve, which makes a new one");
  }
  double number() {
    must(!left_.empty() && std::isfinite(left_.front()));
    const double value = left_.front();
    left_ = left_.subspan(1);
    return value;
  }
  uint64_t whole() {
    const double value = number();
    must(value >= 0 && value <= 0x1p53 && value == std::floor(value));
    return static_cast<uint64_t>(value);
  }
  uint32_t index() {
    const uint64_t value = whole();
    must(value <= UINT32_MAX);
    return static_cast<uint32_t>(value);
  }
  Vec3 vector() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  Tool tool() {
    Tool tool;
    tool.id = whole();
    tool.kind = static_cast<ToolKind>(index());
    tool.node = index();
    for (double *value : {&tool.radius, &tool.length, &tool.stiffness, &tool.max_force}) {
      *value = number();
    }
    for (Vec3 *v : {&tool.position, &tool.axis, &tool.proxy[0], &tool.proxy[1]}) *v = vector();
    if (tool.kind == ToolKind::convex) {
      for (Vec3 *v : {&tool.proxy[2], &tool.proxy[3]}) *v = vector();
      tool.shape = shape();
    }
    must(is_valid(model_, tool));
    return tool;
  }

  ToolShapePtr shape() {
    const uint64_t count = whole();
    must(count <= most_tool_bodies);
    std::vector<ToolBody> bodies(count);
    for (ToolBody &body : bodies) {
      body.kind = static_cast<BodyKind>(index());
      body.radius = number();
      const uint64_t size = whole();
      must(size <= most_tool_vertices);
      std::vector<Vec3> vertices(size);
      for (Vec3 &v : vertices) v = vector();
      body.vertices = std::move(vertices);
    }
    must(are_valid(bodies));
    return ToolShapePtr(std::make_shared<const ToolShape>(std::move(bodies)));
  }

  const Model &model_;
  const size_t valve_nodes_;
  std::span<const double> left_;
};

uint64_t packed_ages(const PreconditionerKeys &keys) {
  return keys.active.age | uint64_t{keys.pending.age} << 32;
}

void unpack_ages(uint64_t counter, PreconditionerKeys &keys) {
  keys.active.age = static_cast<uint32_t>(counter);
  keys.pending.age = static_cast<uint32_t>(counter >> 32);
}

}  // namespace

SolverCache pack(const PreconditionerKeys &keys, CowVector<double> &data) {
  if (keys.active.empty()) return {};
  std::vector<double> &numbers = data.edit();
  numbers.clear();
  append(numbers, keys.active);
  if (!keys.pending.empty()) append(numbers, keys.pending);
  return {cache_version, packed_ages(keys), data};
}

PreconditionerKeys unpack(const SolverCache &cache, const Model &model, size_t valve_nodes) {
  if (cache.empty()) return {};
  MVS_MUST(cache.version == cache_version, MVS_E_VERSION, "state",
           "the solver cache of the state is of version %u, this library reads version %u: settle "
           "the valve, which makes a new one, or use a newer libmvs",
           cache.version, cache_version);
  CacheReader reader(cache, model, valve_nodes);
  PreconditionerKeys keys;
  keys.active = reader.key();
  if (!reader.at_end()) keys.pending = reader.key();
  unpack_ages(cache.counter, keys);
  const uint32_t most_parts = keys.pending.empty() ? 0 : CachedPreconditioner::parts_for(model);
  MVS_MUST(reader.at_end() && keys.pending.age <= most_parts, MVS_E_FORMAT, "state",
           "the solver cache of the state is damaged: settle the valve, which makes a new one");
  return keys;
}

void KeyStore::reserve(size_t nodes) {
  for (CowVector<double> &buffer : buffers_) buffer.reserve(2 * (key_header + 3 * nodes));
}

void KeyStore::load(const State &state, const Model &model) {
  const SolverCache &cache = state.cache;
  if (cache.version == packed_.version && cache.data.buffer() == packed_.data.buffer()) {
    unpack_ages(cache.counter, keys_);
  } else {
    keys_ = unpack(cache, model, state.x.size() - tool_points(state.tools));
  }
  packed_ = cache;
  is_packed_ = true;
}

void KeyStore::store(State &state) {
  if (!is_packed_) packed_ = pack(keys_, free_buffer(buffers_));
  packed_.counter = packed_ages(keys_);
  is_packed_ = true;
  state.cache = packed_;
}

void KeyStore::set(PreconditionerKeys keys) {
  keys_ = std::move(keys);
  is_packed_ = false;
}

void check_solver_cache(const ModelState &current) {
  unpack(current.state.cache, *current.model, current.model->node_count());
}

}  // namespace mvs::core
