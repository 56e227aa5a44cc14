#include "text/readouts.h"

#include <cmath>
#include <vector>

namespace cli {
namespace {

// Tables of the read-outs and of the counts, for JSON and text.
struct Readout {
  const char *key;  // in JSON, with its unit
  double scale;     // from SI to that unit
  const char *label;
  const char *unit;  // in text
  double text_scale;
  double mvs_measures::*value;
};

constexpr double mm = 1e3, mm2 = 1e6, ml = 1e6, kpa = 1e-3, degrees = 57.29577951308232;

using M = mvs_measures;
constexpr Readout readouts[] = {
    {"regurgitant_orifice_area_mm2", mm2, "Regurgitant orifice area", "mm2", mm2,
     &M::regurgitant_orifice_area},
    {"coaptation_area_mm2", mm2, "Coaptation area", "mm2", mm2, &M::coaptation_area},
    {"coaptation_length_mean_mm", mm, "Coaptation length, mean", "mm", mm,
     &M::coaptation_length_mean},
    {"coaptation_length_min_mm", mm, "Coaptation length, min", "mm", mm, &M::coaptation_length_min},
    {"coaptation_length_max_mm", mm, "Coaptation length, max", "mm", mm, &M::coaptation_length_max},
    {"coaptation_height_mm", mm, "Coaptation height", "mm", mm, &M::coaptation_height},
    {"coaptation_depth_mm", mm, "Coaptation depth", "mm", mm, &M::coaptation_depth},
    {"tenting_height_mm", mm, "Tenting height", "mm", mm, &M::tenting_height},
    {"tenting_area_mm2", mm2, "Tenting area", "mm2", mm2, &M::tenting_area},
    {"tenting_volume_ml", ml, "Tenting volume", "ml", ml, &M::tenting_volume},
    {"billow_height_mm", mm, "Billow height", "mm", mm, &M::billow_height},
    {"billow_volume_ml", ml, "Billow volume", "ml", ml, &M::billow_volume},
    {"annulus_ap_mm", mm, "Annulus AP diameter", "mm", mm, &M::annulus_ap},
    {"annulus_cc_mm", mm, "Annulus CC diameter", "mm", mm, &M::annulus_cc},
    {"annulus_perimeter_mm", mm, "Annulus perimeter", "mm", mm, &M::annulus_perimeter},
    {"annulus_area_3d_mm2", mm2, "Annulus area, 3D", "mm2", mm2, &M::annulus_area_3d},
    {"annulus_area_mm2", mm2, "Annulus area, projected", "mm2", mm2, &M::annulus_area},
    {"annulus_saddle_height_mm", mm, "Annulus saddle height", "mm", mm, &M::annulus_saddle_height},
    {"annulus_nonplanar_angle_deg", degrees, "Annulus non-planar angle", "deg", degrees,
     &M::annulus_nonplanar_angle},
    {"max_chord_strain", 1, "Chord strain, largest", "%", 100, &M::max_chord_strain},
    {"max_chord_tension_N", 1, "Chord tension, largest", "N", 1, &M::max_chord_tension},
    {"max_leaflet_strain", 1, "Leaflet strain, largest", "%", 100, &M::max_leaflet_strain},
    {"max_leaflet_stress_kPa", kpa, "Leaflet stress, largest", "kPa", kpa, &M::max_leaflet_stress},
    {"leaflet_area_mm2", mm2, "Leaflet area", "mm2", mm2, &M::leaflet_area},
};

struct Count {
  const char *key;  // in JSON
  const char *label;
  uint32_t mvs_measures::*value;
};

constexpr Count counts[] = {
    {"intersections", "Intersecting triangles", &M::intersections},
    {"chords_over_strain", "Chordae over their strain", &M::chords_over_strain},
    {"chords_over_tension", "Chordae over their tension", &M::chords_over_tension},
};

// Rows of labels and columns of valves; the first `count_columns` have counts. `leak` follows the
// row of the orifice area.
std::string table_text(const std::vector<const mvs_measures *> &columns, size_t count_columns,
                       const std::string &leak) {
  std::string table;
  for (const Count &count : counts) {
    table += text("  %-27s", count.label);
    for (size_t k = 0; k < count_columns; ++k) table += text("%10u", columns[k]->*count.value);
    table += '\n';
  }
  for (const Readout &readout : readouts) {
    table += text("  %-27s", readout.label);
    for (const mvs_measures *measures : columns) {
      const double value = measures->*readout.value;
      table +=
          std::isfinite(value) ? text("%10.2f", value * readout.text_scale) : text("%10s", "none");
    }
    table += text(" %s", readout.unit);
    if (readout.value == &M::regurgitant_orifice_area) table += " (" + leak + ")";
    table += '\n';
  }
  return table;
}

}  // namespace

// Grades by effective orifice area, 0.20, 0.30 and 0.40 cm2.
const char *leak_grade(double orifice_area) {
  const double cm2 = orifice_area * 1e4;
  if (cm2 == 0) return "sealed";
  if (cm2 < 0.2) return "mild";
  if (cm2 < 0.3) return "moderate";
  if (cm2 < 0.4) return "moderate to severe";
  return "severe";
}

Json measures_json(const mvs_measures &measures) {
  Json object = Json::object();
  for (const Readout &readout : readouts)
    object[readout.key] = number_json(measures.*readout.value, readout.scale);
  object["chords_over_strain"] = measures.chords_over_strain;
  object["chords_over_tension"] = measures.chords_over_tension;
  return object;
}

std::string measures_text(const mvs_measures &measures) {
  return table_text({&measures}, 1, leak_grade(measures.regurgitant_orifice_area));
}

std::string measures_text(const mvs_measures &before, const mvs_measures &after) {
  return table_text({&before, &after}, 2,
                    text("%s, then %s", leak_grade(before.regurgitant_orifice_area),
                         leak_grade(after.regurgitant_orifice_area)));
}

Json statistics_json(const Statistics &of) {
  Json object = Json::object();
  for (const Readout &readout : readouts) {
    const auto number = [&](const mvs_measures &m) {
      return number_json(m.*readout.value, readout.scale);
    };
    object[readout.key] = {{"mean", number(of.mean)},
                           {"min", number(of.min)},
                           {"max", number(of.max)},
                           {"deviation", number(of.deviation)},
                           {"members", static_cast<uint32_t>(of.count.*readout.value)}};
  }
  for (const Count &count : counts) {
    object[count.key] = {{"min", of.min.*count.value}, {"max", of.max.*count.value}};
  }
  return object;
}

std::string measures_text(const mvs_measures &plain, const Statistics &of) {
  const std::string least = leak_grade(of.min.regurgitant_orifice_area);
  const std::string most = leak_grade(of.max.regurgitant_orifice_area);
  return text("  %-27s%10s%10s%10s%10s\n", "", "plain", "min", "max", "deviation") +
         table_text({&plain, &of.min, &of.max, &of.deviation}, 3,
                    least == most ? least : least + " to " + most);
}

}  // namespace cli
