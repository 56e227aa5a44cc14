// The measures of mvs_snapshot_measure and of the derived arrays of a snapshot. Each group has one
// header that others include; DEFINITIONS.md has the definitions.
#pragma once

#include "measure/annulus/annulus.h"
#include "measure/annulus/frame.h"
#include "measure/coaptation/coaptation.h"
#include "measure/comparison/compare.h"
#include "measure/cost/outflow.h"
#include "measure/orifice/orifice.h"
#include "measure/regions/regions.h"
#include "measure/tenting/tenting_billow.h"
#include "measure/tissue/chords.h"
#include "measure/tissue/section.h"
#include "measure/tissue/strain.h"
#include "measure/tissue/tensors.h"
