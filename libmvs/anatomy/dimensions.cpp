// Checks the fields of mvs_parametric_desc and fills in defaults.
#include "anatomy/dimensions.h"

#include <cinttypes>

#include "base/error.h"
#include "model/law.h"

namespace mvs::core {
namespace {

// Assigns `given` unless it is zero; throws outside of low .. high (NaN included).
void take(double &value, double given, double low, double high, const char *name, const char *unit,
          double in_unit) {
  if (given == 0) return;
  MVS_MUST(given >= low && given <= high, MVS_E_ARGUMENT, name,
           "parametric valve: %s is %g%s, it must be %g to %g%s (or 0 for %g%s)", name,
           given / in_unit, unit, low / in_unit, high / in_unit, unit, value / in_unit, unit);
  value = given;
}

void take_length(double &value, double given, double low, double high, const char *name) {
  take(value, given, low, high, name, " mm", mm);
}

void take_factor(double &value, double given, double low, double high, const char *name) {
  take(value, given, low, high, name, "", 1);
}

void take_count(uint32_t &value, uint32_t given, uint32_t low, uint32_t high, const char *name) {
  if (given == 0) return;
  MVS_MUST(given >= low && given <= high, MVS_E_ARGUMENT, name,
           "parametric valve: %s is %" PRIu32 ", it must be %" PRIu32 " to %" PRIu32
           " (or 0 for %" PRIu32 ")",
           name, given, low, high, value);
  value = given;
}

void must_not_exceed(double value, const char *name, double factor, double other,
                     const char *other_name) {
  MVS_MUST(value <= factor * other, MVS_E_ARGUMENT, name,
           "parametric valve: %s is %g mm, it must not exceed %g times %s (%g mm)", name,
           value / mm, factor, other_name, other / mm);
}

// Returns the defaults of a shape.
Dimensions defaults_of(ParametricShape shape) {
  Dimensions d;
  if (shape == ParametricShape::founding) return d;
  d.shape = shape;
  d.law = LeafletLawId::bilinear;
  d.chords = 100;
  d.branching = true;
  d.annulus_ap = 26e-3;
  d.anterior_height = 25e-3;
  d.posterior_height = 14e-3;
  d.thickness = 0.8e-3;
  d.indentation_depth = 1e-3;
  return d;
}

ParametricShape shape_of(const mvs_parametric_desc &desc) {
  MVS_MUST(desc.shape <= MVS_SHAPE_FOUNDING, MVS_E_ARGUMENT, "shape",
           "parametric valve: shape is %" PRIu32
           ", it must be 1 (healthy) or 2 (founding), or 0 "
           "for healthy",
           desc.shape);
  return desc.shape == 0 ? ParametricShape::healthy : static_cast<ParametricShape>(desc.shape);
}

// Checks combinations of dimensions.
void check_together(const Dimensions &d) {
  must_not_exceed(d.annulus_ap, "annulus_ap", 1.2, d.annulus_cc, "annulus_cc");
  must_not_exceed(d.annulus_cc, "annulus_cc", 2.5, d.annulus_ap, "annulus_ap");
  must_not_exceed(d.commissure_height, "commissure_height", 0.3, d.annulus_cc, "annulus_cc");
  must_not_exceed(d.indentation_depth, "indentation_depth", 0.4, d.posterior_height,
                  "posterior_height");
  MVS_MUST(d.papillary_depth >= d.coaptation_depth + 5 * mm, MVS_E_ARGUMENT, "papillary_depth",
           "parametric valve: papillary_depth is %g mm, it must be at least 5 mm more than "
           "coaptation_depth (%g mm)",
           d.papillary_depth / mm, d.coaptation_depth / mm);
}

}  // namespace

Dimensions resolve_dimensions(const mvs_parametric_desc &desc) {
  Dimensions d = defaults_of(shape_of(desc));
  MVS_MUST(desc.leaflet_law == 0 ||
               find_leaflet_law(static_cast<LeafletLawId>(desc.leaflet_law)) != nullptr,
           MVS_E_ARGUMENT, "leaflet_law",
           "parametric valve: leaflet_law is %" PRIu32
           ", it must be a number of "
           "MVS_LEAFLET_LAW_*, or 0 for the default of the shape",
           desc.leaflet_law);
  if (desc.leaflet_law != 0) d.law = static_cast<LeafletLawId>(desc.leaflet_law);
  take_count(d.vertices, desc.vertices, 200, 100000, "vertices");
  take_count(d.chords, desc.chords, 20, 400, "chords");
  MVS_MUST(desc.branching <= MVS_BRANCHING_STRAIGHT, MVS_E_ARGUMENT, "branching",
           "parametric valve: branching is %" PRIu32
           ", it must be 1 (trees) or 2 (straight), or 0 "
           "for the default of the shape",
           desc.branching);
  if (desc.branching != 0) d.branching = desc.branching == MVS_BRANCHING_TREES;
  take_length(d.annulus_ap, desc.annulus_ap, 10 * mm, 60 * mm, "annulus_ap");
  take_length(d.annulus_cc, desc.annulus_cc, 10 * mm, 70 * mm, "annulus_cc");
  take_length(d.saddle_height, desc.saddle_height, 0.01 * mm, 15 * mm, "saddle_height");
  take_length(d.anterior_height, desc.anterior_height, 8 * mm, 45 * mm, "anterior_height");
  take_length(d.posterior_height, desc.posterior_height, 5 * mm, 35 * mm, "posterior_height");
  take_length(d.commissure_height, desc.commissure_height, 3 * mm, 20 * mm, "commissure_height");
  take_length(d.thickness, desc.thickness, 0.1 * mm, 5 * mm, "thickness");
  take_length(d.papillary_depth, desc.papillary_depth, 10 * mm, 60 * mm, "papillary_depth");
  take_length(d.papillary_separation, desc.papillary_separation, 4 * mm, 50 * mm,
              "papillary_separation");
  take_factor(d.annulus_contraction, desc.annulus_contraction, 0.7, 1.3, "annulus_contraction");
  take_factor(d.annulus_scale, desc.annulus_scale, 0.25, 2, "annulus_scale");
  take_factor(d.chord_slack, desc.chord_slack, 0.5, 2, "chord_slack");
  take_length(d.indentation_depth, desc.indentation_depth, 0.01 * mm, 8 * mm, "indentation_depth");
  take_length(d.coaptation_depth, desc.coaptation_depth, 0.01 * mm, 15 * mm, "coaptation_depth");
  check_together(d);
  return d;
}

}  // namespace mvs::core
