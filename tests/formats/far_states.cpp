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

#ifdef MVS_HAVE_HDF5
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
