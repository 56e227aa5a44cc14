#include "valve/chords.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace cli {
namespace {

// Indexed by MVS_CHORD_KIND_*.
constexpr const char *kinds[] = {"other", "marginal",    "rough zone", "strut",
                                 "basal", "commissural", "trunk",      "suture"};

constexpr uint32_t unreached = std::numeric_limits<uint32_t>::max();

// Chord segments as a graph: heads are its roots, leaflet nodes its leaves.
class ChordTree {
 public:
  explicit ChordTree(const mvs::Snapshot &valve);

  // Names of the heads above a chord.
  std::string heads_of(size_t chord) const;
  // Names of the scallops below a chord.
  std::string sites_of(size_t chord) const;

 private:
  void add_heads(const mvs::Snapshot &valve);
  void add_scallops(const mvs::Snapshot &valve);
  bool is_sheet(uint32_t node) const;
  std::vector<bool> reached(size_t chord, bool up) const;
  std::string joined(const std::vector<bool> &nodes, const std::map<uint32_t, std::string> &names,
                     const std::vector<std::string> &order) const;

  mvs::View<uint32_t> ends_;
  mvs::View<uint8_t> kind_;
  std::vector<std::vector<uint32_t>> chords_;       // of each node
  std::vector<uint32_t> depth_;                     // segments from the nearest head to each node
  std::map<uint32_t, std::string> head_, scallop_;  // names, by node
  std::vector<std::string> head_names_, scallop_names_;
};

ChordTree::ChordTree(const mvs::Snapshot &valve)
    : ends_(valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES)),
      kind_(valve.view<uint8_t>(MVS_ARRAY_NODE_KIND)),
      chords_(kind_.rows()),
      depth_(kind_.rows(), unreached) {
  for (uint32_t c = 0; c < ends_.rows(); ++c) {
    for (const size_t side : {0, 1}) chords_[ends_.row(c)[side]].push_back(c);
  }
  add_heads(valve);
  add_scallops(valve);
}

bool ChordTree::is_sheet(uint32_t node) const {
  const uint8_t kind = *kind_.row(node);
  return kind == MVS_NODE_KIND_LEAFLET || kind == MVS_NODE_KIND_ANNULUS;
}

// Breadth-first search from all heads; it ends at the leaflets.
void ChordTree::add_heads(const mvs::Snapshot &valve) {
  const auto nodes = valve.view<uint32_t>(MVS_ARRAY_HEAD_NODES);
  std::vector<uint32_t> queue;
  for (const mvs_part &head : valve.parts(MVS_PART_HEAD)) {
    const uint32_t node = *nodes.row(head.index);
    head_names_.emplace_back(head.name);
    head_[node] = head.name;
    depth_[node] = 0;
    queue.push_back(node);
  }
  for (size_t k = 0; k < queue.size(); ++k) {
    if (is_sheet(queue[k])) continue;
    for (const uint32_t c : chords_[queue[k]]) {
      for (const size_t side : {0, 1}) {
        const uint32_t next = ends_.row(c)[side];
        if (depth_[next] != unreached) continue;
        depth_[next] = depth_[queue[k]] + 1;
        queue.push_back(next);
      }
    }
  }
}

// A node between scallops belongs to the one with most of its triangles, or the first of these.
void ChordTree::add_scallops(const mvs::Snapshot &valve) {
  for (const mvs_part &part : valve.parts(MVS_PART_SCALLOP)) scallop_names_.emplace_back(part.name);
  const auto triangles = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  const auto scallop = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_SCALLOP);
  std::map<uint32_t, std::vector<uint32_t>> votes;
  for (size_t t = 0; t < triangles.rows(); ++t) {
    for (size_t corner = 0; corner < 3; ++corner) {
      const uint32_t node = triangles.row(t)[corner];
      if (chords_[node].empty()) continue;
      std::vector<uint32_t> &of = votes[node];
      of.resize(scallop_names_.size());
      ++of[*scallop.row(t)];
    }
  }
  for (const auto &[node, of] : votes) {
    scallop_[node] = scallop_names_[std::max_element(of.begin(), of.end()) - of.begin()];
  }
}

// The nodes above or below a chord with its own end there: along segments that lead towards, or
// away from, the heads.
std::vector<bool> ChordTree::reached(size_t chord, bool up) const {
  const auto is_further = [&](uint32_t a, uint32_t b) {
    return up ? depth_[a] < depth_[b] : depth_[a] > depth_[b];
  };
  const uint32_t a = ends_.row(chord)[0], b = ends_.row(chord)[1];
  std::vector<bool> seen(depth_.size());
  std::vector<uint32_t> queue;
  if (!is_further(b, a)) queue.push_back(a);
  if (!is_further(a, b)) queue.push_back(b);
  for (size_t k = 0; k < queue.size(); ++k) {
    if (seen[queue[k]]) continue;
    seen[queue[k]] = true;
    if (is_sheet(queue[k])) continue;
    for (const uint32_t c : chords_[queue[k]]) {
      for (const size_t side : {0, 1}) {
        if (is_further(ends_.row(c)[side], queue[k])) queue.push_back(ends_.row(c)[side]);
      }
    }
  }
  return seen;
}

std::string ChordTree::joined(const std::vector<bool> &nodes,
                              const std::map<uint32_t, std::string> &names,
                              const std::vector<std::string> &order) const {
  std::vector<std::string> found;
  for (const auto &[node, name] : names) {
    if (nodes[node]) found.push_back(name);
  }
  std::string out;
  for (const std::string &name : order) {
    if (std::find(found.begin(), found.end(), name) == found.end()) continue;
    out += (out.empty() ? "" : "+") + name;
  }
  return out;
}

std::string ChordTree::heads_of(size_t chord) const {
  return joined(reached(chord, true), head_, head_names_);
}

std::string ChordTree::sites_of(size_t chord) const {
  return joined(reached(chord, false), scallop_, scallop_names_);
}

std::vector<std::string> flags_of(uint8_t bits, double tension) {
  std::vector<std::string> flags;
  if (bits & MVS_CHORD_FLAG_OVER_STRAIN) flags.emplace_back("over strain");
  if (bits & MVS_CHORD_FLAG_OVER_TENSION) flags.emplace_back("over tension");
  if (tension == 0) flags.emplace_back("slack");
  return flags;
}

// Compares numbers in names by their value: A2/7 before A2/17.
bool counts_before(const std::string &a, const std::string &b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
      continue;
    }
    const size_t i0 = std::min(a.find_first_not_of('0', i), a.size());
    const size_t k0 = std::min(b.find_first_not_of('0', k), b.size());
    for (i = i0; i < a.size() && is_digit(a[i]);) ++i;
    for (k = k0; k < b.size() && is_digit(b[k]);) ++k;
    if (i - i0 != k - k0) return i - i0 < k - k0;
    const int order = a.compare(i0, i - i0, b, k0, k - k0);
    if (order != 0) return order < 0;
  }
  return a.size() - i < b.size() - k;
}

}  // namespace

const char *chord_kind_name(uint32_t kind) {
  return kind < std::size(kinds) ? kinds[kind] : "unknown";
}

std::vector<ChordRow> chord_table(const mvs::Snapshot &valve) {
  const ChordTree tree(valve);
  const auto at = valve.view<double>(MVS_ARRAY_NODE_POSITION);
  const auto ends = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES);
  const auto kind = valve.view<uint32_t>(MVS_ARRAY_CHORD_KIND);
  const auto rest = valve.view<double>(MVS_ARRAY_CHORD_REST_LENGTH);
  const auto strain = valve.view<double>(MVS_ARRAY_CHORD_STRAIN);
  const auto tension = valve.view<double>(MVS_ARRAY_CHORD_TENSION);
  const auto bits = valve.view<uint8_t>(MVS_ARRAY_CHORD_FLAGS);
  std::vector<ChordRow> rows;
  for (const mvs_part &chord : valve.parts(MVS_PART_CHORD)) {
    const size_t c = chord.index;
    const double *const a = at.row(ends.row(c)[0]), *const b = at.row(ends.row(c)[1]);
    rows.push_back({chord.name, chord_kind_name(*kind.row(c)), tree.heads_of(c), tree.sites_of(c),
                    std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), *rest.row(c), *strain.row(c),
                    *tension.row(c), flags_of(*bits.row(c), *tension.row(c))});
  }
  return rows;
}

std::vector<std::string> chord_orders() {
  return {"tension", "strain", "name", "length"};
}

void sort_chords(std::vector<ChordRow> &rows, const std::string &order) {
  const auto sort_by = [&rows](auto before) { std::stable_sort(rows.begin(), rows.end(), before); };
  using Row = const ChordRow &;
  if (order == "tension") sort_by([](Row a, Row b) { return a.tension > b.tension; });
  if (order == "strain") sort_by([](Row a, Row b) { return a.strain > b.strain; });
  if (order == "name") sort_by([](Row a, Row b) { return counts_before(a.name, b.name); });
  if (order == "length") sort_by([](Row a, Row b) { return a.length > b.length; });
}

}  // namespace cli
