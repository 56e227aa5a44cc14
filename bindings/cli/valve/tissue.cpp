#include "valve/tissue.h"

#include <algorithm>

#include "commands/commands.h"

namespace cli {
namespace {

// The words of MVS_LEAFLET_LAW_*, from 1.
std::vector<std::string> known_laws() {
  std::vector<std::string> words;
  mvs_law law = {};
  law.struct_size = sizeof law;
  for (uint32_t k = 0; k < mvs_get_leaflet_law_count(); ++k) {
    mvs::must(mvs_get_leaflet_law(k, &law));
    words.emplace_back(law.word);
  }
  return words;
}

std::vector<uint32_t> law_numbers(const mvs::Snapshot &valve) {
  const auto view = valve.view<uint32_t>(MVS_ARRAY_LEAFLET_LAW);
  return {view.data(), view.data() + view.rows()};
}

}  // namespace

void add_tissue_option(CLI::App &command, std::string &choice) {
  std::vector<std::string> words = {"file", "membrane"};
  const std::vector<std::string> laws = known_laws();
  words.insert(words.end(), laws.begin(), laws.end());
  command
      .add_option(
          "--leaflet", choice,
          "tissue of the leaflets: as in the file, membrane in place of springs (the founding "
          "model), or a law")
      ->capture_default_str()
      ->check(one_of(words));
}

void add_law_option(CLI::App &command, std::string &choice, const std::string &fallback) {
  std::vector<std::string> words = {"membrane"};
  const std::vector<std::string> laws = known_laws();
  words.insert(words.end(), laws.begin(), laws.end());
  command
      .add_option(
          "--leaflet", choice,
          "tissue of the leaflets: membrane (the law bilinear), spring (the founding model), "
          "or another law [" +
              fallback + "]")
      ->check(one_of(words));
}

mvs_leaflet_law law_of(const std::string &choice) {
  if (choice.empty()) return 0;
  if (choice == "membrane") return MVS_LEAFLET_LAW_BILINEAR;
  const std::vector<std::string> laws = known_laws();
  const auto at = std::find(laws.begin(), laws.end(), choice) - laws.begin();
  return static_cast<mvs_leaflet_law>(at) + 1;
}

mvs_leaflet_law law_of_finding(double number, const std::string &path) {
  for (mvs_leaflet_law law = 1; law <= mvs_get_leaflet_law_count(); ++law) {
    if (number == law) return law;
  }
  fail(MVS_E_FORMAT, "tissue",
       path + text(": the finding \"tissue\" has the value %g: it has to be the number of a law of "
                   "leaflets, 1 to %u",
                   number, mvs_get_leaflet_law_count()));
}

void set_tissue(mvs::Simulator &sim, const std::string &choice) {
  if (choice == "file") return;
  const std::vector<std::string> laws = known_laws();
  const mvs::Snapshot before = sim.snapshot();
  const std::vector<uint32_t> now = law_numbers(before);
  const std::vector<mvs_part> leaflets = before.parts(MVS_PART_LEAFLET);
  for (uint32_t l = 0; l < now.size(); ++l) {
    mvs_leaflet_desc tissue = {};
    if (choice != "membrane") {
      tissue.law =
          static_cast<uint32_t>(std::find(laws.begin(), laws.end(), choice) - laws.begin()) + 1;
    } else if (now[l] == MVS_LEAFLET_LAW_SPRING) {
      tissue.law = MVS_LEAFLET_LAW_BILINEAR;
    } else {
      continue;
    }
    if (tissue.law != now[l]) sim.set_leaflet(tissue, leaflets[l].id);
  }
}

std::string laws_of(const mvs::Snapshot &valve) {
  const std::vector<std::string> laws = known_laws();
  std::vector<uint32_t> listed;
  std::string text;
  for (const uint32_t law : law_numbers(valve)) {
    if (std::find(listed.begin(), listed.end(), law) != listed.end()) continue;
    listed.push_back(law);
    text += (text.empty() ? "" : ", ") + laws[law - 1];
  }
  return text;
}

Json tissue_rows(const mvs::Snapshot &valve) {
  const std::vector<mvs_part> leaflets = valve.parts(MVS_PART_LEAFLET);
  const std::vector<uint32_t> laws = law_numbers(valve);
  const auto constants = valve.view<double>(MVS_ARRAY_LEAFLET_CONSTANTS);
  const auto leaflet = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_LEAFLET);
  const auto thickness = valve.view<double>(MVS_ARRAY_TRIANGLE_THICKNESS);
  Json rows = Json::array();
  for (uint32_t l = 0; l < leaflets.size(); ++l) {
    mvs_law law = {};
    law.struct_size = sizeof law;
    mvs::must(mvs_get_leaflet_law(laws[l] - 1, &law));
    Json values = Json::object(), units = Json::object();
    for (uint32_t k = 0; k < law.constant_count; ++k) {
      values[law.constants[k].key] = constants.row(l)[1 + k];
      units[law.constants[k].key] = law.constants[k].unit;
    }
    double thin = 1e300, thick = 0;
    for (size_t t = 0; t < leaflet.rows(); ++t) {
      if (*leaflet.row(t) != l) continue;
      thin = std::min(thin, *thickness.row(t));
      thick = std::max(thick, *thickness.row(t));
    }
    rows.push_back({{"leaflet", leaflets[l].name},
                    {"law", law.word},
                    {"constants", values},
                    {"units", units},
                    {"thickness_min_mm", thin * 1e3},
                    {"thickness_max_mm", thick * 1e3}});
  }
  return rows;
}

std::string tissue_text(const Json &rows) {
  std::string out;
  for (const Json &row : rows) {
    const double thin = row["thickness_min_mm"], thick = row["thickness_max_mm"];
    out += text("    %-14s %s", row["leaflet"].get<std::string>().c_str(),
                row["law"].get<std::string>().c_str());
    for (const auto &[key, value] : row["constants"].items()) {
      const std::string unit = row["units"][key];
      out += text(", %s %g%s%s", key.c_str(), value.get<double>(), unit.empty() ? "" : " ",
                  unit.c_str());
    }
    out += thick - thin < 0.005 ? text(", %.2f mm thick\n", thick)
                                : text(", %.2f to %.2f mm thick\n", thin, thick);
  }
  return out;
}

}  // namespace cli
