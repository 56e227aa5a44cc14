#include "base/way_lanes.h"

#include <cmath>

namespace mvs {

double narrow_error(const Way &all) {
  double farthest = 0;
  for (const Way::Box &box : {all.start, all.end}) {
    for (uint32_t k = 0; k < 3; ++k) {
      farthest = std::max({farthest, std::abs(box.low[k]), std::abs(box.high[k])});
    }
  }
  return 4 * 0x1p-24 * farthest;
}

NarrowWay::NarrowWay(const Way &way, double margin) {
  for (uint32_t k = 0; k < 3; ++k) {
    start_low[k] = static_cast<float>(way.start.low[k] - margin);
    start_high[k] = static_cast<float>(way.start.high[k] + margin);
    end_low[k] = static_cast<float>(way.end.low[k] - margin);
    end_high[k] = static_cast<float>(way.end.high[k] + margin);
  }
  start_low[3] = start_high[3] = end_low[3] = end_high[3] = 0;
}

void WayLanes::clear() {
  for (uint32_t k = 0; k < 3; ++k) {
    start_low_[k].fill(HUGE_VALF);
    start_high_[k].fill(-HUGE_VALF);
  }
  end_low_ = start_low_;
  end_high_ = start_high_;
}

void WayLanes::set(uint32_t lane, const Way &way) {
  for (uint32_t k = 0; k < 3; ++k) {
    start_low_[k][lane] = static_cast<float>(way.start.low[k]);
    start_high_[k][lane] = static_cast<float>(way.start.high[k]);
    end_low_[k][lane] = static_cast<float>(way.end.low[k]);
    end_high_[k][lane] = static_cast<float>(way.end.high[k]);
  }
}

}  // namespace mvs
