// Events out of range are refused by every reader, with the range.
#include "history/event_limits.h"

#include <doctest/doctest.h>
#include <string>

#include "formats/plan/plan.h"
#include "formats/session/checks.h"

using namespace mvs::core;

namespace {

RecordedEvent step_of(double dt, double damping = 0, uint32_t budget = 0) {
  RecordedEvent event;
  event.kind = RecordedEvent::step;
  event.dt = dt;
  event.damping = damping;
  event.budget = budget;
  return event;
}

RecordedEvent load_of(double pressure, double fraction) {
  RecordedEvent event;
  event.pressure = pressure;
  event.boundary_fraction = fraction;
  return event;
}

RecordedEvent ball_of(double radius, double stiffness, double force) {
  Tool tool;
  tool.kind = ToolKind::ball;
  tool.id = first_tool_id;
  tool.radius = radius;
  tool.stiffness = stiffness;
  tool.max_force = force;
  RecordedEvent event;
  event.kind = RecordedEvent::tool_add;
  event.tools = {tool};
  return event;
}

RecordedEvent at(RecordedEvent::Kind kind, const Vec3 &place) {
  RecordedEvent event = ball_of(3e-3, 200, 5);
  event.kind = kind;
  event.tools[0].position = place;
  return event;
}

}  // namespace

TEST_CASE("events_within_the_ranges_of_the_interface_are_read") {
  for (const RecordedEvent &event :
       {step_of(0), step_of(1e-9), step_of(1, 1e6, 4), step_of(1e-3, 1e-6, 10000),
        load_of(400e3, 1), load_of(-400e3, 0), ball_of(1e-4, 1e5, 100), ball_of(0.02, 0.5, 1e-3),
        at(RecordedEvent::tool_add, {10, -10, 0}), at(RecordedEvent::tool_move, {0, 10, -10})}) {
    CHECK(fault_of(event) == "");
    CHECK_NOTHROW(check_event(event));
    Json steps = Json::array();
    steps.add(event_json(event));
    CHECK(read_steps(steps).size() == 1);
  }
}

TEST_CASE("events_out_of_range_are_refused_by_plans_and_sessions") {
  RecordedEvent newton = step_of(1e-3);
  newton.solver = SolverKind::newton;
  RecordedEvent loose;
  loose.kind = RecordedEvent::settle;
  loose.residual = 1e30;
  struct Case {
    RecordedEvent event;
    const char *sentence;
  };
  const Case cases[] = {
      {step_of(-1e-3), "dt is -0.001: it has to be 0 (the default) or 1e-09 to 1"},
      {step_of(1000), "dt is 1000"},
      {step_of(1e-3, -5), "the damping is -5"},
      {step_of(1e-3, 0, 1), "the budget is 1: it has to be 0 (the default) or 4 to 10000"},
      {newton, "the solver of a step is newton"},
      {loose, "the residual is 1e+30"},
      {load_of(1e12, 1), "the pressure is 1e+12 Pa: it has to be within 400000 Pa"},
      {load_of(0, 3), "the boundary fraction is 3"},
      {ball_of(4, 200, 5), "the radius is 4: it has to be 0.0001 to 0.02"},
      {ball_of(3e-3, 1e300, 5), "the stiffness is 1e+300"},
      {ball_of(3e-3, 200, 1e9), "the largest force is 1e+09"},
      {at(RecordedEvent::tool_add, {10.1, 0, 0}), "the position is (10.1, 0, 0) m"},
      {at(RecordedEvent::tool_move, {0, 0, -1e300}), "each has to be a number within 10"},
  };
  for (const Case &one : cases) {
    CAPTURE(one.sentence);
    Json steps = Json::array();
    steps.add(event_json(one.event));
    CHECK_THROWS_WITH_AS(read_steps(steps), doctest::Contains(one.sentence), Error);
    CHECK_THROWS_WITH_AS(check_event(one.event), doctest::Contains(one.sentence), Error);
  }
}
