// Local tissue models of grasps, balls, rods and chordae.
#include "haptics/tissue_model_builder.h"

#include "model/chord_law.h"
#include "model/model.h"

namespace mvs::core {
namespace {

constexpr double same_place = 0.5e-3;  // m, motion of the tool within which its stiffness is reused
constexpr uint32_t refresh_calls = 32;  // a stiffness is reused for at most this many calls...
constexpr uint32_t least_calls = 8;     // ...and, within one contact, for at least this many

}  // namespace

TissueModel TissueModelBuilder::next(uint32_t kind) const {
  TissueModel tissue;
  tissue.kind = kind;
  tissue.contact = contact_;
  return tissue;
}

void TissueModelBuilder::refresh_stiffness(const Model &model, const State &state,
                                           const Tool &tool) {
  const bool is_near = (tool.position - at_).norm() <= same_place;
  const bool serves =
      age_ > 0 && valve_ == model.serial && (is_near || age_ > refresh_calls - least_calls);
  age_ = serves ? age_ - 1 : refresh_calls;
  if (serves) return;
  stiffness_ = feel_.stiffness(model, state, tool);
  at_ = tool.position;
  valve_ = model.serial;
}

// A ball or rod without contact gets no stiffness, only the plane of the nearest tissue.
TissueModel TissueModelBuilder::of_tool(const Model &model, const State &state, const Tool &tool) {
  const bool grasp = tool.kind == ToolKind::grasp;
  const Room room = grasp ? Room{0, Vec3::Zero()} : room_of(model, state.x, tool);
  const bool touches = grasp || room.distance < tool_range(model);
  TissueModel tissue = next(grasp     ? TissueModel::held
                            : touches ? TissueModel::touched
                                      : TissueModel::near);
  tissue.origin = tool.position;
  tissue.most = tool.max_force;
  if (touches) {
    refresh_stiffness(model, state, tool);
    tissue.force = force_of(state, tool).force;
    tissue.stiffness = stiffness_;
    return tissue;
  }
  age_ = 0;
  if (room.away.isZero(0)) return nothing();
  tissue.normal = room.away;
  tissue.gap = room.distance - tool_range(model);
  tissue.stiffness = tool.stiffness * Mat3::Identity();
  return tissue;
}

TissueModel TissueModelBuilder::of_chord(const Model &model, const State &state, const Chord &chord,
                                         const Vec3 &hand, double gain) const {
  TissueModel tissue = next(TissueModel::pulled);
  const Vec3 d = state.x[chord.a] - state.x[chord.b];
  const double length = d.norm(), strain = length / chord.rest_length - 1;
  tissue.origin = hand;
  if (strain > 0) {
    const double tension = chord.area * chord_response(model.valve, chord, strain).stress;
    tissue.force = (gain * tension / length) * d;
  }
  tissue.most = tissue.force.norm();
  return tissue;
}

}  // namespace mvs::core
