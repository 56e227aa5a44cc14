// Meshes of every size, with slivers and tiny triangles; tissue a million times stiffer beside soft
// tissue.
#include "tests/stability/case.h"
#include "tests/stability/valves.h"

namespace stability {
namespace {

using Point = std::array<double, 3>;

void open(Watch &watch, const std::string &valve) {
  make_valve(watch.sim(), valve);
}

// Closes, then shortens a chord and restores it.
void close_and_pull(Watch &watch) {
  watch.load(MVS_SYSTOLE_PA);
  watch.rest();
  mvs_op_chord_length op = {};
  op.chord = watch.sim().snapshot().parts(MVS_PART_CHORD).front().id;
  op.factor = 0.5;
  watch.operate(op, MVS_OP_CHORD_LENGTH);
  watch.rest();
}

void close(Watch &watch) {
  watch.load(MVS_SYSTOLE_PA);
  watch.rest();
}

// The first of each pair of free neighbours, no two pairs adjacent, every 20th vertex or so: moved
// onto the second but for a share of the edge, which leaves two slivers and tiny triangles around.
std::vector<std::array<uint32_t, 2>> pairs_of(const mvs::Snapshot &valve) {
  const auto kinds = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto triangles = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  std::vector<uint8_t> near(kinds.rows(), 0);
  std::vector<std::array<uint32_t, 2>> pairs;
  for (size_t t = 0; t < triangles.rows(); t += 20) {
    const uint32_t *corner = triangles.row(t);
    bool good = true;
    for (size_t k = 0; k < 3; ++k) {
      good = good && !near[corner[k]] && kinds.data()[corner[k]] == MVS_NODE_KIND_LEAFLET;
    }
    if (!good) continue;
    for (size_t k = 0; k < 3; ++k) near[corner[k]] = 1;
    pairs.push_back({corner[0], corner[1]});
  }
  return pairs;
}

// Lays out the rest shape with those edges shortened to a share of their length.
auto shortened(double share) {
  return [=](Watch &watch, const std::string &name) {
    mvs::Simulator sim;
    make_valve(sim, name);
    const mvs::Snapshot valve = sim.snapshot();
    const auto pairs = pairs_of(valve);
    const auto rest = valve.view<double>(MVS_ARRAY_NODE_REST);
    const auto move = [&](size_t n, uint8_t, Point at) {
      for (const auto &[a, b] : pairs) {
        for (size_t k = 0; k < 3 && n == a; ++k) at[k] += (1 - share) * (rest.row(b)[k] - at[k]);
      }
      return at;
    };
    mvs::Simulator shaped;
    if (!watch.attempt(set_displaced(shaped, valve, Places::rest, move))) return;
    watch.attempt(
        set_displaced(watch.sim(), shaped.snapshot(), Places::now,
                      [&](size_t n, uint8_t kind, Point at) { return move(n, kind, at); }));
  };
}

// The anterior leaflet is ten times softer than the founding tissue, the posterior as stiff as the
// law allows. (A softer anterior leaflet cannot carry the pressure at all: `settle` refuses it as
// yielding without end.)
void stiff_beside_soft(Watch &watch, const std::string &name) {
  make_valve(watch.sim(), name);
  const auto leaflets = watch.sim().snapshot().parts(MVS_PART_LEAFLET);
  for (const mvs_part &leaflet : leaflets) {
    const double scale = leaflet.index == 0 ? 1 : 1e6;
    mvs_leaflet_desc tissue = {};
    tissue.law = MVS_LEAFLET_LAW_SPRING;
    tissue.constants[0] = 1e4 * scale;
    tissue.constants[1] = 6e5 * scale;
    tissue.constants[2] = 0.25;
    watch.sim().set_leaflet(tissue, leaflet.id);
  }
}

Case mesh(const std::string &name, std::function<void(Watch &, const std::string &)> prepare) {
  Case made{"meshes/" + name, close_and_pull};
  made.prepare = std::move(prepare);
  return made;
}

}  // namespace

std::vector<Case> mesh_cases() {
  Case sizes = mesh("size", open);
  sizes.valves = {"200", "S", "S2", "M"};
  sizes.more = {"L", "XL", "N32"};
  Case slivers = mesh("slivers_10_percent", shortened(0.1));
  Case tiny = mesh("slivers_0.1_percent", shortened(1e-3));
  tiny.play = close;
  Case stiff = mesh("stiffness_ratio_1e6", stiff_beside_soft);
  stiff.more = {"M"};
  return {sizes, slivers, tiny, stiff};
}

}  // namespace stability
