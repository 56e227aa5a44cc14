// Smooth curve through pieces that are ordered by a parameter, by local linear regression.
#pragma once

#include <array>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// A piece with a parameter that increases along the line.
struct OrderedPiece {
  std::array<double, 4> middle_and_one;  // for registers
  double area, order;
};

// An interval of the parameter.
struct OrderSpan {
  double from, to;
  double length() const { return to - from; }
};

// A polygon with the parameter and the arc length at each point.
struct PieceCurve {
  std::vector<Vec3> points;
  std::vector<double> order, start;
};

// The curve is continuous in the pieces, also where a part of them ends or vanishes: points where
// hardly any piece is near follow their neighbours, on a straight line where none is.
// Pieces are sorted by parameter, and have area.
PieceCurve fit_curve(const std::vector<OrderedPiece> &pieces, const OrderSpan &span);

// The interval of an ascending list that contains t, and the position in it.
struct ListPlace {
  size_t k;
  double share;
};
// `k`: an interval near that of t, from which the search walks to it.
ListPlace find_place(const std::vector<double> &rising, double t, size_t &k);
Vec3 point_at(const std::vector<Vec3> &points, const ListPlace &place);

}  // namespace mvs::core
