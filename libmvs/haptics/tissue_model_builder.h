// From the simulated valve to the model of the tissue that a servo renders.
#pragma once

#include "haptics/tissue_model.h"
#include "solve/tools/tool_stiffness.h"

namespace mvs::core {

// Follows one tool. Force and place are new each time; the stiffness, which costs a factorisation
// and changes slowly, is worked out again when the tool has moved or enough time has gone.
class TissueModelBuilder {
 public:
  // Another tool, or none.
  void begin_contact() {
    ++contact_;
    age_ = 0;
  }
  TissueModel nothing() const { return next(TissueModel::free); }
  TissueModel of_tool(const Model &model, const State &state, const Tool &tool);
  // The tension of a chord, `gain` times, as its leaflet end feels it.
  TissueModel of_chord(const Model &model, const State &state, const Chord &chord, const Vec3 &hand,
                       double gain) const;

 private:
  TissueModel next(uint32_t kind) const;
  void refresh_stiffness(const Model &model, const State &state, const Tool &tool);

  uint64_t contact_ = 0;
  ToolFeel feel_{MVS_BACKEND_BLOCK};
  Mat3 stiffness_ = Mat3::Zero();
  Vec3 at_ = Vec3::Zero();  // where the hand was when that was worked out
  uint64_t valve_ = 0;      // of which model
  uint32_t age_ = 0;        // calls left until it is worked out again
};

}  // namespace mvs::core
