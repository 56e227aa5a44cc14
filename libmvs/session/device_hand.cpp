// Actions of the hand: button events, tools, tissue model, report.
#include "session/device_hand.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/option_checks.h"
#include "history/event_limits.h"
#include "linalg/eigenvalues.h"
#include "session/nearest.h"
#include "session/tools.h"

namespace mvs::core {

void Hand::set_hand(const mvs_device_hand &given, const ToolShapePtr &shape) {
  MVS_MUST(static_cast<HandMode>(given.mode) <= HandMode::convex, MVS_E_ARGUMENT, "hand.mode",
           "hand.mode is %u: it has to be one of MVS_HAND_MODE_*", given.mode);
  MVS_MUST(given.button < 32, MVS_E_ARGUMENT, "hand.button",
           "hand.button is %u: it has to be 0 to 31", given.button);
  must_be_zero(given.reserved, "hand.reserved");
  must_be_in(given.gain, 1e-3, 1e3, "hand.gain");
  const ToolSizes sizes =
      read_tool_sizes({given.radius, given.length, given.stiffness, given.max_force}, "hand");
  hand_ = given;
  hand_.bodies = nullptr;
  shape_ = shape;
  hand_.reach = read_reach(given.reach, 5e-3, "hand");
  hand_.radius = sizes.radius;
  hand_.length = sizes.length;
  hand_.stiffness = sizes.stiffness;
  hand_.max_force = sizes.max_force;
  hand_.gain = value_or(given.gain, 1);
  chord_ = hand_.chord;
  changed_ = true;
}

// A rod lies along the stylus, with its handle towards the user.
Vec3 Hand::axis() const {
  return turn_ * Vec3::UnitZ();
}

const Chord *Hand::chord(const mvs_sim &sim) const {
  for (const Chord &c : sim.current().model->valve.chords.get()) {
    if (c.id == chord_) return &c;
  }
  return nullptr;
}

void Hand::begin(const ServoStatus &current, const StiffnessLimits &most) {
  events_ = 0;
  most_ = most;
  onset_.see(view_, current);
  has_pose_ = current.has_pose;
  place_ = view_.to_scene(current.pose.position);
  turn_ = view_.turned(current.pose.orientation);
}

void Hand::take_button(const ButtonEvent &event, mvs_sim &sim) {
  button_changes_ = event.number;
  const bool down = (event.buttons >> hand_.button & 1) != 0;
  if (down == down_) return;
  down_ = down;
  events_ |= uint32_t{down ? MVS_EVENT_PRESSED : MVS_EVENT_RELEASED};
  // the position at the time of the button event, not the present one
  const Vec3 now = place_;
  place_ = view_.to_scene(event.position);
  down ? press(sim) : release(sim);
  place_ = now;
}

// The last event may be newer than the status.
void Hand::settle_buttons(const ServoStatus &current, mvs_sim &sim) {
  if (button_changes_ > current.button_changes) return;
  take_button({current.buttons, current.button_changes, current.pose.position}, sim);
}

void Hand::restart(mvs_sim &sim) {
  onset_.restart();
  button_changes_ = 0;
  if (down_) events_ |= MVS_EVENT_RELEASED;
  down_ = false;
  leave(sim);
}

void Hand::press(mvs_sim &sim) {
  if (mode() == HandMode::grasp && tools_.held() == 0) {
    const bool found = add(sim, describe(ToolKind::grasp));
    events_ |= uint32_t{found ? MVS_EVENT_GRASPED : MVS_EVENT_MISSED};
  }
  if (mode() != HandMode::feel && mode() != HandMode::drag) return;
  if (hand_.chord == 0) choose_chord(sim);
  const Chord *const chosen = chord(sim);
  if (!chosen || mode() == HandMode::feel || tools_.held() != 0) return;
  mvs_tool_desc desc = describe(ToolKind::grasp);
  desc.by_node = 1;
  desc.node = chosen->b;
  if (add(sim, desc)) events_ |= MVS_EVENT_GRASPED;
}

void Hand::choose_chord(const mvs_sim &sim) {
  const NearChord found = nearest_chord(sim.current(), place_);
  if (found.distance > hand_.reach) {
    events_ |= MVS_EVENT_MISSED;
    return;
  }
  chord_ = found.id;
  events_ |= MVS_EVENT_CHOSEN;
  builder_.begin_contact();
}

void Hand::release(mvs_sim &sim) {
  const Tool *const held = tool(sim);
  if (!held || held->kind != ToolKind::grasp) return;
  if (mode() == HandMode::drag && !changed_) {
    drag_to_ = sim.current().state.x[held->node];
    events_ |= MVS_EVENT_DRAGGED;
  }
  let_go(sim);
}

void Hand::let_go(mvs_sim &sim) {
  if (tools_.held() == 0) return;
  if (tool(sim)) remove_tool_now(sim, tools_.held());
  tools_.drop();
  events_ |= MVS_EVENT_LET_GO;
  builder_.begin_contact();
}

// Returns the largest stiffness of a tool's spring, N/m, that the device renders stably through
// this view. A rod has half of it at each end: with the lever L its energy is
// k (x^2 + (x + L p)^2) / 4, whose larger eigenvalue in the metric of StiffnessLimits is k times
// `largest`. A convex tool has a quarter of it at each corner of a regular tetrahedron: with the
// arm a its energy is k (x^2 / 2 + a^2 p^2 / 3).
double Hand::stiffest_spring(ToolKind kind) const {
  const double linear = most_.linear / view_.stiffness_scale();
  const bool turns = kind == ToolKind::rod || kind == ToolKind::convex;
  if (!turns || most_.angular <= 0) return linear;
  const double angular = most_.angular / view_.torque_scale();
  if (kind == ToolKind::convex) {
    return std::min(linear, 1.5 * angular / (shape_->arm() * shape_->arm()));
  }
  const double a = 1 / linear, b = 0.5 * hand_.length * hand_.length / angular;
  const double half = 0.5 * (a - b), off2 = 0.25 * hand_.length * hand_.length / (linear * angular);
  const double largest = 0.5 * (a + b) + std::sqrt(half * half + off2);
  return 1 / largest;
}

// The spring of a tool that is held stays as it was made, for another view or limit: a share of its
// force is felt instead, and also where no spring may be so soft.
double Hand::allowed_share(const Tool &tool) const {
  return std::min(1.0, stiffest_spring(tool.kind) / tool.stiffness);
}

mvs_tool_desc Hand::describe(ToolKind kind) const {
  mvs_tool_desc desc = {};
  desc.struct_size = sizeof desc;
  desc.kind = static_cast<uint32_t>(kind);
  write(place_, desc.position);
  if (kind == ToolKind::rod) {
    write(axis(), desc.axis);
    desc.length = hand_.length;
  }
  const Quaternion turned = turn();
  if (kind == ToolKind::convex) std::copy(turned.begin(), turned.end(), desc.orientation);
  if (kind != ToolKind::grasp) desc.radius = hand_.radius;
  desc.reach = hand_.reach;
  desc.stiffness = std::max(1.0, std::min(hand_.stiffness, stiffest_spring(kind)));
  desc.max_force = hand_.max_force;
  return desc;
}

// Returns false if the position does not allow the tool.
bool Hand::add(mvs_sim &sim, mvs_tool_desc desc) {
  try {
    add_tool_now(sim, desc, shape_);
  } catch (const Error &error) {
    if (error.code != MVS_E_STATE && error.code != MVS_E_ARGUMENT) throw;
    return false;
  }
  tools_.add_newest(sim);
  builder_.begin_contact();
  return true;
}

// Whether the hand would add this tool now: with the button down, in this mode and of these sizes.
// Through another view the stiffness of its spring may be too large for the device.
bool Hand::wants(const Tool &tool) const {
  const mvs_tool_desc now = describe(tool.kind);
  if (tool.stiffness != now.stiffness || tool.max_force != now.max_force) return false;
  switch (tool.kind) {
    case ToolKind::grasp:
      return down_ && (mode() == HandMode::grasp || mode() == HandMode::drag);
    case ToolKind::ball:
      return mode() == HandMode::ball && tool.radius == hand_.radius;
    case ToolKind::rod:
      return mode() == HandMode::rod && tool.radius == hand_.radius && tool.length == hand_.length;
    default:
      return mode() == HandMode::convex && tool.shape == shape_;
  }
}

// Tools that returned with a state of the history have no hand, and would pull for ever.
void Hand::remove_returned(mvs_sim &sim) {
  std::vector<Id> gone;
  for (const Tool &t : sim.current().state.tools.get()) {
    if (t.id != tools_.held() && tools_.made(sim, t)) gone.push_back(t.id);
  }
  for (const Id id : gone) remove_tool_now(sim, id);
}

void Hand::take_back(mvs_sim &sim) {
  for (const Tool &t : sim.current().state.tools.get()) {
    if (tools_.held() != 0) break;
    if (!tools_.made(sim, t) || !wants(t)) continue;
    tools_.hold(t.id);
    if (t.kind == ToolKind::grasp) events_ |= MVS_EVENT_GRASPED;
    builder_.begin_contact();
  }
  remove_returned(sim);
}

void Hand::leave(mvs_sim &sim) {
  let_go(sim);
  remove_returned(sim);
}

void Hand::follow(mvs_sim &sim) {
  if (changed_) let_go(sim);
  if (changed_) builder_.begin_contact();
  changed_ = false;
  if (tools_.held() != 0 && !tool(sim)) {
    tools_.drop();
    events_ |= MVS_EVENT_LOST_TOOL;
    builder_.begin_contact();
  }
  take_back(sim);
  const Tool *const held = tool(sim);
  const bool pushes =
      mode() == HandMode::ball || mode() == HandMode::rod || mode() == HandMode::convex;
  if (pushes && tools_.held() == 0) {
    const ToolKind kind = mode() == HandMode::ball  ? ToolKind::ball
                          : mode() == HandMode::rod ? ToolKind::rod
                                                    : ToolKind::convex;
    if (!add(sim, describe(kind))) events_ |= MVS_EVENT_BLOCKED;
  } else if (held) {
    Tool moved = *held;
    // a scale of the view may carry it beyond the places that a recorded move may have
    moved.position = place_.cwiseMax(-limits::coordinate).cwiseMin(limits::coordinate);
    if (moved.kind == ToolKind::rod) moved.axis = axis();
    if (moved.kind == ToolKind::convex) moved.axis = rodrigues_of(turn());
    sim.hands.post(moved, moved.kind == ToolKind::rod || moved.kind == ToolKind::convex);
  }
}

TissueModel Hand::tissue(mvs_sim &sim) {
  const ModelState &now = sim.current();
  const Tool *const held = tool(sim);
  const Chord *const felt = mode() == HandMode::feel ? chord(sim) : nullptr;
  TissueModel scene = builder_.nothing();
  felt_ = Vec3::Zero();
  if (held) {
    scene = builder_.of_tool(*now.model, now.state, *held, most_.angular > 0 ? &turn_ : nullptr);
    scene = scaled(scene, allowed_share(*held));
  } else if (felt) {
    scene = builder_.of_chord(*now.model, now.state, *felt, place_, hand_.gain);
    felt_ = scene.force;
  }
  return view_.to_device(onset_.applied(scene), most_);
}

mvs_device_report Hand::report(const mvs_sim &sim, const TissueModel &tissue, bool latched) const {
  mvs_device_report out = {};
  const ModelState &now = sim.current();
  out.events = events_;
  if (latched) out.events |= MVS_EVENT_LATCHED;
  out.tool = tools_.held();
  out.chord = chord_;
  constexpr double far = std::numeric_limits<double>::infinity();
  const NearChord near_chord = has_pose_ ? nearest_chord(now, place_) : NearChord{0, far};
  out.near_chord = near_chord.id;
  out.near_chord_distance = near_chord.distance;
  const NearNode near_node = has_pose_ ? nearest_node(now, place_) : NearNode{none, far};
  out.near_node = near_node.node;
  out.near_node_distance = near_node.distance;
  const Tool *const held = tool(sim);
  out.node = held ? held->node : none;
  write(place_, out.position);
  const ToolForce force = held ? force_of(now.state, *held) : ToolForce{felt_, Vec3::Zero()};
  write(force.force, out.force);
  write(force.torque, out.torque);
  out.stiffness = largest_eigenvalue(tissue.stiffness);
  out.angular_stiffness = largest_eigenvalue(tissue.turning);
  write(drag_to_, out.drag_to);
  return out;
}

}  // namespace mvs::core
