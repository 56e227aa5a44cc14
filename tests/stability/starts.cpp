// Starts that no closure would give: closed, inverted, crumpled, with one leaflet in the other.
#include <random>

#include "tests/stability/case.h"
#include "tests/stability/valves.h"

namespace stability {
namespace {

using Point = std::array<double, 3>;

bool is_free(uint8_t kind) {
  return kind == MVS_NODE_KIND_LEAFLET || kind == MVS_NODE_KIND_BRANCH;
}

void close(Watch &watch) {
  watch.load(MVS_SYSTOLE_PA);
  watch.rest();
}

Case start(const std::string &name, std::function<void(Watch &, const std::string &)> prepare) {
  Case made{"starts/" + name, close};
  made.prepare = std::move(prepare);
  return made;
}

void displaced(Watch &watch, const mvs::Snapshot &from, const Displacement &displacement) {
  watch.attempt(set_displaced(watch.sim(), from, Places::now, displacement));
}

mvs::Snapshot open_valve(const std::string &valve) {
  mvs::Simulator sim;
  make_valve(sim, valve);
  return sim.snapshot();
}

// The free nodes mirrored into the atrium at the annulus plane.
void invert(Watch &watch, const std::string &valve) {
  const mvs::Snapshot open = open_valve(valve);
  const auto f = open.frame();
  displaced(watch, open, [=](size_t, uint8_t kind, Point at) {
    if (!is_free(kind)) return at;
    double height = 0;
    for (size_t k = 0; k < 3; ++k) height += f[9 + k] * (at[k] - f[k]);
    for (size_t k = 0; k < 3; ++k) at[k] -= 2 * height * f[9 + k];
    return at;
  });
}

// Every free node at a random place within a cube of this size about its place.
auto crumple(double size) {
  return [=](Watch &watch, const std::string &valve) {
    std::mt19937 random(1);
    // not std::uniform_real_distribution, which differs between libraries
    const auto draw = [&] { return size * (static_cast<double>(random()) / 4294967296.0 - 0.5); };
    displaced(watch, open_valve(valve), [&](size_t, uint8_t kind, Point at) {
      const Point by = {draw(), draw(), draw()};
      for (size_t k = 0; k < 3 && is_free(kind); ++k) at[k] += by[k];
      return at;
    });
  };
}

// A closed valve whose half on one side of the valve's axis is pushed through the other.
void push_through(Watch &watch, const std::string &valve) {
  const mvs::Snapshot &closed = closed_valve(valve);
  const auto f = closed.frame();
  displaced(watch, closed, [=](size_t, uint8_t kind, Point at) {
    double along = 0, below = 0;
    for (size_t k = 0; k < 3; ++k) {
      along += f[3 + k] * (at[k] - f[k]);
      below -= f[9 + k] * (at[k] - f[k]);
    }
    if (!is_free(kind) || along < 0 || below < 2e-3) return at;
    for (size_t k = 0; k < 3; ++k) at[k] -= 4e-3 * f[3 + k];
    return at;
  });
}

void collapse(Watch &watch, const std::string &valve) {
  const mvs::Snapshot open = open_valve(valve);
  const auto f = open.frame();
  displaced(watch, open, [=](size_t, uint8_t kind, Point at) {
    return is_free(kind) ? Point{f[0], f[1], f[2]} : at;
  });
}

// Opens a closed valve, and closes it again.
void reopen(Watch &watch) {
  watch.load(0, 0);
  watch.rest();
  close(watch);
}

}  // namespace

std::vector<Case> start_cases() {
  Case point = start("all_in_one_point", collapse);
  point.may_refuse = true;
  return {{"starts/closed", close},
          {"starts/closed_opened_closed", reopen},
          start("inverted", invert),
          start("crumpled_0.5mm", crumple(0.5e-3)),
          start("crumpled_5mm", crumple(5e-3)),
          start("intersecting", push_through),
          point};
}

}  // namespace stability
