// One table lists the read-outs; JSON and text both come from it. Another lists the counts of the
// text.
#include "readouts.h"

#include <cmath>
#include <vector>

namespace cli {
namespace {

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
    {"coaptation_length_min_mm", mm, "Coaptation length, least", "mm", mm,
     &M::coaptation_length_min},
    {"coaptation_length_max_mm", mm, "Coaptation length, most", "mm", mm,
     &M::coaptation_length_max},
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

// One read-out of several valves, with its unit.
std::string row_text(const Readout &readout, const std::vector<const mvs_measures *> &valves) {
  std::string row = text("  %-27s", readout.label);
  for (const mvs_measures *measures : valves) {
    const double value = measures->*readout.value;
    row += std::isfinite(value) ? text("%10.2f", value * readout.text_scale) : text("%10s", "none");
  }
  return row + text(" %s", readout.unit);
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
  for (const Readout &readout : readouts) {
    const double value = measures.*readout.value;
    object[readout.key] = std::isfinite(value) ? Json(value * readout.scale) : Json();
  }
  object["chords_over_strain"] = measures.chords_over_strain;
  object["chords_over_tension"] = measures.chords_over_tension;
  return object;
}

std::string measures_text(const mvs_measures &measures) {
  std::string table;
  for (const Count &count : counts) {
    table += text("  %-27s%10u\n", count.label, measures.*count.value);
  }
  for (const Readout &readout : readouts) {
    const double value = measures.*readout.value;
    table += std::isfinite(value)
                 ? text("  %-27s%10.2f %s", readout.label, value * readout.text_scale, readout.unit)
                 : text("  %-27s%10s", readout.label, "none");
    if (readout.value == &M::regurgitant_orifice_area) table += text(" (%s)", leak_grade(value));
    table += '\n';
  }
  return table;
}

std::string measures_text(const mvs_measures &before, const mvs_measures &after) {
  std::string table;
  for (const Count &count : counts) {
    table += text("  %-27s%10u%10u\n", count.label, before.*count.value, after.*count.value);
  }
  for (const Readout &readout : readouts) {
    table += row_text(readout, {&before, &after});
    if (readout.value == &M::regurgitant_orifice_area) {
      table += text(" (%s, then %s)", leak_grade(before.regurgitant_orifice_area),
                    leak_grade(after.regurgitant_orifice_area));
    }
    table += '\n';
  }
  return table;
}

Json statistics_json(const Statistics &of) {
  Json object = Json::object();
  for (const Readout &readout : readouts) {
    const auto number = [&](const mvs_measures &m) {
      const double value = m.*readout.value;
      return std::isfinite(value) ? Json(value * readout.scale) : Json();
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
  std::string table = text("  %-27s%10s%10s%10s%10s\n", "", "plain", "least", "most", "deviation");
  for (const Count &count : counts) {
    table += text("  %-27s%10u%10u%10u\n", count.label, plain.*count.value, of.min.*count.value,
                  of.max.*count.value);
  }
  for (const Readout &readout : readouts) {
    table += row_text(readout, {&plain, &of.min, &of.max, &of.deviation});
    if (readout.value == &M::regurgitant_orifice_area) {
      const std::string least = leak_grade(of.min.*readout.value);
      const std::string most = leak_grade(of.max.*readout.value);
      table += least == most ? text(" (%s)", most.c_str())
                             : text(" (%s to %s)", least.c_str(), most.c_str());
    }
    table += '\n';
  }
  return table;
}

}  // namespace cli
