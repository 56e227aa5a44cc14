#include "tests/stability/valves.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace stability {
namespace {

using Point = std::array<double, 3>;

const std::map<std::string, uint32_t> sizes = {{"200", 200}, {"S", 425},  {"S2", 425},
                                               {"M", 1700},  {"L", 6800}, {"XL", 27000}};

nlohmann::json read_n32() {
  const char *folder = std::getenv("MVS_TEST_DATA");
  std::ifstream in((folder ? std::string(folder) : MVS_SOURCE_DIR "/../shared/data") +
                   "/kaiser_mitral_normal_1/N32.json");
  return in ? nlohmann::json::parse(in) : nlohmann::json();
}

std::vector<double> points_of(const nlohmann::json &mm) {
  std::vector<double> x;
  for (const auto &p : mm) {
    for (size_t k = 0; k < 3; ++k) x.push_back(p[k].get<double>() * 1e-3);
  }
  return x;
}

mvs_array rows(const std::vector<double> &x) {
  return {x.data(), x.size() / 3, 3, MVS_TYPE_F64, 0};
}

mvs_array indices(const std::vector<uint32_t> &v, uint32_t components) {
  return {v.data(), v.size() / components, components, MVS_TYPE_U32, 0};
}

// One leaflet sheet with the library's own tissue, as designed to hang under 120 mmHg.
void make_n32(mvs::Simulator &sim) {
  const nlohmann::json data = read_n32();
  const std::vector<double> nodes = points_of(data["vertices_relaxed"]);
  const std::vector<double> loaded = points_of(data["vertices_pressurized"]);
  std::vector<uint32_t> triangles;
  for (const auto &t : data["faces"]) triangles.insert(triangles.end(), {t[0], t[1], t[2]});
  const std::vector<uint32_t> leaflet(triangles.size() / 3, 0);
  const auto annulus = data["annulus"].get<std::vector<uint32_t>>();
  std::vector<mvs_chord_desc> chords;
  for (const auto &c : data["chordae"]) {
    mvs_chord_desc chord = {};
    chord.node_a = c[0];
    chord.node_b = c[1];
    chord.rest_length = c[3].get<double>() * 1e-3;
    chords.push_back(chord);
  }
  std::vector<mvs_head_desc> heads;
  for (const auto &n : data["papillary"]) heads.push_back({n, 0, 0, nullptr});
  mvs_leaflet_desc sheet = {};
  sheet.name = "sheet";
  mvs_valve_desc valve = {};
  valve.flags = MVS_VALVE_FLAG_ORIENT;
  valve.nodes = rows(nodes);
  valve.nodes_loaded = rows(loaded);
  valve.triangles = indices(triangles, 3);
  valve.triangle_leaflet = indices(leaflet, 1);
  valve.annulus = indices(annulus, 1);
  valve.leaflets = &sheet;
  valve.leaflet_count = 1;
  valve.chords = chords.data();
  valve.chord_count = static_cast<uint32_t>(chords.size());
  valve.heads = heads.data();
  valve.head_count = static_cast<uint32_t>(heads.size());
  sim.set_valve(valve);
}

std::string numbers(const char *word, const Point &p) {
  char line[128];
  std::snprintf(line, sizeof line, "%s %.17g %.17g %.17g\n", word, p[0] * 1e3, p[1] * 1e3,
                p[2] * 1e3);
  return line;
}

bool starts_with(const std::string &line, const char *word) {
  return line.rfind(word, 0) == 0;
}

Point row_of(const mvs::View<double> &view, size_t n) {
  return {view.row(n)[0], view.row(n)[1], view.row(n)[2]};
}

}  // namespace

bool is_there(const std::string &name) {
  return name != "N32" || !read_n32().is_null();
}

void make_valve(mvs::Simulator &sim, const std::string &name) {
  if (name == "N32") return make_n32(sim);
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.vertices = sizes.at(name);
  desc.branching = name == "S2";
  sim.generate(desc);
}

const mvs::Snapshot &closed_valve(const std::string &name) {
  static std::map<std::string, mvs::Snapshot> kept;
  const auto found = kept.find(name);
  if (found != kept.end()) return found->second;
  mvs::Simulator sim;
  make_valve(sim, name);
  sim.set_load(MVS_SYSTOLE_PA);
  if (!sim.settle().converged) throw std::runtime_error("the valve " + name + " does not close");
  return kept.emplace(name, sim.snapshot()).first->second;
}

mvs_result set_displaced(mvs::Simulator &sim, const mvs::Snapshot &from, Places which,
                         const Displacement &displaced) {
  const auto kinds = from.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const auto now = from.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto rest = from.view<double>(MVS_ARRAY_NODE_REST);
  std::istringstream in(from.save_memory());
  std::string out, line;
  size_t n = 0, statements = 0;
  while (std::getline(in, line)) {
    if (starts_with(line, "#mvs rest ")) continue;  // replaced by a line for every node below
    statements += starts_with(line, "#mvs ");
    // the last line holds the number of lines
    if (starts_with(line, "#mvs end ")) {
      line = line.substr(0, line.rfind('=') + 1) + std::to_string(statements);
    }
    if (!starts_with(line, "v ")) {
      out += line + '\n';
      continue;
    }
    const uint8_t kind = kinds.data()[n];
    const Point x = row_of(now, n), r = row_of(rest, n);
    out += numbers("v", which == Places::now ? displaced(n, kind, x) : x);
    out += numbers("#mvs rest", which == Places::rest ? displaced(n, kind, r) : r);
    ++statements;
    ++n;
  }
  return mvs_load_memory(sim.get(), out.data(), out.size(), MVS_FORMAT_OBJ);
}

}  // namespace stability
