// `mvs info`: the parts of a valve, their sizes and tissue, and the number of intersecting
// triangles.
#include <algorithm>
#include <map>

#include "commands/commands.h"
#include "valve/chords.h"
#include "valve/tissue.h"

namespace cli {
namespace {

struct InfoOptions {
  std::string file;
};

struct ChordGroup {
  size_t count = 0;
  double shortest = 1e300, longest = 0;  // rest length, m
};

// Grouped by MVS_CHORD_KIND_*.
std::map<uint32_t, ChordGroup> chord_groups(const mvs::Snapshot &valve) {
  const auto kind = valve.view<uint32_t>(MVS_ARRAY_CHORD_KIND);
  const auto length = valve.view<double>(MVS_ARRAY_CHORD_REST_LENGTH);
  std::map<uint32_t, ChordGroup> groups;
  for (size_t c = 0; c < kind.rows(); ++c) {
    ChordGroup &group = groups[*kind.row(c)];
    ++group.count;
    group.shortest = std::min(group.shortest, *length.row(c));
    group.longest = std::max(group.longest, *length.row(c));
  }
  return groups;
}

// The number of rows of an index array that refer to each part.
std::vector<size_t> tally(const mvs::View<uint32_t> &rows, size_t part_count) {
  std::vector<size_t> count(part_count);
  for (const uint32_t row : rows) ++count[row];
  return count;
}

struct Info {
  std::vector<mvs_part> leaflets, scallops, heads;
  std::vector<size_t> leaflet_faces, scallop_faces;
  std::vector<size_t> head_chords;
  std::map<uint32_t, ChordGroup> chords;
  Size size;
  mvs_load_case load_case;
  mvs_measures measures;
};

std::vector<size_t> chords_of_heads(const mvs::Snapshot &valve) {
  const auto head_nodes = valve.view<uint32_t>(MVS_ARRAY_HEAD_NODES);
  const auto chord_nodes = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES);
  std::vector<size_t> count;
  for (const uint32_t node : head_nodes) {
    count.push_back(static_cast<size_t>(std::count(chord_nodes.begin(), chord_nodes.end(), node)));
  }
  return count;
}

Info gather(const mvs::Snapshot &valve) {
  Info info;
  info.leaflets = valve.parts(MVS_PART_LEAFLET);
  info.scallops = valve.parts(MVS_PART_SCALLOP);
  info.heads = valve.parts(MVS_PART_HEAD);
  info.leaflet_faces =
      tally(valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_LEAFLET), info.leaflets.size());
  info.scallop_faces =
      tally(valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_SCALLOP), info.scallops.size());
  info.head_chords = chords_of_heads(valve);
  info.chords = chord_groups(valve);
  info.size = size_of(valve);
  info.load_case = valve.load();
  info.measures = valve.measure();
  return info;
}

Json part_rows(const std::vector<mvs_part> &all, const std::vector<size_t> &count,
               const char *counted) {
  Json rows = Json::array();
  for (size_t i = 0; i < all.size(); ++i) {
    rows.push_back({{"id", all[i].id}, {"name", all[i].name}, {counted, count[i]}});
  }
  return rows;
}

Json chord_rows(const std::map<uint32_t, ChordGroup> &groups) {
  Json rows = Json::array();
  for (const auto &[kind, group] : groups) {
    rows.push_back({{"kind", chord_kind_name(kind)},
                    {"count", group.count},
                    {"rest_length_min_mm", group.shortest * 1e3},
                    {"rest_length_max_mm", group.longest * 1e3}});
  }
  return rows;
}

Json valve_json(const std::string &file, const mvs::Snapshot &valve, const Info &info) {
  return {{"file", file},
          {"name", valve.name()},
          {"units", {{"length", "mm"}, {"pressure", "mmHg"}}},
          {"vertices", info.size.vertices},
          {"branch_points", info.size.branches},
          {"faces", info.size.faces},
          {"chords", info.size.chords},
          {"annulus_nodes", info.size.annulus},
          {"leaflets", part_rows(info.leaflets, info.leaflet_faces, "faces")},
          {"tissue", tissue_rows(valve)},
          {"scallops", part_rows(info.scallops, info.scallop_faces, "faces")},
          {"heads", part_rows(info.heads, info.head_chords, "chords")},
          {"chord_kinds", chord_rows(info.chords)},
          {"annulus_ap_mm", info.measures.annulus_ap * 1e3},
          {"annulus_cc_mm", info.measures.annulus_cc * 1e3},
          {"leaflet_area_mm2", info.measures.leaflet_area * 1e6},
          {"pressure_mmHg", info.load_case.pressure / pa_per_mmhg},
          {"boundary_fraction", info.load_case.boundary_fraction},
          {"sound", true},
          {"intersections", info.measures.intersections},
          {"hash", hash_of(valve)}};
}

std::string parts_list(const std::vector<mvs_part> &all, const std::vector<size_t> &count,
                       const char *counted) {
  std::string out;
  for (size_t i = 0; i < all.size(); ++i) {
    out += text("%s%s (%zu %s)", i ? ", " : "", all[i].name, count[i], counted);
  }
  return out + "\n";
}

std::string chords_text(const Info &info) {
  std::string out = text("  Chordae          %zu segments, %zu branch points\n", info.size.chords,
                         info.size.branches);
  for (const auto &[kind, group] : info.chords) {
    out += text("    %-14s %4zu, rest length %.1f to %.1f mm\n", chord_kind_name(kind), group.count,
                group.shortest * 1e3, group.longest * 1e3);
  }
  return out;
}

// Loading refuses a file that is not a valve, so that only its shape remains to be checked.
std::string valve_text(const std::string &file, const mvs::Snapshot &valve, const Info &info) {
  const mvs_measures &m = info.measures;
  return text("%s: %s\n", file.c_str(), valve.name().c_str()) +
         text("  Sheet            %zu vertices, %zu triangles, %.0f mm2\n", info.size.vertices,
              info.size.faces, m.leaflet_area * 1e6) +
         "  Leaflets         " + parts_list(info.leaflets, info.leaflet_faces, "triangles") +
         tissue_text(tissue_rows(valve)) + "  Scallops         " +
         parts_list(info.scallops, info.scallop_faces, "triangles") +
         text("  Annulus          %zu nodes, AP %.1f mm, CC %.1f mm\n", info.size.annulus,
              m.annulus_ap * 1e3, m.annulus_cc * 1e3) +
         "  Papillary heads  " + parts_list(info.heads, info.head_chords, "chordae") +
         chords_text(info) +
         text("  Load             %g mmHg, annulus and heads %g %% of the way to systole\n",
              info.load_case.pressure / pa_per_mmhg, 100 * info.load_case.boundary_fraction) +
         text("  Checks           every part sound, %u pairs of triangles intersect",
              m.intersections);
}

void run_info(const InfoOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  const Info info = gather(valve);
  print(console, valve_json(options.file, valve, info), valve_text(options.file, valve, info));
}

}  // namespace

void add_info(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<InfoOptions>(
      app, console, "info", "list the parts of a valve and their sizes", run_info);
  command->add_option("file", options->file, "valve to describe, .obj, .h5 or .inp")->required();
}

}  // namespace cli
