// Follows sutures from the node where the two sides of a cut part.
#include "model/seams.h"

namespace mvs::core {
namespace {

uint32_t suture_between(const Model &model, uint32_t a, uint32_t b) {
  const std::vector<Chord> &chords = model.valve.chords;
  for (const uint32_t c : model.topology.node_chords[a]) {
    const bool same = chords[c].a == b || chords[c].b == b;
    if (same && chords[c].kind == ChordKind::suture) return c;
  }
  return none;
}

}  // namespace

Seams find_seams(const Model &model) {
  const std::vector<Chord> &chords = model.valve.chords;
  Seams seams;
  seams.inside.assign(model.node_count(), 0);
  for (const std::vector<uint32_t> &loop : model.topology.free_edges) {
    const size_t n = loop.size();
    for (size_t turn = 0; turn < n; ++turn) {
      uint32_t c = suture_between(model, loop[(turn + n - 1) % n], loop[(turn + 1) % n]);
      if (c == none) continue;
      seams.inside[loop[turn]] = 1;
      std::vector<uint32_t> &nodes = seams.nodes.emplace_back(std::vector{loop[turn]});
      nodes.insert(nodes.end(), {chords[c].a, chords[c].b});
      for (size_t k = 2; 2 * k < n; ++k) {
        const uint32_t next = suture_between(model, loop[(turn + n - k) % n], loop[(turn + k) % n]);
        if (next == none) break;
        seams.inside[chords[c].a] = seams.inside[chords[c].b] = 1;
        seams.sutures.push_back(c);
        c = next;
        nodes.insert(nodes.end(), {chords[c].a, chords[c].b});
      }
    }
  }
  return seams;
}

uint32_t leaflet_of_seam(const Model &model, const std::vector<uint32_t> &nodes) {
  return model.valve.triangle_leaflet[model.topology.node_triangles[nodes[0]][0]];
}

}  // namespace mvs::core
