// Sessions with states, histories and names that no simulator has are refused, whatever their
// checksum says.
#ifdef MVS_HAVE_HDF5
#include <functional>

#include "formats/hdf5/tree.h"
#include "formats/session/layout.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

// A valve with a ball 1 m away, an operation of a group and a checkpoint.
Snapshot a_session() {
  const Pair pair = moving_valve();
  Valve valve = pair.model.valve;
  valve.rings = {};  // they would hold the annulus
  Snapshot now{{make_model(std::move(valve)), pair.state}, {}};
  Tool ball;
  ball.id = first_tool_id;
  ball.kind = ToolKind::ball;
  ball.radius = 2e-3;
  ball.stiffness = 200;
  ball.max_force = 5;
  ball.position = ball.proxy[0] = ball.proxy[1] = Vec3(0, 0, 1);
  now.current.state.tools = {ball};
  now.current.state.tools_made = 1;
  mvs_op_annulus_scale op = {{sizeof op, MVS_OP_ANNULUS_SCALE}, 0.95, 0, 1.1};
  now = after_op(now, Operation(&op.op), {now.history.next_group++, "a group"}, 1700000000000);
  return with_checkpoint(now, "a checkpoint");
}

void check_refused(const char *sentence, const std::function<void(Snapshot &)> &change) {
  Snapshot snapshot = a_session();
  change(snapshot);
  CHECK_THROWS_WITH_AS(read_session(write_session(snapshot, {})), doctest::Contains(sentence),
                       Error);
}

void change_tool(Snapshot &snapshot, const std::function<void(Tool &)> &change) {
  Tool tool = snapshot.current.state.tools.get()[0];
  change(tool);
  snapshot.current.state.tools = {tool};
}

void change_entry(Snapshot &snapshot, const std::function<void(HistoryEntry &)> &change) {
  HistoryEntry entry = **snapshot.history.past.items().front();
  change(entry);
  snapshot.history.past = HistoryEntries().pushed(std::make_shared<const HistoryEntry>(entry));
}

void name_checkpoints(Snapshot &snapshot, std::initializer_list<const char *> names) {
  std::vector<Checkpoint> list;
  for (const char *name : names) {
    list.push_back(snapshot.history.checkpoints->front());
    list.back().name = name;
  }
  snapshot.history.checkpoints = std::make_shared<const std::vector<Checkpoint>>(std::move(list));
}

}  // namespace

TEST_CASE("tools_and_counters_of_a_state_that_cannot_be_are_refused") {
  CHECK_NOTHROW(read_session(write_session(a_session(), {})));
  check_refused("the radius is -1",
                [](Snapshot &now) { change_tool(now, [](Tool &tool) { tool.radius = -1; }); });
  check_refused("not one of the 1 that were added",
                [](Snapshot &now) { change_tool(now, [](Tool &tool) { ++tool.id; }); });
  check_refused("not one of the 0 that were added",
                [](Snapshot &now) { now.current.state.tools_made = 0; });
  check_refused("time steps: they have to be 0 to",
                [](Snapshot &now) { now.current.state.steps = UINT64_MAX; });
}

TEST_CASE("groups_and_names_of_a_history_that_cannot_be_are_refused") {
  check_refused("the next group of the file is 0",
                [](Snapshot &now) { now.history.next_group = 0; });
  check_refused("group 9 with a name of 7 bytes", [](Snapshot &now) {
    change_entry(now, [](HistoryEntry &entry) { entry.group = 9; });
  });
  check_refused("a control character", [](Snapshot &now) {
    change_entry(now, [](HistoryEntry &entry) { entry.title = "red \x1b[31m\n"; });
  });
  check_refused("whose name has 0 bytes", [](Snapshot &now) { name_checkpoints(now, {""}); });
  check_refused("two checkpoints named \"one\"", [](Snapshot &now) {
    name_checkpoints(now, {"one", "two", "one"});
  });
}

TEST_CASE("an_array_that_is_not_of_a_session_is_refused") {
  H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version);
  tree.arrays["mvs/extra"] = {std::vector<uint32_t>{1}};
  CHECK_THROWS_WITH_AS(read_session(write_h5(tree, session_version)),
                       "the file has an array mvs/extra, which is not one of a session", Error);
}
#endif
