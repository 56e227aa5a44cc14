// Cells below one layer of tissue take sums of the sections of their row; the others, and those on
// the rim, the exact upper envelope of their sections.
#include "measure/tenting/upper_envelope.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/bit_cast.h"
#include "measure/tenting/row_sections.h"

namespace mvs::core {
namespace {

// Cells with as many layers, up to rounding of the sum of their sections.
constexpr double one_layer = 1e-9;
// The most halvings of an interval in which more than two sections are the highest.
constexpr int most_crossings = 8;
// Newton's method on a function of a few quadratic parts needs as many steps as parts.
constexpr int most_iterations = 30;

// A linear part of the upper envelope: its length and the heights at its ends.
struct Stretch {
  double length, at_from, at_to;

  double integral() const { return 0.5 * length * (at_from + at_to); }
  // The length of the part above a height, and the integral over the height there.
  std::pair<double, double> above(double height) const {
    const double a = at_from - height, b = at_to - height;
    if (a <= 0 && b <= 0) return {0.0, 0.0};
    if (a >= 0 && b >= 0) return {length, 0.5 * length * (a + b)};
    const double most = std::max(a, b), part = length * most / std::abs(a - b);
    return {part, 0.5 * part * most};
  }
};

// Appends the highest of some sections over an interval that all of them cover. The largest of
// linear functions is convex: one that is the highest at both ends is so in between.
void add_highest(const std::vector<const Section *> &layers, double from, double to,
                 std::vector<Stretch> &envelope, int depth = 0) {
  const Section *left = layers[0], *right = layers[0];
  for (const Section *s : layers) {
    const double at_from = s->height(from), at_to = s->height(to);
    const double left_from = left->height(from), right_to = right->height(to);
    if (at_from > left_from || (at_from == left_from && at_to > left->height(to))) left = s;
    if (at_to > right_to || (at_to == right_to && at_from > right->height(from))) right = s;
  }
  const double above = left->height(from) - right->height(from),
               below = right->height(to) - left->height(to);
  double middle = from;
  if (left != right && depth < most_crossings && above + below > 0) {
    middle = from + above / (above + below) * (to - from);
  }
  if (!(middle > from && middle < to)) {
    envelope.push_back({to - from, left->height(from), right->height(to)});
    return;
  }
  add_highest(layers, from, middle, envelope, depth + 1);
  add_highest(layers, middle, to, envelope, depth + 1);
}

// The mean height of the upper half of an envelope, by length: the conditional value at risk of
// level 1/2, t + integral of max(z - t, 0) / (length / 2) for the median t (Rockafellar and
// Uryasev, J. Risk 2, 2000). `heights` is a buffer.
double mean_of_upper_half(const std::vector<Stretch> &envelope, double length,
                          std::vector<double> &heights) {
  const auto above = [&](double height) {
    std::pair<double, double> sum = {0.0, 0.0};
    for (const Stretch &s : envelope) {
      const auto [part, integral] = s.above(height);
      sum.first += part;
      sum.second += integral;
    }
    return sum;
  };
  heights.clear();
  for (const Stretch &s : envelope) heights.insert(heights.end(), {s.at_from, s.at_to});
  std::sort(heights.begin(), heights.end());
  const double half = 0.5 * length;
  size_t k = 0;  // the last height with half of the envelope above it
  double longer = length;
  for (size_t next = 1; next < heights.size(); ++next) {
    const double part = above(heights[next]).first;
    if (part < half) {
      // the length above falls linearly between two heights
      const double share = longer > part ? (longer - half) / (longer - part) : 0.0;
      const double median = heights[k] + share * (heights[next] - heights[k]);
      return median + above(median).second / half;
    }
    k = next;
    longer = part;
  }
  return heights[k] + above(heights[k]).second / half;
}

// The height H at which the mean of max(z - H, -most) is zero: the mean height, in which tissue far
// below the rest counts as if it were `most` below. Newton's method from below: the mean is convex
// and falls with H.
double censored_mean(const std::vector<Stretch> &envelope, double length, double mean,
                     double most) {
  double height = mean;
  for (int k = 0; k < most_iterations; ++k) {
    double above = 0, excess = 0;  // the integral of max(z - (height - most), 0)
    for (const Stretch &s : envelope) {
      const auto [part, integral] = s.above(height - most);
      above += part;
      excess += integral;
    }
    const double step = (excess - most * length) / above;
    if (!(step > 1e-15)) break;
    height += step;
  }
  return height;
}

// The censored mean, but at most the mean of the upper half: it rises with the share of high tissue
// by at most twice the depth.
double limited_mean(const std::vector<Stretch> &envelope, double length, double most,
                    std::vector<double> &buffer) {
  double sum = 0;
  for (const Stretch &s : envelope) sum += s.integral();
  const double mean = sum / length, limited = censored_mean(envelope, length, mean, most);
  return limited > mean ? std::min(limited, mean_of_upper_half(envelope, length, buffer)) : mean;
}

// One row of the raster, with buffers that are reused.
class Row {
 public:
  Row(const AnnulusMap &map, double most, VisibleTissue &result)
      : map_(map), result_(result), most_(most) {}

  void fill(size_t row, const Section *begin, const Section *end) {
    row_ = row;
    sums_.fill({});
    parts_.clear();
    for (const Section *s = begin; s != end; ++s) add(*s);
    for (size_t c = map_.first_inside(row); c < map_.end_inside(row); ++c) write(c);
  }

 private:
  // A section in the list of a cell.
  struct Part {
    const Section *section;
    uint32_t next;
  };

  // The sums of the sections of a cell, and the head of its list in parts_.
  struct CellSums {
    double covered = 0, height = 0, lowest = HUGE_VAL, highest = -HUGE_VAL;
    uint64_t ends = 0;
    uint32_t first_part = none;
  };

  double border(size_t column) const {
    return map_.low_u() + static_cast<double>(column) * map_.width();
  }
  size_t column_of(double u) const {
    const double column = std::floor((u - map_.low_u()) / map_.width());
    return static_cast<size_t>(std::clamp(column, 0.0, AnnulusMap::across - 1.0));
  }

  // Adds a section to the sums of its cells. Sections that begin where another one ends cancel in
  // `ends`: what remains shows that a cell has a fold or a border.
  void add(const Section &s) {
    const size_t first = column_of(s.from), last = column_of(s.to);
    sums_[first].ends += bit_cast<uint64_t>(s.from);
    sums_[last].ends -= bit_cast<uint64_t>(s.to);
    double from = s.from, at_from = s.at_from;
    for (size_t c = first; c < last; ++c) {
      const double to = border(c + 1), at_to = s.height(to);
      add_part(s, c, to - from, at_from, at_to);
      from = to;
      at_from = at_to;
    }
    add_part(s, last, s.to - from, at_from, s.at_to);
  }
  void add_part(const Section &s, size_t column, double length, double at_from, double at_to) {
    CellSums &cell = sums_[column];
    parts_.push_back({&s, cell.first_part});
    cell.first_part = static_cast<uint32_t>(parts_.size() - 1);
    cell.covered += length;
    cell.height += 0.5 * length * (at_from + at_to);
    cell.lowest = std::min(cell.lowest, std::min(at_from, at_to));
    cell.highest = std::max(cell.highest, std::max(at_from, at_to));
  }

  void write(size_t column) {
    const size_t cell = row_ * AnnulusMap::across + column;
    if (!map_.inside(cell)) return;
    const CellSums &sums = sums_[column];
    const double covered = sums.covered / map_.width();
    const bool is_plain = sums.ends == 0 && map_.share(cell) == 1;
    if (is_plain && covered < one_layer) return;
    if (is_plain && std::abs(covered - 1) < one_layer && sums.highest - sums.lowest <= most_) {
      result_.covered[cell] = 1;
      result_.height[cell] = sums.height / sums.covered;
      return;
    }
    envelope_.clear();
    for (const AnnulusMap::Interval &inside : map_.intervals(row_)) {
      add_envelope(column, std::max(border(column), inside.from),
                   std::min(border(column + 1), inside.to));
    }
    double length = 0;
    for (const Stretch &s : envelope_) length += s.length;
    if (length == 0) return;
    result_.covered[cell] = std::min(length / map_.width(), map_.share(cell));
    result_.height[cell] = limited_mean(envelope_, length, most_, places_);
  }

  // Appends the upper envelope between two places of a cell.
  void add_envelope(size_t column, double from, double to) {
    if (!(from < to)) return;
    near_.clear();
    places_.assign({from, to});
    for (uint32_t k = sums_[column].first_part; k != none; k = parts_[k].next) {
      const Section *s = parts_[k].section;
      if (!(s->from < to && s->to > from && s->from < s->to)) continue;
      near_.push_back(s);
      if (s->from > from) places_.push_back(s->from);
      if (s->to < to) places_.push_back(s->to);
    }
    std::sort(places_.begin(), places_.end());
    for (size_t k = 0; k + 1 < places_.size(); ++k) {
      const double low = places_[k], high = places_[k + 1];
      if (!(low < high)) continue;
      layers_.clear();
      for (const Section *s : near_) {
        if (s->from <= low && s->to >= high) layers_.push_back(s);
      }
      if (!layers_.empty()) add_highest(layers_, low, high, envelope_);
    }
  }

  const AnnulusMap &map_;
  VisibleTissue &result_;
  double most_;
  size_t row_ = 0;
  std::vector<Part> parts_;
  std::array<CellSums, AnnulusMap::across> sums_;
  std::vector<const Section *> near_, layers_;
  std::vector<double> places_;
  std::vector<Stretch> envelope_;
};

}  // namespace

VisibleTissue visible_tissue(const AnnulusMap &map, const std::vector<Tri> &triangles,
                             const std::vector<Vec3> &local, double most) {
  VisibleTissue result{std::vector<double>(AnnulusMap::across * AnnulusMap::across, 0),
                       std::vector<double>(AnnulusMap::across * AnnulusMap::across, 0)};
  const Sections sections = cut_triangles(map, triangles, local);
  Row row(map, most, result);
  for (size_t r = 0; r < AnnulusMap::across; ++r) {
    row.fill(r, sections.items.data() + sections.first[r],
             sections.items.data() + sections.first[r + 1]);
  }
  return result;
}

}  // namespace mvs::core
