// What a hand does in a valve: takes, drags, lets go, pushes, feels.
#pragma once

#include <mvs/tool.h>

#include "haptics/servo_types.h"
#include "haptics/tissue_model_builder.h"
#include "session/device_view.h"
#include "session/simulator.h"

namespace mvs::core {

class Hand {
 public:
  // Both throw MVS_E_ARGUMENT.
  void set_hand(const mvs_device_hand &given);
  void set_view(const mvs_device_view &given) {
    view_ = DeviceView::read(given);
    maker_.begin_contact();  // the same tissue lies elsewhere for the servo
  }
  const mvs_device_hand &hand() const { return hand_; }
  const DeviceView &view() const { return view_; }

  // The hand is at this pose of the device; before anything else of a sync. `most` N/m.
  void begin(const ServoStatus &current, double most);
  void take_button(const ButtonEvent &event, mvs_sim &sim);
  // Follows the hand, with its tool or without one.
  void follow(mvs_sim &sim);
  // Lets go of everything.
  void let_go(mvs_sim &sim);
  // The tissue for the servo, in the frame of the device.
  TissueModel tissue(mvs_sim &sim);
  mvs_device_report report(const mvs_sim &sim, const TissueModel &tissue, bool latched) const;

 private:
  const Tool *tool(const mvs_sim &sim) const;
  const Chord *chord(const mvs_sim &sim) const;
  void press(mvs_sim &sim);
  void release(mvs_sim &sim);
  void choose_chord(const mvs_sim &sim);
  bool add(mvs_sim &sim, mvs_tool_desc desc);
  mvs_tool_desc describe(uint32_t kind) const;
  Vec3 axis() const;

  DeviceView view_;
  mvs_device_hand hand_ = {};
  TissueModelBuilder maker_;
  Vec3 place_ = Vec3::Zero();  // in the scene
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  double most_ = 0;  // N/m
  Id tool_ = 0, chord_ = 0;
  bool down_ = false, changed_ = true;
  uint32_t events_ = 0;
  Vec3 drag_to_ = Vec3::Zero();
  Vec3 felt_ = Vec3::Zero();  // of the chord, on the hand
};

}  // namespace mvs::core
