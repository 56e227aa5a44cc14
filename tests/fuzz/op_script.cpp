// The calls of a script, each with the bits that it has to leave.
#include "tests/fuzz/op_script.h"

#include <mvs/mvs.hpp>
#include <mvs/tool.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "tests/founding.h"
#include "tests/fuzz/op_builder.h"
#include "tests/stability/crossings.h"

namespace fuzz {
namespace {

using Hash = std::array<uint64_t, 2>;

void demand(bool condition, const char *what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_ops: %s\n", what);
  std::abort();
}

// A simulator, and the hashes expected from its history.
class Script {
 public:
  explicit Script(const uint8_t *data, size_t size) : bytes_(data, size) {
    desc_.vertices = 200;
    desc_.chords = 30;
    desc_.branching = bytes_.below(2);
    replays_ = bytes_.below(4) == 0;
    sim_.generate(desc_);
    first_ = undone_ = hash();
  }

  void run() {
    for (int k = 0; k < 40 && !bytes_.done(); ++k) {
      act();
      if (history().done == 0) first_ = hash();
    }
    if (replays_) replay();
    while (mvs_undo(sim_.get()) == MVS_OK) {
    }
    demand(hash() == first_, "undoing everything did not give what was before the first operation");
  }

 private:
  Hash hash() const {
    const auto found = sim_.snapshot().hash();
    return {found[0], found[1]};
  }

  mvs_history history() const {
    return mvs::filled<mvs_history>(mvs_snapshot_get_history, sim_.snapshot().get());
  }

  void act() {
    switch (bytes_.below(14)) {
      case 0:
        return undo();
      case 1:
        return redo();
      case 2:
        return settle();
      case 3:
        return step();
      case 4:
        return save_and_load();
      case 5:
        return checkpoint();
      case 6:
        return add_tool();
      case 7:
        return move_hands_and_step();
      case 8:
        return remove_tool();
      default:
        return operate();
    }
  }

  // Check and apply agree; a refusal changes nothing; undo restores the hash before, redo the hash
  // after.
  void operate() {
    const mvs::Snapshot valve = sim_.snapshot();
    Builder builder(valve, bytes_);
    const mvs_op *op = builder.build();
    const Hash before = hash();
    const uint32_t done = history().done;
    const mvs_result checked = mvs_check_op(sim_.get(), op);
    demand(hash() == before, "a check changed something");
    const mvs_result applied = mvs_apply_op(sim_.get(), op, nullptr);
    demand(checked == applied, "check and apply disagree");
    if (applied != MVS_OK) {
      demand(applied == MVS_E_OP || applied == MVS_E_ID || applied == MVS_E_ARGUMENT,
             mvs_last_error()->message);
      demand(hash() == before && history().done == done, "a refused operation changed something");
      return;
    }
    const Hash after = hash();
    mvs::must(mvs_undo(sim_.get()));
    demand(hash() == before, "undo did not give the bits before");
    mvs::must(mvs_redo(sim_.get()));
    demand(hash() == after, "redo did not give the bits after");
  }

  void undo() {
    const bool any = history().done > 0;
    demand((mvs_undo(sim_.get()) == MVS_OK) == any, "undo where there is none, or none where");
    if (any && history().done == 0) undone_ = hash();
  }
  void redo() {
    const mvs_history before = history();
    const bool any = before.undone > 0;
    demand((mvs_redo(sim_.get()) == MVS_OK) == any, "redo where there is none, or none where");
    if (any && before.done == 0) first_ = undone_;
  }

  void settle() {
    sim_.set_load(bytes_.between(0, 20e3), bytes_.between(0, 1));
    mvs_settle_options options = mvs::sized<mvs_settle_options>();
    options.max_iterations = 3;
    move([&] { return mvs_settle(sim_.get(), &options, nullptr); });
  }

  void step() {
    move([&] { return mvs_step(sim_.get(), nullptr); });
  }

  std::vector<mvs_tool_state> tools() const { return mvs::tools_of(sim_.snapshot()); }

  // An existing tool, rarely another id.
  mvs_id some_tool() {
    const std::vector<mvs_tool_state> all = tools();
    if (all.empty() || bytes_.below(16) == 0) return (mvs_id{1} << 48) + bytes_.below(9);
    return all[bytes_.below(static_cast<uint32_t>(all.size()))].id;
  }

  std::array<double, 3> place() {
    return {bytes_.between(-0.03, 0.03), bytes_.between(-0.03, 0.03), bytes_.between(-0.03, 0.03)};
  }

  // A grasp of a node, or a ball or rod at a place, mostly in range.
  void add_tool() {
    mvs_tool_desc desc = mvs::sized<mvs_tool_desc>();
    desc.kind = bytes_.below(16) == 0 ? bytes_.below(6) : 1 + bytes_.below(3);
    std::copy_n(place().data(), 3, desc.position);
    std::copy_n(place().data(), 3, desc.axis);
    desc.by_node = bytes_.below(2);
    desc.node = bytes_.below(250);
    desc.reach = bytes_.between(0, 0.02);
    if (bytes_.below(2)) desc.radius = bytes_.between(1e-4, 5e-3);
    if (bytes_.below(2)) desc.length = bytes_.between(0, 0.05);
    if (bytes_.below(2)) desc.stiffness = 200 * bytes_.between(0, 10);
    const Hash before = hash();
    mvs_id tool = 0;
    const mvs_result added = mvs_add_tool(sim_.get(), &desc, &tool);
    had_tools_ = had_tools_ || added == MVS_OK;
    if (added == MVS_OK) return;
    demand(added == MVS_E_ARGUMENT || added == MVS_E_STATE, mvs_last_error()->message);
    demand(hash() == before, "a refused tool changed something");
  }

  // Steps with one hand or several that follow a path, or jump.
  void move_hands_and_step() {
    for (uint32_t steps = 1 + bytes_.below(4); steps > 0; --steps) {
      for (uint32_t hands = bytes_.below(3); hands > 0; --hands) move_hand();
      step();
    }
  }

  void move_hand() {
    const mvs_id tool = some_tool();
    mvs_tool_state state = mvs::sized<mvs_tool_state>();
    std::array<double, 3> to = place();
    const bool is_there = mvs_get_tool(sim_.get(), tool, &state) == MVS_OK;
    if (is_there && bytes_.below(4) != 0) {
      for (size_t k = 0; k < 3; ++k) to[k] = state.position[k] + 0.05 * to[k];
    }
    const std::array<double, 3> axis = place();
    const Hash before = hash();
    const mvs_result moved =
        mvs_move_tool(sim_.get(), tool, to.data(), bytes_.below(2) ? axis.data() : nullptr);
    demand(moved == (is_there ? MVS_OK : MVS_E_ID), mvs_last_error()->message);
    demand(hash() == before, "a hand moved a tool before a step began");
  }

  void remove_tool() {
    const mvs_id tool = some_tool();
    mvs_tool_state state = mvs::sized<mvs_tool_state>();
    const bool is_there = mvs_get_tool(sim_.get(), tool, &state) == MVS_OK;
    const Hash before = hash();
    const mvs_result removed = mvs_remove_tool(sim_.get(), tool);
    demand(removed == (is_there ? MVS_OK : MVS_E_ID), mvs_last_error()->message);
    demand(is_there != (hash() == before), "a tool was not removed, or none changed something");
  }

  // The plan, from the valve as it was made.
  void replay() {
    const mvs::Snapshot end = sim_.snapshot();
    mvs::Simulator again;
    again.generate(desc_);
    const mvs_replay replay = again.replay_plan(end.plan());
    demand(replay.same_valve == 1, "the plan is not of its valve");
    demand(replay.same_result == 1 && again.snapshot().hash() == end.hash(),
           "the plan does not lead to the same bits");
  }

  // Triangles that cross after a move crossed before it: operations may create crossings, moves
  // not.
  template <typename Call>
  void move(Call &&call) {
    const std::vector<stability::Pair> before = crossing();
    tolerate(call());
    const std::vector<stability::Pair> after = crossing();
    demand(std::includes(before.begin(), before.end(), after.begin(), after.end()),
           "a move made triangles cross");
    for (const mvs_tool_state &tool : tools()) {
      demand(tool.kind == MVS_TOOL_KIND_GRASP || tool.distance > 0, "a tool lies in tissue");
    }
  }

  std::vector<stability::Pair> crossing() const {
    const mvs::Snapshot now = sim_.snapshot();
    const auto x = now.view<double>(MVS_ARRAY_NODE_POSITION);
    const auto triangles = now.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
    demand(std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }),
           "a place is no number");
    return stability::crossings(x.data(), x.rows(), triangles.data(), triangles.rows());
  }

  // An operation may make a valve whose forces overflow; that is reported, and changes nothing.
  void tolerate(mvs_result result) {
    demand(result == MVS_OK || result == MVS_E_DIVERGED, mvs_last_error()->message);
  }

  // A copy made through a file continues with the same bits.
  void save_and_load() {
    step();  // stores the positions of the hands: files do not hold pending moves
    const mvs::Snapshot valve = sim_.snapshot();
    mvs::Simulator copy;
    // OBJ files hold neither tools nor the next tool id
    const bool wants_whole = bytes_.below(2) == 1 || had_tools_;
    const bool whole = wants_whole && std::strstr(mvs_features(), "hdf5");
    if (wants_whole && !whole) return;
    const uint32_t how = whole ? MVS_FORMAT_H5 : MVS_FORMAT_OBJ;
    copy.load_memory(valve.save_memory(how), how);
    demand(copy.snapshot().hash() == valve.hash(), "the valve changed on its way through a file");
    const std::string plan = valve.plan();
    demand(mvs_step(copy.get(), nullptr) == mvs_step(sim_.get(), nullptr),
           "the copy does not step as the original does");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy went another way");
    if (!whole) return;
    // a session file has the history too
    undo();
    demand(mvs_undo(copy.get()) == MVS_OK || history().done == 0, "the copy has no history");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy undid something else");
    redo();
    demand(mvs_redo(copy.get()) == MVS_OK || history().undone == 0, "the copy has no future");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy redid something else");
  }

  void checkpoint() {
    if (bytes_.below(2) == 0) {
      mvs::must(mvs_set_checkpoint(sim_.get(), "here"));
      kept_ = {hash(), first_, undone_};
      return;
    }
    const mvs_result result = mvs_restore_checkpoint(sim_.get(), "here");
    demand((result == MVS_OK) == (kept_.size() == 3), mvs_last_error()->message);
    if (result != MVS_OK) return;
    demand(hash() == kept_[0], "a checkpoint came back with other bits");
    first_ = kept_[1];
    undone_ = kept_[2];
  }

  mvs::Simulator sim_;
  mvs_parametric_desc desc_ = founding_valve();
  Bytes bytes_;
  bool replays_ = false, had_tools_ = false;
  Hash first_{};   // expected after undoing everything: the hash before the first operation
  Hash undone_{};  // the same for the operations that can be redone from there
  std::vector<Hash> kept_;  // of the checkpoint: its hash, and both of the above
};

}  // namespace

void run_op_script(const uint8_t *data, size_t size) {
  Script(data, size).run();
}

}  // namespace fuzz
