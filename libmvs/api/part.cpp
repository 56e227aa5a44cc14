// Enumerates and finds the named parts of a snapshot: leaflets, scallops, chordae, heads, rings.
#include <cstring>

#include "api/structs.h"
#include "model/part_names.h"
#include "session/snapshot.h"

namespace {

using namespace mvs::core;

const char *kind_name(uint32_t kind) {
  switch (kind) {
    case MVS_PART_LEAFLET:
      return "leaflet";
    case MVS_PART_SCALLOP:
      return "scallop";
    case MVS_PART_CHORD:
      return "chord";
    case MVS_PART_RING:
      return "ring";
    case MVS_PART_CURVE:
      return "curve";
    default:
      return "papillary head";
  }
}

// Calls use(parts) with the list of parts of a kind.
template <typename Use>
void with_parts(const mvs_snapshot *snapshot, uint32_t kind, Use use) {
  must_point(snapshot, "snapshot");
  const Valve &valve = snapshot->model->valve;
  switch (kind) {
    case MVS_PART_LEAFLET:
      return use(valve.leaflets);
    case MVS_PART_SCALLOP:
      return use(valve.scallops);
    case MVS_PART_CHORD:
      return use(valve.chords);
    case MVS_PART_HEAD:
      return use(valve.heads);
    case MVS_PART_RING:
      return use(valve.rings);
    case MVS_PART_CURVE:
      return use(valve.curves);
    default:
      fail(MVS_E_ARGUMENT, "kind", "kind is %u: it has to be one of MVS_PART_*", kind);
  }
}

template <typename Part>
mvs_part public_part(const CowVector<Part> &parts, uint32_t kind, uint32_t index) {
  mvs_part out = {};
  out.id = parts[index].id;
  out.kind = kind;
  out.index = index;
  // find_faults refuses names longer than the field
  std::memcpy(out.name, parts[index].name.c_str(), parts[index].name.size());
  return out;
}

}  // namespace

extern "C" {

mvs_result mvs_snapshot_get_part_count(const mvs_snapshot *snapshot, uint32_t kind,
                                       uint32_t *count) {
  return at_boundary([&] {
    must_point(count, "count");
    with_parts(snapshot, kind,
               [&](const auto &parts) { *count = static_cast<uint32_t>(parts.size()); });
  });
}

mvs_result mvs_snapshot_get_part(const mvs_snapshot *snapshot, uint32_t kind, uint32_t index,
                                 mvs_part *part) {
  return at_boundary([&] {
    must_point(part, "part");
    with_parts(snapshot, kind, [&](const auto &parts) {
      MVS_MUST(index < parts.size(), MVS_E_ARGUMENT, "index",
               "index is %u, but the valve has %zu parts of the kind %s", index, parts.size(),
               kind_name(kind));
      *part = public_part(parts, kind, index);
    });
  });
}

mvs_result mvs_snapshot_find_part(const mvs_snapshot *snapshot, uint32_t kind, const char *name,
                                  mvs_part *part) {
  return at_boundary([&] {
    must_point(name, "name");
    must_point(part, "part");
    with_parts(snapshot, kind, [&](const auto &parts) {
      for (uint32_t k = 0; k < parts.size(); ++k) {
        if (parts[k].name != name) continue;
        *part = public_part(parts, kind, k);
        return;
      }
      fail(MVS_E_ID, name, "the valve has no %s named \"%.63s\"%s", kind_name(kind), name,
           near_names(name, parts).c_str());
    });
  });
}

}  // extern "C"
