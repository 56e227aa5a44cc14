// From a patient's surface and landmarks to a complete valve.
#pragma once

#include "model/model.h"
#include "patient/fit/leak_interval.h"
#include "patient/patient_surface.h"
#include "solve/solver.h"

namespace mvs::core {

struct BuiltValve {
  ModelPtr model;
  Findings findings;
  LeakInterval leak;  // zeros unless it is found
};

// Tells the host the share of the work that is done; throws MVS_E_CANCELLED if it cancels.
void tell_progress(const Progress &progress, double share);

BuiltValve build_valve(const PatientSurface &surface, const BuildSettings &settings,
                       const Progress &progress);

}  // namespace mvs::core
