// Ramp of the force after a jump of the view, under which tissue moves by at once what a hand would
// need time for.
#pragma once

#include <cstdint>

#include "haptics/servo_types.h"
#include "session/device_view.h"

namespace mvs::core {

class ViewOnset {
 public:
  // Each sync: compares the view with that of the sync before.
  void see(const DeviceView &view, const ServoStatus &current);
  // The servo begins anew, with its time.
  void restart() { jumped_ = false; }
  TissueModel applied(const TissueModel &tissue) const;

 private:
  DeviceView view_;
  bool has_view_ = false, jumped_ = false;
  uint64_t jump_ticks_ = 0, passed_ticks_ = 0;  // of the servo, at the jump and since then
  double jump_s_ = 0, passed_s_ = 0;            // likewise
};

}  // namespace mvs::core
