// Fields of mvs_measures from the results of the measures, by group.
#pragma once

#include <mvs/snapshot.h>

#include "measure/measure.h"

namespace mvs::core {

void fill_group(const Orifice &orifice, mvs_measures &m);
void fill_group(const Coaptation &coaptation, mvs_measures &m);
void fill_group(const TentingBillow &measured, mvs_measures &m);
void fill_group(const AnnulusMeasures &annulus, mvs_measures &m);
void fill_group(const ChordMeasures &chords, mvs_measures &m);
void fill_group(const Strain &strain, mvs_measures &m);

// Measures a group at x and fills its fields; no group: none. The crossings are not filled.
void measure_group(const Model &model, const std::vector<Vec3> &x, uint32_t group, mvs_measures &m);

// Measures the group of a field at x and returns the field; 0 for a field without a group or of the
// crossings.
double measure_field(const Model &model, const std::vector<Vec3> &x, const mvs_field_info &field);

}  // namespace mvs::core
