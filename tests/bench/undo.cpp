// Cost of undo: memory a level, and the time of undo and redo beside a step, in one run. Each level
// is an operation after a step, so that no two levels have the same positions. Fails if undoing all
// of them does not restore the valve before the first one, or redoing all does not restore the last
// one.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <mvs/mvs.hpp>
#include <vector>

namespace {

double seconds() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

// Memory of this process, bytes.
double resident() {
  std::ifstream file("/proc/self/statm");
  double total = 0, pages = 0;
  file >> total >> pages;
  return 4096 * pages;
}

template <typename Call>
double timed(Call call) {
  const double start = seconds();
  call();
  return seconds() - start;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

void shorten(mvs::Simulator &sim, const std::vector<mvs_part> &chords, size_t k) {
  mvs_op_chord_length op = {};
  op.op = {sizeof op, MVS_OP_CHORD_LENGTH};
  op.chord = chords[k % chords.size()].id;
  op.factor = 0.999;
  mvs::must(mvs_apply_op(sim.get(), &op.op, nullptr));
}

}  // namespace

int main(int argc, char **argv) {
  const int levels = argc > 1 ? std::atoi(argv[1]) : 2000;
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.vertices = 1000;
  mvs::Simulator sim;
  sim.generate(desc);
  sim.set_load(MVS_SYSTOLE_PA);
  sim.settle();
  const std::vector<mvs_part> chords = sim.snapshot().parts(MVS_PART_CHORD);
  const size_t nodes = sim.snapshot().view<double>(MVS_ARRAY_NODE_POSITION).rows();
  std::vector<double> step, apply, undo, redo;
  std::array<uint64_t, 2> first = {};
  const double before = resident();
  for (int k = 0; k < levels; ++k) {
    step.push_back(timed([&] { sim.step(); }));
    if (k == 0) first = sim.snapshot().hash();
    apply.push_back(timed([&] { shorten(sim, chords, static_cast<size_t>(k)); }));
  }
  const double grown = resident() - before;
  const auto last = sim.snapshot().hash();
  for (int k = 0; k < levels; ++k) undo.push_back(timed([&] { sim.undo(); }));
  const bool is_first = sim.snapshot().hash() == first;
  for (int k = 0; k < levels; ++k) redo.push_back(timed([&] { sim.redo(); }));
  const bool is_last = sim.snapshot().hash() == last;
  std::printf("%zu nodes, %zu chords, %d levels: %.1f MB, %.1f kB a level\n", nodes, chords.size(),
              levels, grown / 1e6, grown / 1e3 / levels);
  std::printf("median: step %.3f ms, apply %.3f ms, undo %.4f ms, redo %.4f ms\n",
              1e3 * median(step), 1e3 * median(apply), 1e3 * median(undo), 1e3 * median(redo));
  std::printf("undo / step %.4f, redo / step %.4f\n", median(undo) / median(step),
              median(redo) / median(step));
  if (!is_first) std::fprintf(stderr, "all undone, this is not the valve that it was\n");
  if (!is_last) std::fprintf(stderr, "all redone, this is not the valve that it was\n");
  return is_first && is_last ? 0 : 1;
}
