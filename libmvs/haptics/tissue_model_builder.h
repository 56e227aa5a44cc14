// Builds the local tissue model of a tool from the simulated valve.
#pragma once

#include "haptics/tissue_model.h"
#include "solve/tools/tool_stiffness.h"

namespace mvs::core {

// Follows one tool. Force and origin are new in each model; the stiffness, which costs a
// factorisation and changes slowly, is recomputed after the tool has moved or after 32 calls.
class TissueModelBuilder {
 public:
  // Starts a contact of another tool, or of no tool.
  void begin_contact() {
    ++contact_;
    age_ = 0;
  }
  TissueModel nothing() const { return next(TissueModel::free); }
  // With the orientation of the hand the model of a tool with a torque includes it; a null one is
  // that of a device without motors for it.
  TissueModel of_tool(const Model &model, const State &state, const Tool &tool,
                      const Eigen::Quaterniond *orientation = nullptr);
  // The tension of a chord at its leaflet end, multiplied by `gain`.
  TissueModel of_chord(const Model &model, const State &state, const Chord &chord, const Vec3 &hand,
                       double gain) const;

 private:
  TissueModel next(uint32_t kind) const;
  bool needs_stiffness(const Model &model, const Tool &tool);
  void refresh_stiffness(const Model &model, const State &state, const Tool &tool, bool turns);

  uint64_t contact_ = 0;
  ToolFeel feel_{Backend::block};
  ToolStiffness stiffness_;
  Vec3 at_ = Vec3::Zero(), axis_ = Vec3::Zero();  // of the hand at the last stiffness
  bool turns_ = false;                            // that stiffness has rotation
  uint64_t valve_ = 0;                            // serial of its model
  uint32_t age_ = 0;                              // calls left until the next stiffness
};

}  // namespace mvs::core
