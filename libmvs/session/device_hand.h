// The hand of a haptic device in the scene: grasps, pushes, feels chordae and drags, with one
// button.
#pragma once

#include <mvs/tool.h>

#include <vector>

#include "haptics/servo_types.h"
#include "haptics/tissue_model_builder.h"
#include "session/device_view.h"
#include "session/own_tools.h"
#include "session/simulator.h"
#include "session/view_onset.h"

namespace mvs::core {

// The numbers are those of the C interface.
enum class HandMode : uint32_t {
  look = MVS_HAND_MODE_LOOK,
  grasp = MVS_HAND_MODE_GRASP,
  ball = MVS_HAND_MODE_BALL,
  rod = MVS_HAND_MODE_ROD,
  feel = MVS_HAND_MODE_FEEL,
  drag = MVS_HAND_MODE_DRAG,
  convex = MVS_HAND_MODE_CONVEX
};

class Hand {
 public:
  // set_hand and set_view throw MVS_E_ARGUMENT.
  void set_hand(const mvs_device_hand &given, const ToolShapePtr &shape = {});
  void set_view(const mvs_device_view &given) {
    view_ = DeviceView::read(given);
    builder_.begin_contact();  // the device coordinates of the tissue change
  }
  const mvs_device_hand &hand() const { return hand_; }
  const DeviceView &view() const { return view_; }

  // Starts a sync with the present pose of the device.
  void begin(const ServoStatus &current, const StiffnessLimits &most);
  void take_button(const ButtonEvent &event, mvs_sim &sim);
  // After the last event: takes the present buttons, whose event may have found the queue full.
  void settle_buttons(const ServoStatus &current, mvs_sim &sim);
  // The device was started: lets go, and takes its buttons as up until an event.
  void restart(mvs_sim &sim);
  // Updates the tool after the hand: adds it, moves it, or removes it after a change of the mode.
  void follow(mvs_sim &sim);
  // Removes the tool of the hand and those that an undo has brought back.
  void leave(mvs_sim &sim);
  // Returns the local tissue model for the servo, in the frame of the device.
  TissueModel tissue(mvs_sim &sim);
  mvs_device_report report(const mvs_sim &sim, const TissueModel &tissue, bool latched) const;

 private:
  HandMode mode() const { return static_cast<HandMode>(hand_.mode); }
  const Tool *tool(const mvs_sim &sim) const { return tools_.held_in(sim); }
  const Chord *chord(const mvs_sim &sim) const;
  void press(mvs_sim &sim);
  void release(mvs_sim &sim);
  void choose_chord(const mvs_sim &sim);
  bool add(mvs_sim &sim, mvs_tool_desc desc);
  void let_go(mvs_sim &sim);
  bool wants(const Tool &tool) const;
  void take_back(mvs_sim &sim);
  void remove_returned(mvs_sim &sim);
  mvs_tool_desc describe(ToolKind kind) const;
  Vec3 axis() const;
  double stiffest_spring(ToolKind kind) const;
  double allowed_share(const Tool &tool) const;
  Quaternion turn() const { return {turn_.w(), turn_.x(), turn_.y(), turn_.z()}; }

  DeviceView view_;
  ViewOnset onset_;
  mvs_device_hand hand_ = {};
  ToolShapePtr shape_;  // of a convex tool
  TissueModelBuilder builder_;
  bool has_pose_ = false;      // the device has reported a pose since it was started
  Vec3 place_ = Vec3::Zero();  // of the hand, in the scene
  Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
  StiffnessLimits most_;
  OwnTools tools_;
  Id chord_ = 0;
  bool down_ = false, changed_ = true;
  uint64_t button_changes_ = 0;  // number of the newest one taken
  uint32_t events_ = 0;
  Vec3 drag_to_ = Vec3::Zero();
  Vec3 felt_ = Vec3::Zero();  // force of the felt chord on the hand
};

}  // namespace mvs::core
