// A state with a node far from its rest position, or faster than tissue can be, is refused by every
// format with the line or the node: the search for contacts would take a grid of that size.
#include <doctest/doctest.h>

#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

// Returns the line of the refusal, 0 if the file is read.
int32_t refused_line(const State &state, const char *word) {
  const Pair pair = moving_example();
  try {
    read_obj(write_obj(pair.model, state));
    return 0;
  } catch (const Error &error) {
    CHECK_EQ(error.code, MVS_E_FORMAT);
    CHECK(std::string(error.what()).find(word) != std::string::npos);
    return error.line;
  }
}

}  // namespace

TEST_CASE("an_obj_file_with_a_far_or_fast_node_is_refused_with_its_line") {
  const Pair pair = moving_example();
  CHECK_EQ(refused_line(pair.state, ""), 0);
  for (const double far : {1.5, 20.0, 1e60}) {
    State state = pair.state;
    state.x.edit()[3].y() += far;
    CHECK_GT(refused_line(state, "rest position"), 0);
  }
  State state = pair.state;
  state.v.edit()[3].y() = 1e4;
  CHECK_GT(refused_line(state, "speed"), 0);
}

TEST_CASE("a_pressure_that_no_load_may_have_is_refused") {
  State state = moving_example().state;
  for (const double pressure : {400e3, -400e3}) {
    state.load.pressure = pressure;
    CHECK_EQ(refused_line(state, ""), 0);
    state.load.pressure = 1.001 * pressure;
    CHECK_GT(refused_line(state, "within 400000 Pa"), 0);
  }
}

#ifdef MVS_HAVE_HDF5
TEST_CASE("a_session_with_such_a_pressure_or_with_a_name_that_is_not_utf8_is_refused") {
  const Pair pair = moving_example();
  const auto model = std::make_shared<const Model>(pair.model);
  Snapshot snapshot{{model, pair.state}, {}};
  snapshot.current.state.load.pressure = 1e9;
  CHECK_THROWS_WITH_AS(read_session(write_session(snapshot, {})), doctest::Contains("1e+09 Pa"),
                       Error);
  Model renamed = pair.model;
  renamed.valve.heads[0].name = "Kopf\xe9";
  snapshot = {{std::make_shared<const Model>(renamed), pair.state}, {}};
  CHECK_THROWS_WITH_AS(read_session(write_session(snapshot, {})),
                       doctest::Contains("not UTF-8, near \"Kopf\""), Error);
}

TEST_CASE("a_session_with_a_far_or_fast_node_is_refused_with_its_number") {
  const Pair pair = moving_example();
  const auto model = std::make_shared<const Model>(pair.model);
  const auto read = [&](const State &state) {
    read_session(write_session({{model, state}, {}}, {}));
  };
  read(pair.state);
  for (const double far : {1.5, 1e60}) {
    State state = pair.state;
    state.x.edit()[3].y() += far;
    CHECK_THROWS_WITH_AS(read(state), doctest::Contains("node 3"), Error);
    state = pair.state;
    state.v.edit()[3].y() = 1e4 * far;
    CHECK_THROWS_WITH_AS(read(state), doctest::Contains("speed of node 3"), Error);
  }
}
#endif
