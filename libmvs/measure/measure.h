// The read-outs: everything mvs_snapshot_measure and the derived arrays of a snapshot show.
// Each group is one header and one file of this folder; definitions are in README.md.
#pragma once

#include "measure/annulus.h"
#include "measure/chords.h"
#include "measure/coaptation.h"
#include "measure/compare.h"
#include "measure/frame.h"
#include "measure/orifice.h"
#include "measure/section.h"
#include "measure/strain.h"
#include "measure/tenting_billow.h"
