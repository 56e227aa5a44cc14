// Session files: the whole history is restored to the bit and shared as it was, and any file gives
// a session or a clean error.
#ifdef MVS_HAVE_HDF5
#include <mvs/tool.h>

#include <algorithm>
#include <set>

#include "formats/hdf5/tree.h"
#include "formats/session/layout.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

template <typename Struct>
Snapshot with_op(const Snapshot &now, Struct op, uint32_t kind, const Group &group = {}) {
  op.op = {sizeof op, kind};
  return after_op(now, Operation(&op.op), group, 1700000000000 + static_cast<int64_t>(kind));
}

// Time goes on: other positions, a event in the history.
Snapshot stepped(const Snapshot &now, uint64_t steps) {
  Snapshot snapshot = now;
  State &state = snapshot.current.state;
  for (Vec3 &x : state.x) x += Vec3(1e-6, 2e-6, -1e-6) * static_cast<double>(steps);
  state.steps += steps;
  state.time += 1e-3 * static_cast<double>(steps);
  RecordedEvent event;
  event.kind = RecordedEvent::step;
  event.dt = 1e-3;
  event.budget = 32;
  for (uint64_t k = 0; k < steps; ++k) {
    snapshot.history.events = with_event(snapshot.history.events, event);
  }
  return snapshot;
}

Snapshot loaded(const Snapshot &now, double pressure) {
  Snapshot snapshot = now;
  snapshot.current.state.load = {pressure, 1};
  RecordedEvent event;
  event.pressure = pressure;
  event.boundary_fraction = 1;
  snapshot.history.events = with_event(snapshot.history.events, event);
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
  const Pair pair = moving_valve();
  Valve valve = pair.model.valve;
  valve.rings = {};  // they would hold the annulus
  return {{make_model(std::move(valve)), pair.state}, {}};
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
  now = with_checkpoint(now, "before the undo");
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
                  std::to_string(e.events.size()));
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

// Changes one word of the snapshot or of the parts in a file, under a good checksum.
std::string with_word(H5Tree tree, const char *array, size_t at, uint64_t word) {
  std::get<std::vector<uint64_t>>(tree.arrays.at(array).values).at(at) = word;
  return write_h5(tree, session_version);
}

}  // namespace

TEST_CASE("a_session_is_restored_to_the_bit") {
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
  CHECK(again.history.events.size() == now.history.events.size());
  REQUIRE(again.history.checkpoints);
  REQUIRE(again.history.checkpoints->size() == 2);
  CHECK(again.history.checkpoints->at(0).name == "short chord");
  CHECK(hash_of(again.history.checkpoints->at(1).at) == hash_of(now.history.checkpoints->at(1).at));
  // equal bytes: no other part of the session changed
  CHECK(write_session(again, {}) == bytes);
}

TEST_CASE("a_loaded_session_continues_as_the_saved_one") {
  Snapshot now = a_session(), again = read_session(write_session(now, {}));
  const mvs_op_chord_remove op = {{}, now.current.model->valve.chords[5].id};
  CHECK(hash_of(with_op(again, op, MVS_OP_CHORD_REMOVE).current) ==
        hash_of(with_op(now, op, MVS_OP_CHORD_REMOVE).current));
  while (!now.history.future.empty()) {
    now = redone(now);
    again = redone(again);
    CHECK(hash_of(again.current) == hash_of(now.current));
  }
  for (const char *name : {"short chord", "before the undo"}) {
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

// session.h5 is a_session(), session_present.obj the valve and state that it ends with.
TEST_CASE("the_golden_session_is_what_the_writer_makes") {
  const std::string data = MVS_SOURCE_DIR "/tests/formats/data/";
  const Snapshot made = a_session();
  const ModelState &present = made.current;
  write_golden(data + "session.h5", [&] { return write_session(made, {}); });
  write_golden(data + "session_present.obj",
               [&] { return write_obj(*present.model, present.state); });
  const std::string bytes = read_whole_file(data + "session.h5");
  const Snapshot now = read_session(bytes);
  const Pair pair = complete(read_obj(read_whole_file(data + "session_present.obj")));
  CHECK(hash_of(now.current) == hash_of(pair.model, pair.state));
  CHECK(hash_of(now.current) == hash_of(present));
  CHECK(hashes(now.history.past) == hashes(made.history.past));
  CHECK(hashes(now.history.future) == hashes(made.history.future));
  CHECK(write_session(now, {}) == write_session(made, {}));
}

TEST_CASE("a_session_of_another_version_is_refused") {
  const H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version);
  for (const uint32_t version : {0u, 2u, 5u}) {
    const std::string bytes = write_h5(tree, version);
    CHECK(outcome(bytes) == MVS_E_VERSION);
    CHECK_THROWS_WITH(read_session(bytes), doctest::Contains("this libmvs reads version 1"));
  }
}

TEST_CASE("a_solver_cache_is_part_of_a_session") {
  Snapshot now = start();
  now.current.state.cache = {3, uint64_t{7} << 32 | 9, {0.1, -0.0, 1e300}};
  const Snapshot again = read_session(write_session(now, {}));
  CHECK(hash_of(again.current) == hash_of(now.current));
  CHECK(again.current.state.cache == now.current.state.cache);
}

TEST_CASE("arrays_shared_by_snapshots_are_shared_again") {
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

TEST_CASE("an_undo_level_in_a_file_takes_only_the_bytes_that_it_changed") {
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
  // two snapshots, of 16 bytes more each for the instruments, 8 for the preconditioner flag and 8
  // for rest, a model, its 12 chords and the operation in words: 2034; positions would be 3264
  // bytes
  CHECK(each < 2048);
  CHECK(hash_of(read_session(write_session(now, {})).history.past.items()[7][0]->after) ==
        hash_of(now.history.past.items()[7][0]->after));
}

TEST_CASE("infinity_and_nan_are_not_saved") {
  Snapshot now = start();
  now.current.state.x[5][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(write_session(now, {}), doctest::Contains("go back to an earlier state"));
}

// The checksum is valid here: the reader itself has to detect the change, or to make a session of
// it.
TEST_CASE("any_changed_word_gives_a_session_or_a_clean_error") {
  const H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version);
  std::array<size_t, 2> seen{};
  for (const char *array : {"mvs/snapshot", "mvs/parts/values", "mvs/parts/ends"}) {
    const auto words = tree.at<uint64_t>(array);
    // a prime stride, so that every kind of word is changed
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
  const H5Tree tree = read_h5(write_session(a_session(), {}), "mvs", session_version);
  for (const auto &entry : tree.arrays) {
    H5Tree without = tree;
    without.arrays.erase(entry.first);
    CHECK_THROWS_WITH(read_session(write_h5(without, session_version)),
                      ("the file has no array " + entry.first).c_str());
  }
}
#endif
