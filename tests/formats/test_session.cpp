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

Hash128 hash_of(const Picture &picture) {
  return mvs::core::hash_of(*picture.model, picture.state);
}

template <typename Struct>
Moment with_op(const Moment &now, Struct op, uint32_t kind, const Group &group = {}) {
  op.op = {sizeof op, kind};
  return after_op(now, Operation(&op.op), group, 1700000000000 + static_cast<int64_t>(kind));
}

// Time goes on: other positions, a move in the history.
Moment stepped(const Moment &now, uint64_t steps) {
  Moment moment = now;
  State &state = moment.picture.state;
  for (Vec3 &x : state.x) x += Vec3(1e-6, 2e-6, -1e-6) * static_cast<double>(steps);
  state.steps += steps;
  state.time += 1e-3 * static_cast<double>(steps);
  Move move;
  move.kind = Move::step;
  move.dt = 1e-3;
  move.budget = 32;
  for (uint64_t k = 0; k < steps; ++k) {
    moment.timeline.moves = with_move(moment.timeline.moves, move);
  }
  return moment;
}

Moment loaded(const Moment &now, double pressure) {
  Moment moment = now;
  moment.picture.state.load = {pressure, 1};
  Move move;
  move.pressure = pressure;
  move.boundary_fraction = 1;
  moment.timeline.moves = with_move(moment.timeline.moves, move);
  return moment;
}

// A round ring of 28 mm.
Moment with_ring(const Moment &now) {
  std::vector<Vec3> curve;
  for (int k = 0; k < 24; ++k) {
    const double angle = k * std::acos(-1.0) / 12;
    curve.push_back({14e-3 * std::cos(angle), 14e-3 * std::sin(angle), 0});
  }
  mvs_op_ring ring = {};
  ring.curve = {curve.data(), curve.size(), 3, MVS_F64, 0};
  return with_op(now, ring, MVS_OP_RING);
}

Moment start() {
  Pair pair = moving_valve();
  return {{std::make_shared<const Model>(pair.model), pair.state}, {}};
}

// Operations with fields of many types, a group, checkpoints, something undone.
Moment a_session() {
  const Moment first = start();
  const Valve &valve = first.picture.model->valve;
  const Id chord = valve.chords[1].id, head = valve.heads[0].id;
  Moment now = loaded(stepped(first, 3), 16e3);
  now = with_op(now, mvs_op_chord_length{{}, chord, 0, 0.75, {}}, MVS_OP_CHORD_LENGTH);
  now = with_checkpoint(stepped(now, 2), "short chord");
  const Group group{now.timeline.next_group++, "two at once"};
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

std::vector<Hash128> hashes(const Entries &entries) {
  std::vector<Hash128> all;
  for (const auto *entry : entries.items()) {
    all.push_back(hash_of((*entry)->before));
    all.push_back(hash_of((*entry)->after));
  }
  return all;
}

std::vector<std::string> titles(const Entries &entries) {
  std::vector<std::string> all;
  for (const auto *entry : entries.items()) {
    const Entry &e = **entry;
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
  const Moment now = a_session();
  const std::string bytes = write_session(now, {});
  const Moment again = read_session(bytes);
  CHECK(hash_of(again.picture) == hash_of(now.picture));
  REQUIRE(again.timeline.start);
  CHECK(hash_of(*again.timeline.start) == hash_of(*now.timeline.start));
  REQUIRE(now.timeline.past.size() == 3);
  REQUIRE(now.timeline.future.size() == 3);
  CHECK(hashes(again.timeline.past) == hashes(now.timeline.past));
  CHECK(hashes(again.timeline.future) == hashes(now.timeline.future));
  CHECK(titles(again.timeline.past) == titles(now.timeline.past));
  CHECK(titles(again.timeline.future) == titles(now.timeline.future));
  CHECK(again.timeline.next_group == now.timeline.next_group);
  CHECK(again.timeline.moves.size() == now.timeline.moves.size());
  REQUIRE(again.timeline.checkpoints);
  REQUIRE(again.timeline.checkpoints->size() == 2);
  CHECK(again.timeline.checkpoints->at(0).name == "short chord");
  CHECK(hash_of(again.timeline.checkpoints->at(1).at) ==
        hash_of(now.timeline.checkpoints->at(1).at));
  // whatever else there is would change the bytes
  CHECK(write_session(again, {}) == bytes);
}

TEST_CASE("a_loaded_session_goes_on_as_the_saved_one") {
  Moment now = a_session(), again = read_session(write_session(now, {}));
  const mvs_op_chord_remove op = {{}, now.picture.model->valve.chords[5].id};
  CHECK(hash_of(with_op(again, op, MVS_OP_CHORD_REMOVE).picture) ==
        hash_of(with_op(now, op, MVS_OP_CHORD_REMOVE).picture));
  while (!now.timeline.future.empty()) {
    now = redone(now);
    again = redone(again);
    CHECK(hash_of(again.picture) == hash_of(now.picture));
  }
  for (const char *name : {"short chord", ""}) {
    CHECK(hash_of(at_checkpoint(again, name).picture) == hash_of(at_checkpoint(now, name).picture));
  }
  while (!now.timeline.past.empty()) {
    now = undone(now);
    again = undone(again);
    CHECK(hash_of(again.picture) == hash_of(now.picture));
  }
  CHECK(again.timeline.past.empty());
}

TEST_CASE("a_valve_without_history_is_a_session") {
  const Moment again = read_session(write_session(start(), {}));
  CHECK(hash_of(again.picture) == hash_of(start().picture));
  CHECK(again.timeline.past.empty());
  CHECK(again.timeline.future.empty());
  CHECK(!again.timeline.start);
  CHECK(!again.timeline.checkpoints);
}

// session_v1.h5 is a_session() as version 1 of the format first wrote it. What it has to hold is in
// OBJ files beside it: the operations that made it may do better one day.
TEST_CASE("a_file_of_version_1_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v1";
  const auto told = [&](const char *name) {
    const Pair pair = complete(read_obj(read_whole_file(data + name)));
    return mvs::core::hash_of(pair.model, pair.state);
  };
  Moment now = read_session(read_whole_file(data + ".h5"));
  CHECK(hash_of(now.picture) == told("_present.obj"));
  CHECK(now.timeline.future.size() == 3);
  CHECK(hash_of(redone(redone(redone(now))).picture) == hash_of(at_checkpoint(now, "").picture));
  REQUIRE(now.timeline.past.size() == 3);
  const Operation &op = now.timeline.past.items()[0][0]->op;
  REQUIRE(op.kind().number == MVS_OP_CHORD_LENGTH);
  CHECK(op.as<mvs_op_chord_length>().factor == 0.75);
  while (!now.timeline.past.empty()) now = undone(now);
  CHECK(hash_of(now.picture) == told("_undone.obj"));
}

// session_v2.h5 is the same session as version 2 of the format wrote it.
TEST_CASE("a_file_of_version_2_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v";
  Moment now = read_session(read_whole_file(data + "2.h5"));
  const Moment first = read_session(read_whole_file(data + "1.h5"));
  CHECK(hash_of(now.picture) == hash_of(first.picture));
  CHECK(now.timeline.future.size() == 3);
  CHECK(now.timeline.moves.size() == first.timeline.moves.size());
  CHECK(now.picture.state.tools.empty());
  CHECK(hash_of(at_checkpoint(now, "").picture) == hash_of(at_checkpoint(first, "").picture));
}

// session_v3.h5 goes on from there: a grasp moved and stepped twice, a ball taken out again.
TEST_CASE("a_file_of_version_3_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v";
  const Moment now = read_session(read_whole_file(data + "3.h5"));
  const Moment first = read_session(read_whole_file(data + "2.h5"));
  REQUIRE(now.picture.state.tools.size() == 1);
  CHECK(now.picture.state.tools_made == 2);
  CHECK(now.picture.state.steps == first.picture.state.steps + 2);
  std::vector<Move::Kind> kinds;
  const std::vector<const Move *> moves = now.timeline.moves.items();
  for (size_t k = first.timeline.moves.size(); k < moves.size(); ++k) {
    kinds.push_back(moves[k]->kind);
  }
  using Kinds = std::vector<Move::Kind>;
  CHECK(kinds == Kinds{Move::tool_add, Move::tool_add, Move::tool_move, Move::step, Move::tool_move,
                       Move::step, Move::tool_remove});
}

// session_v4.h5 is a parametric valve of which P2/1 was tied to AL1 without a length: then it kept
// its own, and a plan of it has to say so.
TEST_CASE("a_file_of_version_4_is_read_as_ever") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/session_v4.h5";
  const Moment now = read_session(read_whole_file(data));
  REQUIRE(now.timeline.past.size() == 1);
  const auto op = now.timeline.past.items()[0][0]->op.as<mvs_op_chord_transfer>();
  CHECK(op.end == MVS_END_HEAD);
  const std::vector<Chord> &chords = now.picture.model->valve.chords;
  const auto chord = std::find_if(chords.begin(), chords.end(),
                                  [&](const Chord &one) { return one.id == op.chord; });
  REQUIRE(chord != chords.end());
  CHECK(op.length == chord->rest_length);
  const Moment again = after_op(undone(now), Operation(&op.op), {}, 0);
  CHECK(hash_of(again.picture) == hash_of(now.picture));
}

TEST_CASE("what_live_steps_go_on_from_is_part_of_a_session") {
  Moment now = start();
  State &state = now.picture.state;
  Tool ball;
  ball.id = 7;
  ball.kind = MVS_TOOL_BALL;
  ball.node = none;
  ball.radius = ball.stiffness = ball.max_force = 1;
  state.serving = {state.x, {}, 12e3, 1e-3, 0, 9};
  state.coming = {state.x, {ball}, 13e3, 1e-3, 0, 2};
  state.coming.x.push_back(Vec3(1, 2, 3));
  const Moment again = read_session(write_session(now, {}));
  CHECK(hash_of(again.picture) == hash_of(now.picture));
  CHECK(again.picture.state.serving.x.buffer() == again.picture.state.x.buffer());
  state.coming.x.push_back(Vec3(1, 2, 3));
  CHECK(outcome(write_session(now, {})) == MVS_E_FORMAT);
}

TEST_CASE("what_levels_share_is_shared_again") {
  const Moment again = read_session(write_session(a_session(), {}));
  std::set<const void *> triangles, rests, topologies;
  std::set<const Model *> models;
  for (const Entries &entries : {again.timeline.past, again.timeline.future}) {
    for (const auto *entry : entries.items()) {
      for (const Picture *picture : {&(*entry)->before, &(*entry)->after}) {
        models.insert(picture->model.get());
        triangles.insert(picture->model->valve.triangles.buffer());
        rests.insert(picture->model->valve.rest.buffer());
        topologies.insert(picture->model->topology.edges.buffer());
      }
    }
  }
  CHECK(models.size() == 7);
  CHECK(triangles.size() == 1);
  CHECK(topologies.size() == 1);
  CHECK(rests.size() == 1);
  const auto entries = again.timeline.past.items();
  CHECK((*entries[0])->after.model == (*entries[1])->before.model);
  CHECK(again.picture.model == (*entries.back())->after.model);
}

TEST_CASE("a_level_costs_what_it_changed") {
  Moment now = start();
  const Id chord = now.picture.model->valve.chords[1].id;
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
  CHECK(hash_of(read_session(write_session(now, {})).timeline.past.items()[7][0]->after) ==
        hash_of(now.timeline.past.items()[7][0]->after));
}

TEST_CASE("numbers_that_are_none_are_not_saved") {
  Moment now = start();
  now.picture.state.x[5][1] = std::numeric_limits<double>::quiet_NaN();
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
