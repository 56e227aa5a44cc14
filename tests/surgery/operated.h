// Fixtures of the surgery tests: a valve, an operation on it, the closed valve afterwards.
#pragma once

#include <doctest/doctest.h>
#include <mvs/op.h>

#include <string>

#include "anatomy/parametric.h"
#include "base/error.h"
#include "geometry/intersect.h"
#include "history/history.h"
#include "measure/measure.h"
#include "solve/solver.h"
#include "tests/founding.h"

namespace mvs::core::test {

inline constexpr double mm = 1e-3;

// The valve that mvs_generate_valve makes, at rest.
inline ModelState shipped(const mvs_parametric_desc &desc = founding_valve()) {
  const ModelPtr model = make_model(make_parametric_valve(desc));
  return {model, initial_state(*model)};
}

template <typename Op>
Op op_of(uint32_t kind) {
  Op op = {};
  op.op = {sizeof op, kind};
  return op;
}

template <typename Op>
Operated apply(const ModelState &before, const Op &op) {
  return perform(before, Operation(&op.op));
}

// Fails with this code and a sentence that contains `word`.
template <typename Op>
void refused(const ModelState &before, const Op &op, mvs_result code, const std::string &word) {
  CAPTURE(word);
  try {
    apply(before, op);
    FAIL_CHECK("was not refused");
  } catch (const Error &fault) {
    const std::string said = fault.what();
    CAPTURE(said);
    CHECK(fault.code == code);
    CHECK(said.find(word) != std::string::npos);
  }
}

struct Closed {
  ModelPtr model;
  State state;
  SolveStats stats;
};

// At rest under 120 mmHg.
inline Closed close(const ModelState &current) {
  Closed closed{current.model, current.state, {}};
  closed.state.load = {120 * 133.322, 1};
  Solver solver(Backend::fastest);
  closed.stats = solver.settle(*closed.model, closed.state, {}, {});
  return closed;
}

inline size_t intersections(const Closed &closed) {
  return find_intersections(closed.state.x, closed.model->valve.triangles).size();
}

inline mvs_array array_of(const std::vector<Vec3> &points) {
  return {points.data(), points.size(), 3, MVS_TYPE_F64, 0};
}

}  // namespace mvs::core::test
