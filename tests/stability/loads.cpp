// Pressure far out of range, reversed at each step; steps from 0.01 to 20 ms.
#include <cstdio>

#include "tests/stability/case.h"
#include "tests/stability/valves.h"

namespace stability {
namespace {

Case pressure(const std::string &name, double pascal) {
  return {"loads/pressure_" + name, [=](Watch &w) {
            w.load(pascal);
            w.rest();
          }};
}

void switched(Watch &watch) {
  for (uint32_t k = 0; k < watch.effort().live; ++k) {
    watch.load(k % 2 ? MVS_SYSTOLE_PA : -MVS_SYSTOLE_PA);
    watch.step(watch.effort().dt);
  }
}

void open(Watch &watch, const std::string &valve) {
  make_valve(watch.sim(), valve);
}

// From open under the whole pressure at once, then with the annulus reduced to a half.
Case steps_of(double dt) {
  char name[32];
  std::snprintf(name, sizeof name, "loads/dt_%g_ms", dt * 1e3);
  Case made{name, [=](Watch &w) {
              w.load(MVS_SYSTOLE_PA);
              for (uint32_t k = 0; k < w.effort().live; ++k) w.step(dt);
              mvs_op_annulus_scale op = {};
              op.factor = 0.5;
              w.operate(op, MVS_OP_ANNULUS_SCALE);
              for (uint32_t k = 0; k < w.effort().live; ++k) w.step(dt);
            }};
  made.modes = {SolverMode::live};
  made.prepare = open;
  return made;
}

}  // namespace

std::vector<Case> load_cases() {
  std::vector<Case> all = {pressure("x10", 10 * MVS_SYSTOLE_PA),
                           pressure("negative", -MVS_SYSTOLE_PA),
                           pressure("negative_x10", -10 * MVS_SYSTOLE_PA)};
  Case turned{"loads/pressure_switched_each_step", switched};
  turned.modes = {SolverMode::live};
  all.push_back(turned);
  for (const double dt : {1e-5, 1e-4, 1e-3, 5e-3, 20e-3}) all.push_back(steps_of(dt));
  return all;
}

}  // namespace stability
