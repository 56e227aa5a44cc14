// Tool trajectories: steps with moving hands are stored in runs, and every step returns each hand's
// position.
#include "history/tool_trajectory.h"

#include <doctest/doctest.h>
#include <map>
#include <random>

using namespace mvs::core;

namespace {

using Random = std::mt19937;

constexpr Id grasp_id = first_tool_id, rod_id = first_tool_id + 1, ball_id = first_tool_id + 2;

RecordedEvent hand(Id id, ToolKind kind, Random &random) {
  std::uniform_real_distribution<double> at(-0.05, 0.05);
  Tool tool;
  tool.id = id;
  tool.kind = kind;
  tool.position = Vec3(at(random), at(random), at(random));
  if (kind == ToolKind::rod) tool.axis = Vec3(at(random), at(random), 1).normalized();
  RecordedEvent event;
  event.kind = RecordedEvent::tool_move;
  event.tools = {tool};
  return event;
}

RecordedEvent one_step(double dt) {
  RecordedEvent step;
  step.kind = RecordedEvent::step;
  step.dt = dt;
  return step;
}

// Position of each hand and length of the step, step by step.
struct Seen {
  double dt;
  std::map<Id, std::pair<Vec3, Vec3>> hands;
  bool operator==(const Seen &) const = default;
};

class Follower {
 public:
  void hand(const Tool &tool) { hands_[tool.id] = {tool.position, tool.axis}; }
  void step(double dt, uint64_t count) {
    for (uint64_t k = 0; k < count; ++k) seen.push_back({dt, hands_});
  }
  void take(const RecordedEvent &event) {
    if (event.kind == RecordedEvent::step) return step(event.dt, event.count);
    REQUIRE(event.kind == RecordedEvent::tool_trajectory);
    REQUIRE(is_consistent(event));
    State state;
    for (const Tool &tool : event.tools.get()) state.tools.push_back(tool);
    for (size_t row = 0; row < event.steps_per_row.size(); ++row) {
      apply_row(state, event, row);
      for (const Tool &tool : state.tools.get()) hand(tool);
      step(event.dt, event.steps_per_row.get()[row]);
    }
  }
  std::vector<Seen> seen;

 private:
  std::map<Id, std::pair<Vec3, Vec3>> hands_;
};

// Random activity of a hand: which tools move before the next step.
std::vector<RecordedEvent> some_hands(Random &random, uint32_t which) {
  std::vector<RecordedEvent> hands;
  if (which & 1) hands.push_back(hand(grasp_id, ToolKind::grasp, random));
  if (which & 2) hands.push_back(hand(rod_id, ToolKind::rod, random));
  if (which & 4) hands.push_back(hand(ball_id, ToolKind::ball, random));
  return hands;
}

size_t runs(const RecordedEvents &events) {
  return events.size();
}

}  // namespace

TEST_CASE("every_recorded_step_returns_each_hands_position") {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Follower direct, kept;
    RecordedEvents events;
    for (int k = 0; k < 500; ++k) {
      const double dt = random() % 100 == 0 ? 2e-3 : 1e-3;
      const std::vector<RecordedEvent> hands = some_hands(random, random() % 4 ? random() % 8 : 1);
      RecordedEvent next = hands.empty() ? one_step(dt) : trajectory_event(hands, one_step(dt));
      events = with_event(events, next);
      for (const RecordedEvent &event : hands) direct.hand(event.tools.get()[0]);
      direct.step(dt, 1);
    }
    for (const RecordedEvent *event : events.items()) kept.take(*event);
    CHECK(direct.seen == kept.seen);
  }
}

TEST_CASE("a_run_continues_independently_of_when_it_was_read") {
  // read after every step, never, or at irregular times: the same runs
  for (const int every : {1, 7, 1000000}) {
    CAPTURE(every);
    Random random(3);
    RecordedEvents events, plain;
    RecordedEvent kept;
    kept.count = 0;
    for (int k = 0; k < 700; ++k) {
      const bool moves_on = k % 3 != 1;
      const auto hands = moves_on ? some_hands(random, 3) : std::vector<RecordedEvent>();
      RecordedEvent next = hands.empty() ? one_step(1e-3) : trajectory_event(hands, one_step(1e-3));
      plain = with_event(plain, next);
      if (kept.count > 0) append_steps(kept, next);
      if (next.count > 0) {
        if (kept.count > 0) events = with_event(events, kept);
        kept = next;
      }
      if (k % every == 0) {
        events = with_event(events, kept);
        kept = RecordedEvent();
        kept.count = 0;
      }
    }
    if (kept.count > 0) events = with_event(events, kept);
    REQUIRE(runs(events) == runs(plain));
    for (size_t k = 0; k < runs(events); ++k) CHECK(*events.items()[k] == *plain.items()[k]);
  }
}

TEST_CASE("hands_that_move_in_turn_form_one_run") {
  Random random(1);
  RecordedEvents events;
  for (int k = 0; k < 200; ++k) {
    events =
        with_event(events, trajectory_event(some_hands(random, k % 2 ? 1 : 4), one_step(1e-3)));
  }
  // a step of the hand that came first, a full run of both; then the remaining 71 steps
  CHECK(runs(events) == 4);
}

TEST_CASE("a_resting_hand_needs_no_memory") {
  Random random(1);
  RecordedEvents events;
  events = with_event(events, trajectory_event(some_hands(random, 1), one_step(1e-3)));
  for (int k = 0; k < 100000; ++k) events = with_event(events, one_step(1e-3));
  REQUIRE(runs(events) == 1);
  CHECK(events.top().steps_per_row.size() == 1);
  CHECK(events.top().count == 100001);
  // other steps form another run
  events = with_event(events, one_step(2e-3));
  CHECK(runs(events) == 2);
}
