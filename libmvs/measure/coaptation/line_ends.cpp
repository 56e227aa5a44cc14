// Quantiles of the cumulative distribution of area over the parameter, with a least density.
#include "measure/coaptation/line_ends.h"

#include <algorithm>
#include <utility>

namespace mvs::core {
namespace {

constexpr double trimmed = 0.005;  // of the area, at either end
// Each piece spreads over this angle to both sides when the ends of the line are looked for: a
// piece that passes an end is left out gradually.
constexpr double spread = 0.005;
// Share of the area per radian below which pieces are thin. A line of 2 rad has 0.5 in the mean.
constexpr double thin = 0.02;

// The share of a piece below t, when it is spread.
double share_below(double order, double t) {
  return std::clamp((t - order + spread) / (2 * spread), 0.0, 1.0);
}

bool is_before(const OrderedPiece &l, const OrderedPiece &r) {
  return l.order < r.order;
}

// Stable bucket sort by parameter, with about one piece to a bucket. Most pieces of a bucket are
// few, and sorted by insertion.
void sort_by_order(std::vector<OrderedPiece> &pieces) {
  const auto [low, high] = std::minmax_element(pieces.begin(), pieces.end(), is_before);
  if (low == high || !(low->order < high->order)) return;
  const double first = low->order;
  const double scale = static_cast<double>(pieces.size() - 1) / (high->order - first);
  const auto bucket_of = [&](const OrderedPiece &piece) {
    return static_cast<uint32_t>(
        std::min((piece.order - first) * scale, static_cast<double>(pieces.size() - 1)));
  };
  std::vector<uint32_t> start(pieces.size() + 1, 0);
  for (const OrderedPiece &piece : pieces) ++start[bucket_of(piece) + 1];
  for (size_t k = 0; k < pieces.size(); ++k) start[k + 1] += start[k];
  std::vector<uint32_t> next(start.begin(), start.end() - 1);
  std::vector<OrderedPiece> sorted(pieces.size());
  for (const OrderedPiece &piece : pieces) sorted[next[bucket_of(piece)]++] = piece;
  constexpr std::ptrdiff_t few = 16;
  for (size_t k = 0; k < pieces.size(); ++k) {
    const auto begin = sorted.begin() + start[k], end = sorted.begin() + start[k + 1];
    if (end - begin > few) {
      std::stable_sort(begin, end, is_before);
      continue;
    }
    for (auto i = begin; i < end; ++i) {
      for (auto j = i; j > begin && is_before(*j, *(j - 1)); --j) std::swap(*j, *(j - 1));
    }
  }
  pieces = std::move(sorted);
}

// What thin stretches near an end subtract from the area outside of a place: the integral, from the
// place inwards, of the density that they lack, times a factor that falls from 1 at the trimmed
// area outside to 0 at twice that. So the area outside, less this, rises with at least the thin
// density up to the trimmed area, and reaches it at one place that is continuous in the pieces: the
// quantile itself if nothing is thin there.
class ThinArea {
 public:
  // `side`: 1 at the end with the lowest parameters, -1 at the other. Pieces are sorted.
  ThinArea(const std::vector<OrderedPiece> &sorted, double total, int side) {
    const double least = thin * total, area = trimmed * total;
    const size_t count = sorted.size();
    const auto piece = [&](size_t k) -> const OrderedPiece & {
      return sorted[side > 0 ? k : count - 1 - k];
    };
    double density = 0, outside = 0, at = side * piece(0).order - spread;
    for (size_t entered = 0, left = 0; left < count && outside < 2 * area;) {
      const double leaves = side * piece(left).order + spread;
      const double enters = entered < count ? side * piece(entered).order - spread : leaves;
      const bool is_entry = entered < count && enters <= leaves;
      const double next = is_entry ? enters : leaves, after = outside + density * (next - at);
      // up to twice the area only, where the factor is 0
      const double end = after > 2 * area ? at + (2 * area - outside) / density : next;
      if (after >= area && density < least && end > at) {
        parts_.push_back({at, end, factor(outside, area) * (least - density),
                          factor(std::min(after, 2 * area), area) * (least - density), 0});
      }
      outside = after;
      at = next;
      const double change = piece(is_entry ? entered : left).area / (2 * spread);
      density = is_entry ? density + change : std::max(0.0, density - change);
      ++(is_entry ? entered : left);
    }
    for (size_t k = parts_.size(); k-- > 1;) {
      parts_[k - 1].inwards = parts_[k].inwards + parts_[k].integral_from(parts_[k].from);
    }
  }

  // From a place inwards, by the parameter times `side`.
  double from(double at) const {
    const auto part = std::partition_point(parts_.begin(), parts_.end(),
                                           [&](const Part &p) { return p.to <= at; });
    return part == parts_.end() ? 0 : part->inwards + part->integral_from(std::max(at, part->from));
  }

 private:
  // A stretch with a linear integrand, and the integral over those further inwards.
  struct Part {
    double from, to, at_from, at_to, inwards;
    double integral_from(double at) const {
      const double share = (to - at) / (to - from);
      return (to - at) * (at_to + 0.5 * share * (at_from - at_to));
    }
  };
  static double factor(double outside, double area) { return 2 - outside / area; }

  std::vector<Part> parts_;
};

// The parameter where `area_below` reaches an area, by bisection. The last interval, of 4e-7, is
// interpolated.
template <typename AreaBelow>
double quantile(double total, double area, AreaBelow area_below) {
  double low = -4, high = 4, low_area = 0, high_area = total;
  for (int k = 0; k < 24; ++k) {
    const double middle = 0.5 * (low + high), found = area_below(middle);
    (found < area ? low : high) = middle;
    (found < area ? low_area : high_area) = found;
  }
  const double within = high_area - low_area;
  return within > 0 ? low + (high - low) * (area - low_area) / within : low;
}

// Both ends of the spread pieces, sorted by their order.
OrderSpan ends_of(const std::vector<OrderedPiece> &sorted) {
  std::vector<double> below = {0};
  for (const OrderedPiece &piece : sorted) below.push_back(below.back() + piece.area);
  const double total = below.back();
  const auto first_from = [&](double t) {
    return std::partition_point(sorted.begin(), sorted.end(),
                                [&](const OrderedPiece &piece) { return piece.order < t; }) -
           sorted.begin();
  };
  const auto area_below = [&](double t) {
    const auto whole = first_from(t - spread), some = first_from(t + spread);
    double sum = below[static_cast<size_t>(whole)];
    for (auto k = whole; k < some; ++k) {
      const OrderedPiece &piece = sorted[static_cast<size_t>(k)];
      sum += piece.area * share_below(piece.order, t);
    }
    return sum;
  };
  const ThinArea low(sorted, total, 1), high(sorted, total, -1);
  return {quantile(total, trimmed * total, [&](double t) { return area_below(t) - low.from(t); }),
          quantile(total, (1 - trimmed) * total,
                   [&](double t) { return area_below(t) + high.from(-t); })};
}

}  // namespace

OrderSpan trim(std::vector<OrderedPiece> &pieces) {
  sort_by_order(pieces);
  const OrderSpan span = ends_of(pieces);
  for (OrderedPiece &piece : pieces) {
    piece.area *= share_below(piece.order, span.to) - share_below(piece.order, span.from);
  }
  return span;
}

}  // namespace mvs::core
