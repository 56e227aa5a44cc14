// Golden digests: runs fixed scenes through the C interface and compares the bits of their results
// with a checked-in table.
//
//   golden TABLE [SCENE ...]     compares; exit code 1 and one line for each digest that differs
//   golden --write TABLE         writes the table anew
//   golden --hash [SCENE ...]    prints the snapshot hash of each scene, to compare two builds
//   golden --workers N ...       the same with N worker threads, which change no bit; with the
//                                environment variable MVS_WORKERS_LEAST_US=0 they share all loops
//
// A digest covers the bits of one array, not the snapshot hash, so that renaming a field or
// reordering the hash leaves it unchanged. The digests are the same for every compiler,
// optimisation level and vector extension (scripts/test --long golden checks that).
#include <mvs/experimental.h>
#include <mvs/mvs.h>

#include <cinttypes>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/golden/scenes.h"

namespace {

// FNV-1a, 64 bits (Fowler, Noll, Vo): enough to see that bits differ.
std::string digest(const void *data, size_t size) {
  const auto *bytes = static_cast<const unsigned char *>(data);
  uint64_t hash = 0xcbf29ce484222325;
  for (size_t k = 0; k < size; ++k) hash = (hash ^ bytes[k]) * 0x100000001b3;
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, hash);
  return text;
}

std::string digest_of_array(const mvs_snapshot *snapshot, uint32_t which) {
  mvs_view view;
  golden::check(mvs_snapshot_get_array(snapshot, which, &view));
  const size_t width = view.type == MVS_TYPE_F64 ? 8 : 4;
  return digest(view.data, view.count * view.components * width);
}

// Digest of the figures up to at_rest; figures added later are not pinned.
std::string digest_of_measures(const mvs_snapshot *snapshot) {
  constexpr size_t figures = offsetof(mvs_measures, at_rest);
  mvs_measures m = {};
  m.struct_size = figures;
  golden::check(mvs_snapshot_measure(snapshot, &m));
  m.struct_size = 0;
  return digest(&m, figures);
}

using Row = std::vector<std::string>;  // digests in the order of `columns`
const std::vector<std::string> columns = {"position", "velocity", "force",   "stress",
                                          "contact",  "tension",  "measures"};

Row row_of(const mvs_snapshot *snapshot) {
  return {digest_of_array(snapshot, MVS_ARRAY_NODE_POSITION),
          digest_of_array(snapshot, MVS_ARRAY_NODE_VELOCITY),
          digest_of_array(snapshot, MVS_ARRAY_NODE_FORCE),
          digest_of_array(snapshot, MVS_ARRAY_TRIANGLE_STRESS),
          digest_of_array(snapshot, MVS_ARRAY_NODE_CONTACT_FORCE),
          digest_of_array(snapshot, MVS_ARRAY_CHORD_TENSION),
          digest_of_measures(snapshot)};
}

using Table = std::map<std::string, Row>;

Table read_table(const std::string &path) {
  Table table;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string scene, cell;
    std::getline(cells, scene, ',');
    while (std::getline(cells, cell, ',')) table[scene].push_back(cell);
  }
  return table;
}

void write_table(const std::string &path, const std::vector<std::pair<std::string, Row>> &rows) {
  std::ofstream file(path);
  file << "scene";
  for (const std::string &column : columns) file << ',' << column;
  file << '\n';
  for (const auto &[scene, row] : rows) {
    file << scene;
    for (const std::string &cell : row) file << ',' << cell;
    file << '\n';
  }
}

// Prints the digests that differ; returns how many.
int compare(const std::string &scene, const Row &found, const Table &expected) {
  const auto at = expected.find(scene);
  if (at == expected.end() || at->second.size() != columns.size()) {
    std::printf("%s: the table has no row for this scene\n", scene.c_str());
    return 1;
  }
  int differing = 0;
  for (size_t k = 0; k < columns.size(); ++k) {
    if (found[k] == at->second[k]) continue;
    std::printf("%s: %s is %s, expected %s\n", scene.c_str(), columns[k].c_str(), found[k].c_str(),
                at->second[k].c_str());
    ++differing;
  }
  return differing;
}

bool is_asked_for(const std::string &scene, const std::vector<std::string> &prefixes) {
  for (const std::string &prefix : prefixes) {
    if (scene.rfind(prefix, 0) == 0) return true;
  }
  return prefixes.empty();
}

// Prints the snapshot hash of each scene.
void print_hashes(const std::vector<std::string> &prefixes) {
  for (const golden::Group &group : golden::groups()) {
    if (!is_asked_for(group.name, prefixes)) continue;
    group.run([](const std::string &scene, const mvs_snapshot *snapshot) {
      uint64_t hash[2];
      golden::check(mvs_snapshot_get_hash(snapshot, hash));
      std::printf("%016" PRIx64 "%016" PRIx64 " %s\n", hash[0], hash[1], scene.c_str());
    });
  }
}

}  // namespace

int main(int argc, char **argv) {
  std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() > 2 && arguments[0] == "--workers") {
    golden::use_workers(static_cast<uint32_t>(std::strtoul(arguments[1].c_str(), nullptr, 10)));
    arguments.erase(arguments.begin(), arguments.begin() + 2);
  }
  const bool writes = arguments.size() == 2 && arguments[0] == "--write";
  if (arguments.empty() || (arguments[0] == "--write" && !writes)) {
    std::fprintf(
        stderr,
        "usage: golden [--workers N] TABLE [SCENE ...] | --write TABLE | --hash [SCENE ...]\n");
    return 2;
  }
  if (arguments[0] == "--hash") {
    print_hashes({arguments.begin() + 1, arguments.end()});
    return 0;
  }
  const std::string path = writes ? arguments[1] : arguments[0];
  const std::vector<std::string> prefixes(arguments.begin() + (writes ? 2 : 1), arguments.end());
  const Table expected = writes ? Table{} : read_table(path);
  std::vector<std::pair<std::string, Row>> rows;
  int differing = 0;
  for (const golden::Group &group : golden::groups()) {
    if (!is_asked_for(group.name, prefixes)) continue;
    group.run([&](const std::string &scene, const mvs_snapshot *snapshot) {
      const Row row = row_of(snapshot);
      if (!writes) differing += compare(scene, row, expected);
      rows.emplace_back(scene, row);
    });
  }
  if (writes) write_table(path, rows);
  if (!writes && prefixes.empty() && rows.size() != expected.size()) {
    std::printf("%zu scenes ran, the table has %zu\n", rows.size(), expected.size());
    ++differing;
  }
  std::printf("%zu scenes, %zu digests, %d differ\n", rows.size(), rows.size() * columns.size(),
              differing);
  return differing == 0 && !rows.empty() ? 0 : 1;
}
