// Checks the sizes of lists and the ranges of indices.
#include <cmath>

#include "model/checks/checks.h"

namespace mvs::core {
namespace {

// Larger than any valve that can be computed, and far below the overflow of an index.
constexpr size_t list_limit = size_t{1} << 24;

void check_count(const char *what, size_t count, bool needed, Faults &faults) {
  if (needed && count == 0) {
    faults.add(what, "the valve has no %s", what);
  } else if (count > list_limit) {
    faults.add(what, "the valve has %zu %s, the limit is %zu", count, what, list_limit);
  }
}

void check_length(const char *what, const char *of, size_t count, size_t expected, bool optional,
                  Faults &faults) {
  if (count == expected || (optional && count == 0)) return;
  faults.add(what, "%s has %zu entries, there are %zu %s: give one for each%s", what, count,
             expected, of, optional ? ", or none at all" : "");
}

// Checks that entry `number` of the list `what` refers to one of `count` items.
void check_index(const char *what, size_t number, const char *of, size_t index, size_t count,
                 Faults &faults) {
  if (index < count) return;
  const std::string part = format("%s %zu", what, number);
  faults.add(part, "%s names %s %zu, but there are %zu: indices start at 0", part.c_str(), of,
             index, count);
}

void check_curve_index(const Valve &valve, size_t chord, Faults &faults) {
  const double curve = valve.chords[chord].constants[0];
  const bool whole = curve >= 0 && curve < list_limit && curve == std::floor(curve);
  check_index("chord", chord, "curve", whole ? static_cast<size_t>(curve) : SIZE_MAX,
              valve.curves.size(), faults);
}

void check_counts(const Valve &valve, Faults &faults) {
  check_count("nodes", valve.rest.size(), true, faults);
  check_count("triangles", valve.triangles.size(), true, faults);
  check_count("annulus nodes", valve.annulus.size(), true, faults);
  check_count("leaflets", valve.leaflets.size(), true, faults);
  check_count("scallops", valve.scallops.size(), false, faults);
  check_count("chords", valve.chords.size(), false, faults);
  check_count("heads", valve.heads.size(), false, faults);
  check_count("rings", valve.rings.size(), false, faults);
  check_count("curves", valve.curves.size(), false, faults);
}

void check_lengths(const Valve &valve, Faults &faults) {
  const size_t n = valve.rest.size(), m = valve.triangles.size();
  check_length("nodes_open", "nodes", valve.open.size(), n, true, faults);
  check_length("origin", "nodes", valve.origin.size(), n, true, faults);
  check_length("nodes_loaded", "nodes", valve.loaded.size(), n, true, faults);
  check_length("triangle_leaflet", "triangles", valve.triangle_leaflet.size(), m, false, faults);
  check_length("triangle_scallop", "triangles", valve.triangle_scallop.size(), m,
               valve.scallops.empty(), faults);
  check_length("triangle_thickness", "triangles", valve.triangle_thickness.size(), m, true, faults);
  check_length("triangle_fibre", "triangles", valve.triangle_fibre.size(), m, true, faults);
}

void check_triangle_indices(const Valve &valve, Faults &faults) {
  const size_t n = valve.rest.size();
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    for (const uint32_t node : valve.triangles[t]) {
      check_index("triangle", t, "node", node, n, faults);
    }
  }
  for (size_t t = 0; t < valve.triangle_leaflet.size(); ++t) {
    check_index("triangle", t, "leaflet", valve.triangle_leaflet[t], valve.leaflets.size(), faults);
  }
  for (size_t t = 0; t < valve.triangle_scallop.size(); ++t) {
    check_index("triangle", t, "scallop", valve.triangle_scallop[t], valve.scallops.size(), faults);
  }
}

void check_other_indices(const Valve &valve, Faults &faults) {
  const size_t n = valve.rest.size();
  for (size_t k = 0; k < valve.annulus.size(); ++k) {
    check_index("annulus entry", k, "node", valve.annulus[k], n, faults);
  }
  for (size_t s = 0; s < valve.scallops.size(); ++s) {
    const std::string &name = valve.scallops[s].name;
    if (valve.scallops[s].leaflet == none && !valve.triangle_scallop.empty()) {
      faults.add(format("scallop %zu", s), "scallop %s has no triangle: leave it out",
                 name.c_str());
      continue;
    }
    check_index("scallop", s, "leaflet", valve.scallops[s].leaflet, valve.leaflets.size(), faults);
  }
  for (size_t c = 0; c < valve.chords.size(); ++c) {
    check_index("chord", c, "node", valve.chords[c].a, n, faults);
    check_index("chord", c, "node", valve.chords[c].b, n, faults);
    if (valve.chords[c].law == ChordLawId::table) check_curve_index(valve, c, faults);
  }
  for (size_t h = 0; h < valve.heads.size(); ++h) {
    check_index("papillary head", h, "node", valve.heads[h].node, n, faults);
  }
}

}  // namespace

void check_lists(const Valve &valve, Faults &faults) {
  check_counts(valve, faults);
  check_lengths(valve, faults);
  check_triangle_indices(valve, faults);
  check_other_indices(valve, faults);
}

}  // namespace mvs::core
