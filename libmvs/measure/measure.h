// The read-outs: everything mvs_snapshot_measure and the derived arrays of a snapshot show.
// Each group is one header and one file of this folder; definitions are in README.md.
#pragma once

#include "measure/annulus/annulus.h"
#include "measure/annulus/frame.h"
#include "measure/coaptation/coaptation.h"
#include "measure/comparison/compare.h"
#include "measure/orifice/orifice.h"
#include "measure/tenting/tenting_billow.h"
#include "measure/tissue/chords.h"
#include "measure/tissue/section.h"
#include "measure/tissue/strain.h"
