// Sessions: all of the history comes back to the bit and shared as it was, and no file, however it
// is made, gives anything but a session or a clean error.
#ifdef MVS_HAVE_HDF5
#include <mvs/tool.h>

#include <algorithm>
#include <set>

#include "formats/hdf5/tree.h"
#include "formats/session/layout.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

using Hash128 = std::array<uint64_t, 2>;

Hash128 hash_of(const ModelState &current) {
  return mvs::core::hash_of(*current.model, current.state);
}

template <typename Struct>
Snapshot with_op(const Snapshot &now, Struct op, uint32_t kind, const Group &group = {}) {
  op.op = {sizeof op, kind};
  return after_op(now, Operation(&op.op), group, 1700000000000 + static_cast<int64_t>(kind));
}

// Time goes on: other positions, a move in the history.
Snapshot stepped(const Snapshot &now, uint64_t steps) {
  Snapshot snapshot = now;
  State &state = snapshot.current.state;
  for (Vec3 &x : state.x) x += Vec3(1e-6, 2e-6, -1e-6) * static_cast<double>(steps);
  state.steps += steps;
  state.time += 1e-3 * static_cast<double>(steps);
  RecordedEvent move;
  move.kind = RecordedEvent::step;
  move.dt = 1e-3;
  move.budget = 32;
  for (uint64_t k = 0; k < steps; ++k) {
    snapshot.history.moves = with_move(snapshot.history.moves, move);
  }
  return snapshot;
}

Snapshot loaded(const Snapshot &now, double pressure) {
  Snapshot snapshot = now;
  snapshot.current.state.load = {pressure, 1};
  RecordedEvent move;
  move.pressure = pressure;
  move.boundary_fraction = 1;
  snapshot.history.moves = with_move(snapshot.history.moves, move);
  return snapshot;
}

// A round ring of 28 mm.
Snapshot with_ring(const Snapshot &now) {
  std::vector<Vec3> curve;
  for (int k = 0; k < 24; ++k) {
    const double angle = k * std::acos(-1.0) / 12;
    curve.push_back({14e-3 * std::cos(angle), 14e-3 * std::sin(angle), 0});
  }
  mvs_op_ring ring = {};
  ring.curve = {curve.data(), curve.size(), 3, MVS_TYPE_F64, 0};
  return with_op(now, ring, MVS_OP_RING);
}

Snapshot start() {
  Pair pair = moving_valve();
  return {{std::make_shared<const Model>(pair.model), pair.state}, {}};
}

// Operations with fields of many types, a group, checkpoints, something undone.
Snapshot a_session() {
  const Snapshot first = start();
  const Valve &valve = first.current.model->valve;
  const Id chord = valve.chords[1].id, head = valve.heads[0].id;
  Snapshot now = loaded(stepped(first, 3), 16e3);
  now = with_op(now, mvs_op_chord_length{{}, chord, 0, 0.75, {}}, MVS_OP_CHORD_LENGTH);
  now = with_checkpoint(stepped(now, 2), "short chord");
  const Group group{now.history.next_group++, "two at once"};
  now = with_op(now, mvs_op_annulus_scale{{}, 0.95, 0, 1.1}, MVS_OP_ANNULUS_SCALE, group);
  now =
      with_op(now, mvs_op_head_move{{}, head, {1e-3, -2e-3, 5e-4}, 0, 0}, MVS_OP_HEAD_MOVE, group);
  mvs_op_chord_add added = {};
  added.head = head;
  added.site = {MVS_SITE_NODE, 33, 0, {}};
  added.name = "a new chord";
  now = with_op(stepped(now, 1), added, MVS_OP_CHORD_ADD);
  now = with_ring(now);
  now = with_op(now, mvs_op_chord_remove{{}, chord}, MVS_OP_CHORD_REMOVE);
  now = with_checkpoint(now, "");
  return undone(undone(undone(stepped(now, 4))));
}

std::vector<Hash128> hashes(const HistoryEntries &entries) {
  std::vector<Hash128> all;
  for (const auto *entry : entries.items()) {
    all.push_back(hash_of((*entry)->before));
    all.push_back(hash_of((*entry)->after));
  }
  return all;
}

std::vector<std::string> titles(const HistoryEntries &entries) {
  std::vector<std::string> all;
  for (const auto *entry : entries.items()) {
    const HistoryEntry &e = **entry;
    all.push_back(e.title + "|" + e.group_name + "|" + std::to_string(e.group) + "|" +
                  std::to_string(e.made) + "|" + std::to_string(e.time_ms) + "|" +
                  std::to_string(e.moves.size()));
  }
  return all;
}

mvs_result outcome(const std::string &bytes) {
  try {
    read_session(bytes);
    return MVS_OK;
  } catch (const Error &error) {
    CHECK(error.what()[0] != '\0');
    return error.code;
  }
}

// Changes one word of the moment or of the parts in a file, under a good checksum.
std::string with_word(H5Tree tree, const char *array, size_t at, uint64_t word) {
  std::get<std::vector<uint64_t>>(tree.arrays.at(array).values).at(at) = word;
  return write_h5(tree, session_version);
}

}  // namespace

TEST_CASE("a_session_comes_back_to_the_bit") {
  const Snapshot now = a_session();
  const std::string bytes = write_session(now, {});
  const Snapshot again = read_session(bytes);
  CHECK(hash_of(again.current) == hash_of(now.current));
  REQUIRE(again.history.start);
  CHECK(hash_of(*again.history.start) == hash_of(*now.history.start));
  REQUIRE(now.history.past.size() == 3);
  REQUIRE(now.history.future.size() == 3);
  CHECK(hashes(again.history.past) == hashes(now.history.past));
  CHECK(hashes(again.history.future) == hashes(now.history.future));
  CHECK(titles(again.history.past) == titles(now.history.past));
  CHECK(titles(again.history.future) == titles(now.history.future));
  CHECK(again.history.next_group == now.history.next_group);
  CHECK(again.history.moves.size() == now.history.moves.size());
  REQUIRE(again.history.checkpoints);
  REQUIRE(again.history.checkpoints->size() == 2);
  CHECK(again.history.checkpoints->at(0).name == "short chord");
  CHECK(hash_of(again.history.checkpoints->at(1).at) == hash_of(now.history.checkpoints->at(1).at));
  // whatever else there is would change the bytes
  CHECK(write_session(again, {}) == bytes);
}

TEST_CASE("a_loaded_session_goes_on_as_the_saved_one") {
  Snapshot now = a_session(), again = read_session(write_session(now, {}));
  const mvs_op_chord_remove op = {{}, now.current.model->valve.chords[5].id};
  CHECK(hash_of(with_op(again, op, MVS_OP_CHORD_REMOVE).current) ==
        hash_of(with_op(now, op, MVS_OP_CHORD_REMOVE).current));
  while (!now.history.future.empty()) {
    now = redone(now);
    again = redone(again);
    CHECK(hash_of(again.current) == hash_of(now.current));
  }
  for (const char *name : {"short chord", ""}) {
    CHECK(hash_of(at_checkpoint(again, name).current) == hash_of(at_checkpoint(now, name).current));
  }
  while (!now.history.past.empty()) {
    now = undone(now);
    again = undone(again);
    CHECK(hash_of(again.current) == hash_of(now.current));
  }
  CHECK(again.history.past.empty());
}

TEST_CASE("a_valve_without_history_is_a_session") {
  const Snapshot again = read_session(write_session(start(), {}));
  CHECK(hash_of(again.current) == hash_of(start().current));
  CHECK(again.history.past.empty());
  CHECK(again.history.future.empty());
  CHECK(!again.history.start);
  CHECK(!again.history.checkpoints);
}

// session_v1.h5 is a_session() as version 1 of the format first wrote it. What it has to hold is in
// OBJ files beside it: the operations that made it may do better one day.
TEST_CASE("a_file_of_version_1_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v1";
  const auto told = [&](const char *name) {
    const Pair pair = complete(read_obj(read_whole_file(data + name)));
    return mvs::core::hash_of(pair.model, pair.state);
  };
  Snapshot now = read_session(read_whole_file(data + ".h5"));
  CHECK(hash_of(now.current) == told("_present.obj"));
  CHECK(now.history.future.size() == 3);
  CHECK(hash_of(redone(redone(redone(now))).current) == hash_of(at_checkpoint(now, "").current));
  REQUIRE(now.history.past.size() == 3);
  const Operation &op = now.history.past.items()[0][0]->op;
  REQUIRE(op.kind().number == MVS_OP_CHORD_LENGTH);
  CHECK(op.as<mvs_op_chord_length>().factor == 0.75);
  while (!now.history.past.empty()) now = undone(now);
  CHECK(hash_of(now.current) == told("_undone.obj"));
}

// session_v2.h5 is the same session as version 2 of the format wrote it.
TEST_CASE("a_file_of_version_2_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v";
  Snapshot now = read_session(read_whole_file(data + "2.h5"));
  const Snapshot first = read_session(read_whole_file(data + "1.h5"));
  CHECK(hash_of(now.current) == hash_of(first.current));
  CHECK(now.history.future.size() == 3);
  CHECK(now.history.moves.size() == first.history.moves.size());
  CHECK(now.current.state.tools.empty());
  CHECK(hash_of(at_checkpoint(now, "").current) == hash_of(at_checkpoint(first, "").current));
}

// session_v3.h5 goes on from there: a grasp moved and stepped twice, a ball taken out again.
TEST_CASE("a_file_of_version_3_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v";
  const Snapshot now = read_session(read_whole_file(data + "3.h5"));
  const Snapshot first = read_session(read_whole_file(data + "2.h5"));
  REQUIRE(now.current.state.tools.size() == 1);
  CHECK(now.current.state.tools_made == 2);
  CHECK(now.current.state.steps == first.current.state.steps + 2);
  std::vector<RecordedEvent::Kind> kinds;
  const std::vector<const RecordedEvent *> moves = now.history.moves.items();
  for (size_t k = first.history.moves.size(); k < moves.size(); ++k) {
    kinds.push_back(moves[k]->kind);
  }
  using Kinds = std::vector<RecordedEvent::Kind>;
  CHECK(kinds == Kinds{RecordedEvent::tool_add, RecordedEvent::tool_add, RecordedEvent::tool_move,
                       RecordedEvent::step, RecordedEvent::tool_move, RecordedEvent::step,
                       RecordedEvent::tool_remove});
}

// session_v4.h5 is a parametric valve of which P2/1 was tied to AL1 without a length: then it kept
// its own, and a plan of it has to say so.
TEST_CASE("a_file_of_version_4_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v4.h5";
  const Snapshot now = read_session(read_whole_file(data));
  REQUIRE(now.history.past.size() == 1);
  const auto op = now.history.past.items()[0][0]->op.as<mvs_op_chord_transfer>();
  CHECK(op.end == MVS_CHORD_END_HEAD);
  const std::vector<Chord> &chords = now.current.model->valve.chords;
  const auto chord = std::find_if(chords.begin(), chords.end(),
                                  [&](const Chord &one) { return one.id == op.chord; });
  REQUIRE(chord != chords.end());
  CHECK(op.length == chord->rest_length);
  const Snapshot again = after_op(undone(now), Operation(&op.op), {}, 0);
  CHECK(hash_of(again.current) == hash_of(now.current));
}

TEST_CASE("a_solver_cache_is_part_of_a_session") {
  Snapshot now = start();
  now.current.state.cache = {3, uint64_t{7} << 32 | 9, {0.1, -0.0, 1e300}};
  const Snapshot again = read_session(write_session(now, {}));
  CHECK(hash_of(again.current) == hash_of(now.current));
  CHECK(again.current.state.cache == now.current.state.cache);
}

TEST_CASE("what_levels_share_is_shared_again") {
  const Snapshot again = read_session(write_session(a_session(), {}));
  std::set<const void *> triangles, rests, topologies;
  std::set<const Model *> models;
  for (const HistoryEntries &entries : {again.history.past, again.history.future}) {
    for (const auto *entry : entries.items()) {
      for (const ModelState *current : {&(*entry)->before, &(*entry)->after}) {
        models.insert(current->model.get());
        triangles.insert(current->model->valve.triangles.buffer());
        rests.insert(current->model->valve.rest.buffer());
        topologies.insert(current->model->topology.edges.buffer());
      }
    }
  }
  CHECK(models.size() == 7);
  CHECK(triangles.size() == 1);
  CHECK(topologies.size() == 1);
  CHECK(rests.size() == 1);
  const auto entries = again.history.past.items();
  CHECK((*entries[0])->after.model == (*entries[1])->before.model);
  CHECK(again.current.model == (*entries.back())->after.model);
}

TEST_CASE("a_level_costs_what_it_changed") {
  Snapshot now = start();
  const Id chord = now.current.model->valve.chords[1].id;
  const size_t empty = write_session(now, {}).size();
  constexpr size_t levels = 100;
  for (size_t k = 0; k < levels; ++k) {
    now = with_op(now, mvs_op_chord_length{{}, chord, 0.01 + 1e-6 * static_cast<double>(k), 0, {}},
                  MVS_OP_CHORD_LENGTH);
  }
  const size_t each = (write_session(now, {}).size() - empty) / levels;
  MESSAGE(each << " bytes a level of " << empty);
  // two pictures, of 16 bytes more each since they count instruments and 8 since they say whether
  // there are waypoints, a model, its 12 chords and the operation in words: 2018; positions would
  // be 3264 bytes
  CHECK(each < 2032);
  CHECK(hash_of(read_session(write_session(now, {})).history.past.items()[7][0]->after) ==
        hash_of(now.history.past.items()[7][0]->after));
}

TEST_CASE("numbers_that_are_none_are_not_saved") {
  Snapshot now = start();
  now.current.state.x[5][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(write_session(now, {}), doctest::Contains("go back to an earlier state"));
}

// The checksum is good here: the reader itself has to notice, or to make a session of it.
TEST_CASE("any_changed_word_gives_a_session_or_a_clean_error") {
  const H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version).tree;
  std::array<size_t, 2> seen{};
  for (const char *array : {"mvs/moment", "mvs/parts/values", "mvs/parts/ends"}) {
    const auto words = tree.at<uint64_t>(array);
    // a prime step, so that every kind of word has its turn
    for (size_t k = 0; k<words.size(); k += words.size()> 400 ? 7 : 1) {
      for (const uint64_t word : {words[k] + 1, words[k] - 1, uint64_t{0}, ~uint64_t{0}}) {
        const mvs_result code = outcome(with_word(tree, array, k, word));
        CAPTURE(array);
        CAPTURE(k);
        CAPTURE(code);
        CHECK(
            (code == MVS_OK || code == MVS_E_FORMAT || code == MVS_E_VERSION || code == MVS_E_OP));
        ++seen[code == MVS_OK ? 0 : 1];
      }
    }
  }
  MESSAGE(seen[0] << " changes gave a session, " << seen[1] << " an error");
  CHECK(seen[0] > 0);
  CHECK(seen[1] > 0);
}

TEST_CASE("a_session_without_one_of_its_arrays_is_refused") {
  const H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version).tree;
  for (const auto &entry : tree.arrays) {
    H5Tree without = tree;
    without.arrays.erase(entry.first);
    CHECK_THROWS_WITH(read_session(write_h5(without, session_version)),
                      ("the file has no array " + entry.first).c_str());
  }
}
#endif
