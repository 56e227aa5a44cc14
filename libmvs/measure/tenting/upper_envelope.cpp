// Cells below one layer of tissue take sums of the sections of their row; the others, and those on
// the rim, the exact upper envelope of their sections.
#include "measure/tenting/upper_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "base/bit_cast.h"
#include "base/simd.h"
#include "measure/tenting/highest_sections.h"
#include "measure/tenting/row_sections.h"

namespace mvs::core {
namespace {

// Cells with as many layers, up to rounding of the sum of their sections.
constexpr double one_layer = 1e-9;

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
