// The raster of the annulus surface, and the maps of the last annuli.
#include "measure/annulus/annulus_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/last_used.h"

namespace mvs::core {

AnnulusMap::AnnulusMap(const Frame &frame, const std::vector<Vec3> &rim)
    : frame_(frame), rim_(rim), surface_(frame, rim), area_(surface_.area()) {
  Vec3 low = frame.local(rim[0]), high = low;
  for (const Vec3 &point : rim) {
    low = low.cwiseMin(frame.local(point));
    high = high.cwiseMax(frame.local(point));
  }
  const Vec3 cell = (high - low) / across;
  low_u_ = low[0];
  low_v_ = low[1];
  width_ = cell[0];
  depth_ = cell[1];
  for (int k = 0; k < across; ++k) {
    u_[static_cast<size_t>(k)] = low_u_ + (k + 0.5) * width_;
    v_[static_cast<size_t>(k)] = low_v_ + (k + 0.5) * depth_;
  }
  find_intervals();
  heights_.assign(size_t{across} * across, std::numeric_limits<double>::quiet_NaN());
  shares_.assign(heights_.size(), 0);
  size_t near = 0;
  for (size_t row = 0; row < across; ++row) fill_row(row, near);
}

// Cuts the sides of the annulus by the line of each row: the row is inside between one cut and the
// next.
void AnnulusMap::find_intervals() {
  const std::vector<Vec3> rim = frame_.local(rim_);
  std::vector<double> cuts;
  for (size_t row = 0; row < across; ++row) {
    cuts.clear();
    for (size_t k = 0; k < rim.size(); ++k) {
      const Vec3 &a = rim[k], &b = rim[(k + 1) % rim.size()];
      if ((a[1] <= v_[row]) == (b[1] <= v_[row])) continue;
      const Vec3 &low = a[1] <= v_[row] ? a : b, &high = a[1] <= v_[row] ? b : a;
      cuts.push_back(low[0] + (v_[row] - low[1]) / (high[1] - low[1]) * (high[0] - low[0]));
    }
    std::sort(cuts.begin(), cuts.end());
    for (size_t k = 0; k + 1 < cuts.size(); k += 2) {
      intervals_[row].push_back({cuts[k], cuts[k + 1]});
    }
  }
}

void AnnulusMap::fill_row(size_t row, size_t &near) {
  for (size_t c = 0; c < across; ++c) {
    const double from = low_u_ + static_cast<double>(c) * width_,
                 to = low_u_ + static_cast<double>(c + 1) * width_;
    double length = 0, first = to, last = from;
    for (const Interval &inside : intervals_[row]) {
      const double begin = std::max(from, inside.from), end = std::min(to, inside.to);
      if (!(begin < end)) continue;
      length += end - begin;
      first = std::min(first, begin);
      last = std::max(last, end);
    }
    if (length == 0) continue;
    const bool is_whole = first == from && last == to && length == to - from;
    const double height = surface_.height(is_whole ? u_[c] : 0.5 * (first + last), v_[row], near);
    if (std::isnan(height)) continue;  // rounding on the rim, or a rim that is not star-shaped
    heights_[row * across + c] = height;
    shares_[row * across + c] = is_whole ? 1 : std::min(length / width_, 1.0);
    if (end_inside_[row] == 0) first_inside_[row] = c;
    end_inside_[row] = c + 1;
  }
}

bool AnnulusMap::is_of(const Frame &frame, const std::vector<Vec3> &rim) const {
  return frame_.origin == frame.origin && frame_.axes == frame.axes && rim_ == rim;
}

std::shared_ptr<const AnnulusMap> annulus_map(const Frame &frame, const std::vector<Vec3> &rim) {
  static LastUsed<std::shared_ptr<const AnnulusMap>, 4> last;
  return last.find([&](const auto &map) { return map->is_of(frame, rim); },
                   [&] { return std::make_shared<const AnnulusMap>(frame, rim); });
}

}  // namespace mvs::core
