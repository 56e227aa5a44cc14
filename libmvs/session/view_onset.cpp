// No force at first, then a ramp: the servo's of a new grasp, or steps from sync to sync.
#include "session/view_onset.h"

#include <algorithm>

namespace mvs::core {
namespace {

constexpr double onset_s = 0.05;      // s, as that of a new grasp
constexpr uint64_t unseen_ticks = 2;  // the servo takes a model in this time

}  // namespace

void ViewOnset::see(const DeviceView &view, const ServoStatus &current) {
  if (has_view_ && view.jumps_from(view_, current.pose.position)) {
    jumped_ = true;
    jump_ticks_ = current.ticks;
    jump_s_ = current.time;
  }
  view_ = view;
  has_view_ = true;
  passed_ticks_ = current.ticks - jump_ticks_;
  passed_s_ = current.time - jump_s_;
}

// The servo begins its own ramp where a grasp or a felt chord follows upon no force.
TissueModel ViewOnset::applied(const TissueModel &tissue) const {
  if (!jumped_) return tissue;
  if (tissue.kind == TissueModel::held || tissue.kind == TissueModel::pulled) {
    TissueModel free;
    free.contact = tissue.contact;
    return passed_ticks_ < unseen_ticks ? free : tissue;
  }
  return scaled(tissue, std::clamp(passed_s_ / onset_s, 0.0, 1.0));
}

}  // namespace mvs::core
