// Elementary functions against reference values that mpmath computed with 60 digits
// (math_tables.py).
#include "base/math.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>

#include "linalg/small_solve.h"

namespace math = mvs::core::math;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Row {
  std::string function;
  double x, y, head, tail;  // the value is head + tail
};

std::vector<Row> reference() {
  std::ifstream file(MVS_SOURCE_DIR "/tests/base/math_reference.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    Row row;
    std::getline(cells, row.function, ',');
    for (double *number : {&row.x, &row.y, &row.head, &row.tail}) {
      std::string cell;
      std::getline(cells, cell, ',');
      *number = std::strtod(cell.c_str(), nullptr);
    }
    rows.push_back(row);
  }
  return rows;
}

double value_of(const Row &row) {
  if (row.function == "log") return math::log(row.x);
  if (row.function == "exp") return math::exp(row.x);
  if (row.function == "expm1") return math::expm1(row.x);
  if (row.function == "pow") return math::pow(row.x, row.y);
  if (row.function == "sin") return math::sin(row.x);
  if (row.function == "cos") return math::cos(row.x);
  if (row.function == "atan2") return math::atan2(row.x, row.y);
  return infinity;
}

double ulp(double x) {
  return std::ldexp(1.0, std::ilogb(x) - 52);
}

bool same(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || (a == b && std::signbit(a) == std::signbit(b));
}

}  // namespace

TEST_CASE("every_function_is_within_one_ulp_of_multiple_precision") {
  std::map<std::string, double> worst;
  std::map<std::string, int> count;
  for (const Row &row : reference()) {
    // the difference from the head is exact, or the error is larger than any that is allowed
    const double error = std::abs((value_of(row) - row.head) - row.tail) / ulp(row.head);
    CAPTURE(row.function);
    CAPTURE(row.x);
    CAPTURE(row.y);
    CHECK(error < 1);
    worst[row.function] = std::max(worst[row.function], error);
    ++count[row.function];
  }
  for (const char *name : {"log", "exp", "expm1", "pow", "sin", "cos", "atan2"}) {
    CAPTURE(name);
    CHECK(count[name] >= 150);
    MESSAGE(name << ": largest error " << worst[name] << " ulp of " << count[name] << " values");
  }
}

TEST_CASE("limits_and_zeros_follow_ieee_754") {
  CHECK(same(math::log(0), -infinity));
  CHECK(same(math::log(infinity), infinity));
  CHECK(same(math::log(1), 0));
  CHECK(std::isnan(math::log(-1)));
  CHECK(same(math::exp(-infinity), 0));
  CHECK(same(math::exp(infinity), infinity));
  CHECK(same(math::exp(0), 1));
  CHECK(same(math::expm1(-0.0), -0.0));
  CHECK(same(math::expm1(-infinity), -1));
  CHECK(same(math::expm1(infinity), infinity));
  CHECK(std::isfinite(math::expm1(709.78)));
  CHECK(same(math::pow(0, 2), 0));
  CHECK(same(math::pow(0, -2), infinity));
  CHECK(same(math::pow(infinity, 0), 1));
  CHECK(same(math::pow(0.5, infinity), 0));
  CHECK(same(math::pow(2, 1e300), infinity));
  CHECK(same(math::pow(2, 1e-300), 1));
  CHECK(std::isnan(math::pow(-1, 2)));
  CHECK(same(math::sin(-0.0), -0.0));
  CHECK(std::isnan(math::sin(infinity)));
  CHECK(std::isnan(math::cos(-infinity)));
  CHECK(same(math::cos(0), 1));
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {math::log(not_a_number), math::exp(not_a_number), math::sin(not_a_number),
                         math::expm1(not_a_number), math::atan2(not_a_number, 1)}) {
    CHECK(std::isnan(x));
  }
  const double numbers[] = {0.0, -0.0, 1, -1, infinity, -infinity, 5e-324, -1e300};
  for (const double y : numbers) {
    for (const double x : numbers) {
      CAPTURE(y);
      CAPTURE(x);
      // these are where every C library rounds correctly
      CHECK(same(math::atan2(y, x), std::atan2(y, x)));
    }
  }
}

TEST_CASE("a_small_linear_system_is_solved") {
  Eigen::Matrix<double, 4, 4> root;
  root << 2, 0, 0, 0, 1, 3, 0, 0, -1, 2, 1, 0, 0.5, 0, 1, 2;
  const Eigen::Matrix<double, 4, 4> a = root * root.transpose();
  const Eigen::Vector4d x(1, -2, 3, 0.25);
  // condition 100: a hundred roundings
  CHECK((mvs::core::solve_positive<4>(a, a * x) - x).norm() < 1e-13);
}

TEST_CASE("a_direction_without_stiffness_has_zero_solution") {
  const Eigen::Matrix2d a = Eigen::Vector2d(4, 0).asDiagonal();
  const Eigen::Vector2d x = mvs::core::solve_positive<2>(a, Eigen::Vector2d(8, 0));
  CHECK(x[0] == 2);
  CHECK(x[1] == 0);
}
