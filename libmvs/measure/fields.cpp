// The only place where results of the measures become fields of mvs_measures.
#include "measure/fields.h"

#include "base/struct_fields.h"

namespace mvs::core {

void fill_group(const Orifice &orifice, mvs_measures &m) {
  m.regurgitant_orifice_area = orifice.area;
}

void fill_group(const Coaptation &coaptation, mvs_measures &m) {
  m.coaptation_area = coaptation.area;
  m.coaptation_length_mean = coaptation.length_mean;
  m.coaptation_length_min = coaptation.length_min;
  m.coaptation_length_max = coaptation.length_max;
  m.coaptation_height = coaptation.height;
  m.coaptation_depth = coaptation.depth;
}

void fill_group(const TentingBillow &measured, mvs_measures &m) {
  m.tenting_height = measured.tenting_height;
  m.tenting_area = measured.tenting_area;
  m.tenting_volume = measured.tenting_volume;
  m.billow_height = measured.billow_height;
  m.billow_volume = measured.billow_volume;
}

void fill_group(const AnnulusMeasures &annulus, mvs_measures &m) {
  m.annulus_ap = annulus.ap;
  m.annulus_cc = annulus.cc;
  m.annulus_perimeter = annulus.perimeter;
  m.annulus_area_3d = annulus.area_3d;
  m.annulus_area = annulus.area;
  m.annulus_saddle_height = annulus.saddle_height;
  m.annulus_nonplanar_angle = annulus.nonplanar_angle;
}

void fill_group(const ChordMeasures &chords, mvs_measures &m) {
  m.max_chord_strain = chords.max_strain;
  m.max_chord_tension = chords.max_tension;
  m.chords_over_strain = chords.over_strain;
  m.chords_over_tension = chords.over_tension;
}

void fill_group(const Strain &measured, mvs_measures &m) {
  m.max_leaflet_strain = measured.max_strain;
  m.max_leaflet_stress = measured.max_stress;
  m.leaflet_area = measured.leaflet_area;
  const Percentiles &strain = measured.strain_percentiles;
  m.leaflet_strain_p50 = strain.p50;
  m.leaflet_strain_p95 = strain.p95;
  m.leaflet_strain_p99 = strain.p99;
  const Percentiles &stress = measured.stress_percentiles;
  m.leaflet_stress_p50 = stress.p50;
  m.leaflet_stress_p95 = stress.p95;
  m.leaflet_stress_p99 = stress.p99;
}

void measure_group(const Model &model, const std::vector<Vec3> &x, uint32_t group,
                   mvs_measures &m) {
  switch (group) {
    case MVS_MEASURE_GROUP_ORIFICE:
      fill_group(measure_orifice(model, x), m);
      break;
    case MVS_MEASURE_GROUP_COAPTATION:
      fill_group(measure_coaptation(model, x), m);
      break;
    case MVS_MEASURE_GROUP_TENTING:
      fill_group(measure_tenting_billow(model, x), m);
      break;
    case MVS_MEASURE_GROUP_ANNULUS:
      fill_group(measure_annulus(model, x), m);
      break;
    case MVS_MEASURE_GROUP_CHORDS:
      fill_group(measure_chords(model, x), m);
      break;
    case MVS_MEASURE_GROUP_LEAFLETS:
      fill_group(measure_strain(model, x), m);
      break;
    default:
      break;
  }
}

double measure_field(const Model &model, const std::vector<Vec3> &x, const mvs_field_info &field) {
  mvs_measures m = {};
  measure_group(model, x, field.group, m);
  return read_field(&m, field);
}

}  // namespace mvs::core
