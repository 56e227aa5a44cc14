// Which vertex goes next, and where to. After Yuksel, Sample Elimination for Generating Poisson
// Disk Sample Sets, Computer Graphics Forum 34 (2015): the one with the nearest neighbours, those
// around are weighed anew, and so on; here on a sheet, with neighbours over its edges.
#include "anatomy/coarsen.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "anatomy/coarse_chordae.h"
#include "anatomy/coarse_tissue.h"
#include "anatomy/live_sheet.h"
#include "base/error.h"
#include "geometry/distance.h"

namespace mvs::core {
namespace {

// A vertex with chordae goes when its neighbours are nearer than others' by this root of 8: 1.41.
constexpr double chord_share = 1.0 / 8;
// A vertex of a line this far off the way past it, as a share of that way, counts half.
constexpr double corner_share = 0.05;

// How crowded a vertex is with a neighbour at this distance, squared.
double crowded_by(double distance2) {
  return 1 / (distance2 * distance2 * distance2);
}

class Coarsener {
 public:
  explicit Coarsener(const Model &model)
      : model_(model),
        sheet_(model),
        chordae_(model),
        stamp_(model.node_count(), 0),
        held_(model.topology.fixed) {}

  // Takes vertices out until so many are gone; says how many went.
  size_t take_out(size_t wanted) {
    size_t gone = 0;
    for (size_t before = none; gone < wanted && gone != before;) {
      before = gone;
      weigh_all();  // again, since what was not possible may have become so
      while (gone < wanted && !queue_.empty()) gone += take_next();
    }
    return gone;
  }

  const LiveSheet &sheet() const { return sheet_; }
  const CoarseChordae &chordae() const { return chordae_; }

 private:
  struct Crowded {
    double weight;
    uint32_t vertex, stamp;
    bool operator<(const Crowded &other) const {
      return weight != other.weight ? weight < other.weight : vertex > other.vertex;
    }
  };

  // Where a vertex may go: along its line, or anywhere from inside; chordae only to other chordae,
  // and never from inside to the annulus.
  std::vector<uint32_t> ways(uint32_t vertex) const {
    std::vector<uint32_t> along = sheet_.along_lines(vertex);
    const bool inside = along.empty();
    if (inside) along = sheet_.neighbours(vertex);
    if (!inside && along.size() != 2) along.clear();
    if (chordae_.end_at(vertex)) {
      std::erase_if(along,
                    [&](uint32_t to) { return !chordae_.end_at(to) || (inside && held_[to]); });
    }
    return along;
  }

  void weigh(uint32_t vertex) {
    const uint32_t stamp = ++stamp_[vertex];
    const std::vector<uint32_t> around = ways(vertex);
    if (around.empty() || chordae_.sewn(vertex)) return;
    const std::vector<uint32_t> along = sheet_.along_lines(vertex);
    double weight = along.empty() ? weight_inside(vertex, around) : weight_on_line(vertex, along);
    if (chordae_.end_at(vertex)) weight *= chord_share;
    queue_.push({weight, vertex, stamp});
  }

  double weight_inside(uint32_t vertex, const std::vector<uint32_t> &around) const {
    double weight = 0;
    for (const uint32_t other : around) {
      weight += crowded_by((sheet_.at(other) - sheet_.at(vertex)).squaredNorm());
    }
    return weight;
  }

  // By the length of the side that a line gets without the vertex, so that none becomes too long.
  // As much as inside where six neighbours are half as far away; little at a corner of the line.
  double weight_on_line(uint32_t vertex, const std::vector<uint32_t> &along) const {
    const Vec3 &a = sheet_.at(along[0]), &b = sheet_.at(along[1]);
    const double length2 = (b - a).squaredNorm();
    const double off2 = closest_on_segment(sheet_.at(vertex), a, b).distance2;
    const double corner = off2 / (length2 * corner_share * corner_share);
    return 6 * crowded_by(length2 / 4) / (1 + corner);
  }

  void weigh_all() {
    for (uint32_t n = 0; n < model_.node_count(); ++n) {
      if (!sheet_.star(n).empty()) weigh(n);
    }
  }

  bool take_next() {
    const Crowded next = queue_.top();
    queue_.pop();
    if (stamp_[next.vertex] != next.stamp) return false;
    const uint32_t to = best_way(next.vertex);
    if (to == none) return false;
    std::vector<uint32_t> around = sheet_.neighbours(next.vertex);
    ++stamp_[next.vertex];
    chordae_.move(next.vertex, to);
    sheet_.collapse(next.vertex, to);
    sheet_.flip_around(to);
    const std::vector<uint32_t> now = sheet_.neighbours(to);
    around.insert(around.end(), now.begin(), now.end());
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    for (const uint32_t vertex : around) weigh(vertex);
    return true;
  }

  // Chordae go the shortest way, other vertices where the triangles are best and the sheet is
  // nearest to where they were.
  uint32_t best_way(uint32_t vertex) const {
    const bool chordae = chordae_.end_at(vertex);
    uint32_t best = none;
    double best_score = -INFINITY;
    for (const uint32_t to : ways(vertex)) {
      if (chordae && !chordae_.may_move(vertex, to)) continue;
      const double quality = sheet_.collapse_quality(vertex, to);
      if (quality < 0) continue;
      const double length = (sheet_.at(vertex) - sheet_.at(to)).norm();
      const double score = chordae ? -length : quality - distance_after(vertex, to) / length;
      if (score > best_score) {
        best = to;
        best_score = score;
      }
    }
    return best;
  }

  // How far a vertex would lie from the triangles that take its place.
  double distance_after(uint32_t vertex, uint32_t to) const {
    double distance2 = (sheet_.at(vertex) - sheet_.at(to)).squaredNorm();
    for (const uint32_t t : sheet_.star(vertex)) {
      std::array<Vec3, 3> corner;
      for (int k = 0; k < 3; ++k) {
        const uint32_t node = sheet_.triangle(t)[k];
        corner[k] = sheet_.at(node == vertex ? to : node);
      }
      const auto foot = closest_on_triangle(sheet_.at(vertex), corner[0], corner[1], corner[2]);
      distance2 = std::min(distance2, foot.distance2);
    }
    return std::sqrt(distance2);
  }

  const Model &model_;
  LiveSheet sheet_;
  CoarseChordae chordae_;
  std::priority_queue<Crowded> queue_;
  std::vector<uint32_t> stamp_;  // tells which entry of the queue is the last one
  const std::vector<uint8_t> &held_;
};

size_t sheet_vertices(const Model &model) {
  size_t count = 0;
  for (uint32_t n = 0; n < model.node_count(); ++n) {
    count += !model.topology.node_triangles[n].empty();
  }
  return count;
}

// The nodes that stay, in order.
std::vector<uint32_t> nodes_left(const Model &model, const LiveSheet &sheet) {
  std::vector<uint32_t> left;
  for (uint32_t n = 0; n < model.node_count(); ++n) {
    if (model.topology.node_triangles[n].empty() || !sheet.star(n).empty()) left.push_back(n);
  }
  return left;
}

template <typename T>
CowVector<T> rows(const CowVector<T> &all, const std::vector<uint32_t> &which) {
  std::vector<T> some;
  some.reserve(which.size());
  for (const uint32_t k : which) some.push_back(all[k]);
  return some;
}

// The valve that is left; its triangles have the tissue of the fine triangles they came from.
Valve valve_left(const Model &model, const Coarsener &work, const std::vector<uint32_t> &nodes) {
  const Valve &fine = model.valve;
  std::vector<uint32_t> number(model.node_count(), none), triangles;
  for (uint32_t k = 0; k < nodes.size(); ++k) number[nodes[k]] = k;
  for (uint32_t t = 0; t < fine.triangles.size(); ++t) {
    if (!LiveSheet::is_gone(work.sheet().triangle(t))) triangles.push_back(t);
  }
  Valve valve = fine;
  for (CowVector<Vec3> *places : {&valve.rest, &valve.open, &valve.loaded}) {
    *places = rows(*places, nodes);
  }
  valve.origin = rows(fine.origin, nodes);
  valve.triangles = rows(CowVector<Tri>(work.sheet().triangles()), triangles);
  valve.triangle_leaflet = rows(fine.triangle_leaflet, triangles);
  valve.triangle_scallop = rows(fine.triangle_scallop, triangles);
  valve.triangle_thickness = rows(fine.triangle_thickness, triangles);
  valve.triangle_fibre = rows(fine.triangle_fibre, triangles);
  valve.chords = work.chordae().left();
  std::erase_if(valve.annulus.edit(), [&](uint32_t node) { return number[node] == none; });
  for (Tri &triangle : valve.triangles) {
    for (uint32_t &node : triangle) node = number[node];
  }
  for (uint32_t &node : valve.annulus) node = number[node];
  for (Head &head : valve.heads) head.node = number[head.node];
  for (Chord &chord : valve.chords) {
    chord.a = number[chord.a];
    chord.b = number[chord.b];
  }
  return valve;
}

CoarseningReport report_of(const Model &fine, const Coarsened &made, const Coarsener &work) {
  CoarseningReport report;
  report.vertices_before = sheet_vertices(fine);
  report.vertices = sheet_vertices(*made.model);
  report.chords_moved = work.chordae().moved();
  report.chords_merged = work.chordae().merged();
  report.chord_move = work.chordae().largest_move();
  double squares = 0;
  for (uint32_t n = 0; n < fine.node_count(); ++n) {
    const double distance = distance_from(*made.model, made.map.place[n], fine.valve.rest[n]);
    report.surface_max = std::max(report.surface_max, distance);
    squares += distance * distance;
  }
  report.surface_rms = std::sqrt(squares / static_cast<double>(report.vertices_before));
  for (const Tri &triangle : work.sheet().triangles()) {
    if (LiveSheet::is_gone(triangle)) continue;
    report.worst_quality = std::min(report.worst_quality, work.sheet().quality(triangle));
  }
  return report;
}

}  // namespace

size_t vertices_for_edge(const Model &model, double edge) {
  // a vertex of a regular sheet has sqrt(3)/2 edge^2; those of a boundary have half of it
  const double area = std::accumulate(model.rest_area.begin(), model.rest_area.end(), 0.0);
  double boundary = 0;
  for (size_t e = 0; e < model.topology.edges.size(); ++e) {
    if (model.topology.edge_triangles[e][1] == none) boundary += model.rest_length[e];
  }
  const double inside = area / (std::sqrt(0.75) * edge * edge), half = 0.5 * boundary / edge;
  return static_cast<size_t>(std::lround(std::min(inside + half, 1e9)));
}

Coarsened coarsen(const Model &model, size_t vertices) {
  const size_t before = sheet_vertices(model);
  MVS_MUST(vertices <= before, MVS_E_ARGUMENT, "vertices",
           "coarsen: the leaflets have %zu vertices, %zu were asked for: refine for more of them",
           before, vertices);
  Coarsener work(model);
  const size_t left = before - work.take_out(before - vertices);
  MVS_MUST(left == vertices, MVS_E_ARGUMENT, "vertices",
           "coarsen: %zu vertices are too few for this valve, it needs %zu for its annulus, free "
           "edge, borders, chordae and triangles in shape: ask for at least as many",
           vertices, left);
  std::vector<uint32_t> nodes = nodes_left(model, work.sheet());
  Valve valve = valve_left(model, work, nodes);
  Coarsened made;
  made.model = make_model(valve, &model);
  made.map = make_level_map(*made.model, model, std::move(nodes));
  average_tissue(model, made.map, *made.model, valve);
  made.model = make_model(std::move(valve), &model);
  made.report = report_of(model, made, work);
  return made;
}

}  // namespace mvs::core
