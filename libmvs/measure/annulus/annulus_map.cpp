// The raster of the annulus surface, and the maps of the last annuli.
#include "measure/annulus/annulus_map.h"

#include <algorithm>
#include <cmath>
#include <mutex>

namespace mvs::core {

AnnulusMap::AnnulusMap(const Frame &frame, const std::vector<Vec3> &rim)
    : frame_(frame), rim_(rim), surface_(frame, rim), area_(surface_.area()) {
  Vec3 low = frame.local(rim[0]), high = low;
  for (const Vec3 &point : rim) {
    low = low.cwiseMin(frame.local(point));
    high = high.cwiseMax(frame.local(point));
  }
  const Vec3 cell = (high - low) / across;
  low_v_ = low[1];
  width_ = cell[0];
  depth_ = cell[1];
  for (int k = 0; k < across; ++k) {
    u_[static_cast<size_t>(k)] = low[0] + (k + 0.5) * width_;
    v_[static_cast<size_t>(k)] = low_v_ + (k + 0.5) * depth_;
  }
  heights_.reserve(size_t{across} * across);
  size_t near = 0;
  for (const double v : v_) {
    for (const double u : u_) {
      heights_.push_back(surface_.height(u, v, near));
      inside_.push_back(!std::isnan(heights_.back()));
    }
  }
  for (size_t row = 0; row < across; ++row) {
    for (size_t c = 0; c < across; ++c) {
      if (!inside(row * across + c)) continue;
      if (end_inside_[row] == 0) first_inside_[row] = c;
      end_inside_[row] = c + 1;
    }
  }
}

bool AnnulusMap::is_of(const Frame &frame, const std::vector<Vec3> &rim) const {
  return frame_.origin == frame.origin && frame_.axes == frame.axes && rim_ == rim;
}

std::shared_ptr<const AnnulusMap> annulus_map(const Frame &frame, const std::vector<Vec3> &rim) {
  constexpr size_t kept = 4;
  static std::mutex mutex;
  static std::vector<std::shared_ptr<const AnnulusMap>> last;
  const auto find = [&] {
    return std::find_if(last.begin(), last.end(),
                        [&](const auto &map) { return map->is_of(frame, rim); });
  };
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto found = find(); found != last.end()) {
      std::rotate(found, found + 1, last.end());
      return last.back();
    }
  }
  // outside of the lock: two threads may make the same map, and either will do
  auto made = std::make_shared<const AnnulusMap>(frame, rim);
  const std::lock_guard<std::mutex> lock(mutex);
  if (last.size() == kept) last.erase(last.begin());
  last.push_back(made);
  return made;
}

}  // namespace mvs::core
