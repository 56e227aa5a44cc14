// Memory of a moving hand: bytes a step in memory, in a plan and in a session, with and without a
// snapshot at every step. Fails if a plan does not lead to the same bits, or if a step costs more
// than the headers state.
//
//   bench_hand [STEPS]
#include <malloc.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mvs/mvs.hpp>
#include <mvs/tool.hpp>
#include <string>
#include <vector>

namespace {

// Limits stated in include/mvs/tool.h; a run is not always full, and a session has its snapshots.
constexpr double most_memory = 40, most_plan = 50;  // bytes a step of a hand

// Heap bytes in use by this process; 0 where a sanitizer replaces the heap.
double in_use() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

mvs_id add_grasp(mvs::Simulator &sim, uint32_t node) {
  mvs_tool_desc desc = mvs::sized<mvs_tool_desc>();
  desc.kind = MVS_TOOL_KIND_GRASP;
  desc.by_node = 1;
  desc.node = node;
  const mvs::Snapshot valve = sim.snapshot();
  const double *at = valve.view<double>(MVS_ARRAY_NODE_POSITION).row(node);
  std::memcpy(desc.position, at, sizeof desc.position);
  mvs_id tool = 0;
  mvs::must(mvs_add_tool(sim.get(), &desc, &tool));
  return tool;
}

struct Hand {
  mvs_id tool;
  std::array<double, 3> from;
};

std::vector<Hand> take_hold(mvs::Simulator &sim, size_t count) {
  const mvs::Snapshot valve = sim.snapshot();
  const auto edge = valve.view<uint32_t>(MVS_ARRAY_FREE_EDGE_NODES);
  std::vector<Hand> hands;
  for (size_t k = 0; k < count; ++k) {
    const uint32_t node = edge.data()[k * edge.rows() / count];
    const double *at = valve.view<double>(MVS_ARRAY_NODE_POSITION).row(node);
    hands.push_back({add_grasp(sim, node), {at[0], at[1], at[2]}});
  }
  return hands;
}

void move(mvs::Simulator &sim, const std::vector<Hand> &hands, int step) {
  for (const Hand &hand : hands) {
    std::array<double, 3> at = hand.from;
    at[2] += 1e-3 * std::sin(0.01 * step);
    at[0] += 1e-3 * std::sin(0.013 * step);
    mvs::must(mvs_move_tool(sim.get(), hand.tool, at.data(), nullptr));
  }
}

// Steps with a hand that moves before each, or every fourth.
bool play(const char *name, size_t count, int every, bool looks, int steps) {
  mvs_parametric_desc small = {};
  small.shape = MVS_SHAPE_FOUNDING;
  small.vertices = 200;
  mvs::Simulator sim;
  sim.generate(small);
  const std::vector<Hand> hands = take_hold(sim, count);
  double before = 0;
  const int warm = steps / 10;
  for (int k = 0; k < warm + steps; ++k) {
    if (k == warm) before = in_use();
    if (k % every == 0) move(sim, hands, k);
    sim.step();
    if (looks) sim.snapshot();
  }
  const mvs::Snapshot end = sim.snapshot();
  const double moved = 1.0 * steps / every * static_cast<double>(count);
  const double memory = (in_use() - before) / moved;
  const std::string plan = end.plan();
  const double text = static_cast<double>(plan.size()) / moved * steps / (warm + steps);
  double session = 0;
  if (std::strstr(mvs_features(), "hdf5")) {
    session = static_cast<double>(end.save_memory(MVS_FORMAT_H5).size()) / moved;
  }
  mvs::Simulator again;
  again.generate(small);
  const mvs_replay replay = again.replay_plan(plan);
  std::printf("%-34s %9.0f %8.1f %8.1f %8.1f\n", name, moved, memory, text, session);
  const bool is_same = replay.same_result == 1 && again.snapshot().hash() == end.hash();
  const bool is_small = memory <= most_memory && text <= most_plan;
  if (!is_same) std::fprintf(stderr, "%s: the plan leads elsewhere\n", name);
  if (!is_small) std::fprintf(stderr, "%s: more than tool.h says\n", name);
  return is_same && is_small;
}

}  // namespace

int main(int argc, char **argv) try {
  const int steps = argc > 1 ? std::stoi(argv[1]) : 5000;
  std::printf("%-34s %9s %8s %8s %8s\n", "", "moves", "memory B", "plan B", "h5 B");
  bool good = play("one hand", 1, 1, false, steps);
  good = play("one hand, looked at every step", 1, 1, true, steps) && good;
  good = play("one hand, at every fourth step", 1, 4, false, steps) && good;
  good = play("two hands", 2, 1, false, steps) && good;
  return good ? 0 : 1;
} catch (const std::exception &error) {
  std::fprintf(stderr, "bench_hand: %s\n", error.what());
  return 1;
}
