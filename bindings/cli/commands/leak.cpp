// `mvs leak`: where a valve leaks, by scallop and commissure, and the parts of the orifice.
#include <algorithm>

#include "commands/commands.h"
#include "valve/host.h"

namespace cli {
namespace {

struct LeakOptions {
  std::string file;
};

// A figure of a region: its key in JSON, its heading in the table, and its value in their unit,
// which is that of the same measure in `mvs measure`.
struct Column {
  const char *key, *head;
  double mvs_region_measures::*value;
  double scale;
  int digits;
};
constexpr Column columns[] = {
    {"orifice_area_mm2", "orifice mm2", &mvs_region_measures::orifice_area, 1e6, 2},
    {"gap_mm", "gap mm", &mvs_region_measures::gap, 1e3, 2},
    {"coaptation_area_mm2", "coapted mm2", &mvs_region_measures::coaptation_area, 1e6, 1},
    {"coaptation_length_mean_mm", "length mm", &mvs_region_measures::coaptation_length_mean, 1e3,
     2},
    {"coaptation_length_min_mm", "least mm", &mvs_region_measures::coaptation_length_min, 1e3, 2},
    {"billow_height_mm", "billow mm", &mvs_region_measures::billow_height, 1e3, 2},
    {"billow_volume_ml", "billow ml", &mvs_region_measures::billow_volume, 1e6, 3},
    {"tenting_height_mm", "tenting mm", &mvs_region_measures::tenting_height, 1e3, 2},
    {"tenting_volume_ml", "tenting ml", &mvs_region_measures::tenting_volume, 1e6, 3},
};

const char *kind_name(uint32_t kind) {
  return kind == MVS_REGION_COMMISSURE ? "commissure" : "scallop";
}

Json region_json(const mvs_region_measures &region) {
  Json row = {{"name", region.name}, {"kind", kind_name(region.kind)}};
  for (const Column &column : columns) row[column.key] = region.*column.value * column.scale;
  return row;
}

Json part_json(const mvs_orifice_part &part) {
  const auto &c = part.centroid, &d = part.direction;
  return {{"area_mm2", part.area * 1e6},     {"gap_mm", part.gap * 1e3},
          {"anterior", part.anterior},       {"posterior", part.posterior},
          {"commissures", part.commissures}, {"centroid_mm", {c[0] * 1e3, c[1] * 1e3, c[2] * 1e3}},
          {"direction", {d[0], d[1], d[2]}}, {"triangles", part.triangles}};
}

std::string region_lines(const std::vector<mvs_region_measures> &regions) {
  int name = 6;
  for (const mvs_region_measures &region : regions) {
    name = std::max(name, static_cast<int>(std::string(region.name).size()));
  }
  std::string table = text("\n  %-*s", name, "region");
  for (const Column &column : columns) table += text("  %11s", column.head);
  for (const mvs_region_measures &region : regions) {
    table += text("\n  %-*s", name, region.name);
    for (const Column &column : columns) {
      table += text("  %11.*f", column.digits, region.*column.value * column.scale);
    }
  }
  return table;
}

// "between A2 and P2", "within P2", and the commissures.
std::string place_text(const mvs_orifice_part &part) {
  const std::string anterior = part.anterior, posterior = part.posterior,
                    commissures = part.commissures;
  const bool both = !anterior.empty() && !posterior.empty();
  std::string place =
      both ? "between " + anterior + " and " + posterior : "within " + anterior + posterior;
  if (!commissures.empty()) place += ", at the commissure " + commissures;
  return place;
}

std::string part_lines(const std::vector<mvs_orifice_part> &parts) {
  std::string lines;
  for (size_t k = 0; k < parts.size(); ++k) {
    const mvs_orifice_part &part = parts[k];
    const auto &c = part.centroid, &d = part.direction;
    lines += text(
        "\n  opening %zu: %.2f mm2, %.2f mm wide, %s; centre %.1f %.1f %.1f mm, jet "
        "%.2f %.2f %.2f",
        k + 1, part.area * 1e6, part.gap * 1e3, place_text(part).c_str(), c[0] * 1e3, c[1] * 1e3,
        c[2] * 1e3, d[0], d[1], d[2]);
  }
  return lines;
}

void run_leak(const LeakOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  const std::vector<mvs_region_measures> regions = valve.regions();
  const std::vector<mvs_orifice_part> parts = valve.orifice_parts();
  const double pressure_mmhg = valve.load().pressure / pa_per_mmhg;
  const bool at_rest = valve.at_rest();
  Json region_rows = Json::array(), part_rows = Json::array();
  for (const mvs_region_measures &region : regions) region_rows.push_back(region_json(region));
  for (const mvs_orifice_part &part : parts) part_rows.push_back(part_json(part));
  // not the sum of the openings, which rounds differently
  const mvs_measures measures =
      valve.measure(MVS_MEASURE_GROUP_ORIFICE | MVS_MEASURE_GROUP_CROSSINGS);
  const double area = measures.regurgitant_orifice_area;
  const uint32_t crossing = measures.intersections;
  std::string state = at_rest ? "" : ", not at rest";
  if (crossing != 0) {
    state +=
        text("; the leaflets cross (%u pairs of triangles): the figures do not count", crossing);
  }
  const std::string verdict = parts.empty() ? std::string(crossing != 0 ? "no orifice" : "sealed")
                                            : text("orifice %.2f mm2", area * 1e6);
  print(console,
        {{"file", options.file},
         {"pressure_mmHg", pressure_mmhg},
         {"at_rest", at_rest},
         {"intersections", crossing},
         {"regurgitant_orifice_area_mm2", area * 1e6},
         {"regions", region_rows},
         {"openings", part_rows}},
        text("%s: %s under %g mmHg%s", options.file.c_str(), verdict.c_str(), pressure_mmhg,
             state.c_str()) +
            part_lines(parts) + region_lines(regions));
}

}  // namespace

void add_leak(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<LeakOptions>(
      app, console, "leak",
      "show where a valve leaks: each opening with its scallops and jet, and coaptation, gap, "
      "billow and tenting of each scallop and commissure",
      run_leak);
  command->add_option("file", options->file, "closed valve, .obj, .h5 or .inp")->required();
}

}  // namespace cli
