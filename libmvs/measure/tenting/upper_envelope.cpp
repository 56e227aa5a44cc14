// Cells below one layer of tissue take sums of the sections of their row; the others, and those on
// the rim, the exact upper envelope of their sections.
#include "measure/tenting/upper_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "base/bit_cast.h"
#include "base/simd.h"
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

constexpr size_t cells_across = AnnulusMap::across;

// The sums of the sections of each cell of a row.
struct RowSums {
  std::array<double, cells_across> covered, height, lowest, highest;
  std::array<uint64_t, cells_across> ends;

  void clear() {
    covered.fill(0);
    height.fill(0);
    lowest.fill(HUGE_VAL);
    highest.fill(-HUGE_VAL);
    ends.fill(0);
  }
};

// The cells of a row of the raster, and where their results go.
struct PlainCells {
  double width, most;   // m
  const double *share;  // of each cell inside the annulus
  double *covered, *height;
};

// Writes the cells of a row below one layer of tissue or none, without a fold or a border. Sets
// others[c] where a cell is left to the envelope, and 0 elsewhere.
template <typename V>
MVS_INLINE void write_plain(const RowSums &sums, const PlainCells &cells, int64_t *others) {
  using Value = typename V::Value;
  using Mask = typename V::Mask;
  const Value zero = {}, one = zero + 1;
  for (size_t c = 0; c < cells_across; c += V::width) {
    Value length, height, lowest, highest, share, off;
    Mask ends;
    load<V>(length, &sums.covered[c]);
    load<V>(height, &sums.height[c]);
    load<V>(lowest, &sums.lowest[c]);
    load<V>(highest, &sums.highest[c]);
    load<V>(share, cells.share + c);
    std::memcpy(&ends, &sums.ends[c], sizeof ends);
    const Value covered = length / cells.width;
    magnitude_of<Value>(covered - 1, off);
    const Mask plain = (ends == 0) & (share == one);
    const Mask layer = plain & (off < zero + one_layer) & (highest - lowest <= zero + cells.most);
    const Mask rest = (share > zero) & ~layer & ~(plain & (covered < zero + one_layer));
    store<V>(cells.covered + c, layer ? one : zero);
    store<V>(cells.height + c, layer ? height / length : zero);
    std::memcpy(others + c, &rest, sizeof rest);
  }
}

// One row of the raster, with buffers that are reused.
class Row {
 public:
  Row(const AnnulusMap &map, double most, VisibleTissue &result)
      : map_(map), result_(result), most_(most) {
    for (size_t c = 0; c <= cells_across; ++c) {
      border_[c] = map.low_u() + static_cast<double>(c) * map.width();
    }
  }

  void fill(size_t row, const Section *begin, const Section *end) {
    // gcc selects elements of 512 bits one by one
    static const auto plain = simd_kernel<&write_plain<Double2>, &write_plain<Double4>>();
    const size_t start = row * cells_across;
    row_ = row;
    sums_.clear();
    first_part_.fill(none);
    parts_.clear();
    for (const Section *s = begin; s != end; ++s) add(*s);
    std::array<int64_t, cells_across> others;
    plain(sums_,
          {map_.width(), most_, map_.shares().data() + start, result_.covered.data() + start,
           result_.height.data() + start},
          others.data());
    for (size_t c = map_.first_inside(row); c < map_.end_inside(row); ++c) {
      if (others[c] != 0) write_envelope(c);
    }
  }

 private:
  // A section in the list of a cell.
  struct Part {
    const Section *section;
    uint32_t next;
  };

  size_t column_of(double u) const {
    const double column = std::floor((u - map_.low_u()) / map_.width());
    return static_cast<size_t>(std::clamp(column, 0.0, cells_across - 1.0));
  }

  // Adds a section to the sums of its cells. Sections that begin where another one ends cancel in
  // `ends`: what remains shows that a cell has a fold or a border.
  void add(const Section &s) {
    const size_t first = column_of(s.from), last = column_of(s.to);
    sums_.ends[first] += bit_cast<uint64_t>(s.from);
    sums_.ends[last] -= bit_cast<uint64_t>(s.to);
    auto number = static_cast<uint32_t>(parts_.size());
    parts_.resize(parts_.size() + (last - first + 1));
    double from = s.from, at_from = s.at_from;
    for (size_t c = first; c <= last; ++c, ++number) {
      const double to = c < last ? border_[c + 1] : s.to;
      const double at_to = c < last ? s.height(to) : s.at_to;
      const double length = to - from;
      parts_[number] = {&s, first_part_[c]};
      first_part_[c] = number;
      sums_.covered[c] += length;
      sums_.height[c] += 0.5 * length * (at_from + at_to);
      sums_.lowest[c] = std::min(sums_.lowest[c], std::min(at_from, at_to));
      sums_.highest[c] = std::max(sums_.highest[c], std::max(at_from, at_to));
      from = to;
      at_from = at_to;
    }
  }

  void write_envelope(size_t column) {
    const size_t cell = row_ * cells_across + column;
    envelope_.clear();
    for (const AnnulusMap::Interval &inside : map_.intervals(row_)) {
      add_envelope(column, std::max(border_[column], inside.from),
                   std::min(border_[column + 1], inside.to));
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
    for (uint32_t k = first_part_[column]; k != none; k = parts_[k].next) {
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
  std::array<double, cells_across + 1> border_;
  RowSums sums_;
  std::array<uint32_t, cells_across> first_part_;  // of each cell: the head of its list in parts_
  std::vector<Part> parts_;
  std::vector<const Section *> near_, layers_;
  std::vector<double> places_;
  std::vector<Stretch> envelope_;
};

}  // namespace

VisibleTissue visible_tissue(const AnnulusMap &map, const std::vector<Tri> &triangles,
                             const std::vector<Vec3> &local, double most) {
  VisibleTissue result{std::vector<double>(cells_across * cells_across, 0),
                       std::vector<double>(cells_across * cells_across, 0)};
  const Sections sections = cut_triangles(map, triangles, local);
  Row row(map, most, result);
  for (size_t r = 0; r < cells_across; ++r) {
    row.fill(r, sections.items.data() + sections.first[r],
             sections.items.data() + sections.first[r + 1]);
  }
  return result;
}

}  // namespace mvs::core
