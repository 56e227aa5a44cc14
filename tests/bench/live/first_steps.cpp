#include "tests/bench/live/first_steps.h"

#include <mvs/mvs.hpp>

#include <cstdio>
#include <vector>

#include "tests/bench/live/step_row.h"

namespace bench {

void tell_first_steps(const std::string &scene, const mvs_parametric_desc &valve,
                      const std::function<double()> &now) {
  constexpr int simulators = 9;
  mvs::Simulator closed;
  closed.generate(valve);
  closed.set_load(MVS_SYSTOLE_PA);
  closed.settle();
  closed.set_load(0.9 * MVS_SYSTOLE_PA);
  const mvs::Snapshot start = closed.snapshot();
  std::vector<double> first, second, preparation, prepared;
  const auto time = [&](std::vector<double> &took, const auto &call) {
    const double begin = now();
    call();
    took.push_back(now() - begin);
  };
  for (int k = 0; k < simulators; ++k) {
    mvs::Simulator plain, ready;
    plain.restore(start);
    ready.restore(start);
    time(first, [&] { plain.step(); });
    time(second, [&] { plain.step(); });
    time(preparation, [&] { ready.prepare_step(); });
    time(prepared, [&] { ready.step(); });
  }
  const auto ms = [](const std::vector<double> &took) { return 1e3 * percentile(took, 0.5); };
  std::printf(
      "%s: first step %.2f ms, the second %.2f; mvs_prepare_step %.2f, first step after it "
      "%.2f\n",
      scene.c_str(), ms(first), ms(second), ms(preparation), ms(prepared));
}

}  // namespace bench
