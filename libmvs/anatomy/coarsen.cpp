// Coarsening of a sheet by greedy vertex removal. After Yuksel, Sample Elimination for Generating
// Poisson Disk Sample Sets, Computer Graphics Forum 34 (2015): the most crowded vertex is removed
// and its neighbours are weighed anew; here the neighbours are those over the edges of a sheet.
#include "anatomy/coarsen.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <queue>

#include "anatomy/coarse_chordae.h"
#include "anatomy/coarse_tissue.h"
#include "anatomy/live_sheet.h"
#include "base/error.h"
#include "geometry/distance.h"
#include "model/valve_arrays.h"

namespace mvs::core {
namespace {

// Weight factor of a vertex with chordae: the sixth power of distance makes it a factor of 1.41 in
// distance.
constexpr double chord_share = 1.0 / 8;
// Deviation of a boundary vertex from the straight line between its neighbours, as a share of that
// line, that halves its weight.
constexpr double corner_share = 0.05;

// Contribution of a neighbour at this squared distance to the weight of a vertex.
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

  // Removes vertices until `wanted` are removed or no more can be; returns their number.
  size_t remove_vertices(size_t wanted) {
    size_t gone = 0;
    for (size_t before = none; gone < wanted && gone != before;) {
      before = gone;
      weigh_all();  // again: earlier removals may permit further ones
      while (gone < wanted && !queue_.empty()) gone += remove_next();
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

  // Sets `to` to the targets of a collapse: neighbours along the line for a boundary vertex, all
  // neighbours for an inner one. A vertex with chordae moves only to one with chordae, and never
  // from inside to the annulus.
  void find_targets(uint32_t vertex, const LiveSheet::Ring &ring, std::vector<uint32_t> &to) const {
    const bool inside = ring.along_lines.empty();
    to = inside ? ring.all : ring.along_lines;
    if (!inside && to.size() != 2) to.clear();
    if (chordae_.end_at(vertex)) {
      std::erase_if(to, [&](uint32_t n) { return !chordae_.end_at(n) || (inside && held_[n]); });
    }
  }

  void weigh(uint32_t vertex) {
    const uint32_t stamp = ++stamp_[vertex];
    if (chordae_.sewn(vertex)) return;
    sheet_.find_ring(vertex, ring_);
    find_targets(vertex, ring_, targets_);
    if (targets_.empty()) return;
    const std::vector<uint32_t> &along = ring_.along_lines;
    double weight = along.empty() ? weight_inside(vertex, targets_) : weight_on_line(vertex, along);
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

  // Weight by the length of the side that the line gets without the vertex, which keeps sides
  // short. Equal to the weight inside where six neighbours are half as far away; small at a corner
  // of the line.
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

  bool remove_next() {
    const Crowded next = queue_.top();
    queue_.pop();
    if (stamp_[next.vertex] != next.stamp) return false;
    sheet_.find_ring(next.vertex, ring_);
    const uint32_t to = best_target(next.vertex, ring_);
    if (to == none) return false;
    ++stamp_[next.vertex];
    chordae_.move(next.vertex, to);
    sheet_.collapse(next.vertex, to);
    sheet_.flip_around(to);
    sheet_.find_ring(to, ring_after_);
    changed_.clear();
    std::set_union(ring_.all.begin(), ring_.all.end(), ring_after_.all.begin(),
                   ring_after_.all.end(), std::back_inserter(changed_));
    for (const uint32_t vertex : changed_) weigh(vertex);
    return true;
  }

  // Returns the best target: the nearest one for a vertex with chordae; otherwise the one with the
  // best combination of triangle quality and distance to the old vertex; `none` if no collapse is
  // allowed.
  uint32_t best_target(uint32_t vertex, const LiveSheet::Ring &ring) {
    const bool chordae = chordae_.end_at(vertex);
    uint32_t best = none;
    double best_score = -INFINITY;
    find_targets(vertex, ring, targets_);
    for (const uint32_t to : targets_) {
      if (chordae && !chordae_.may_move(vertex, to)) continue;
      const double quality = sheet_.collapse_quality(vertex, ring, to);
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

  // Distance of a vertex from the triangles that replace it.
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
  std::vector<uint32_t> stamp_;  // identifies the latest queue entry of a vertex
  const std::vector<uint8_t> &held_;
  // work of weigh() and remove_next()
  LiveSheet::Ring ring_, ring_after_;
  std::vector<uint32_t> targets_, changed_;
};

// Marks the removed vertices.
std::vector<uint8_t> removed_nodes(const Model &model, const LiveSheet &sheet) {
  std::vector<uint8_t> removed(model.node_count(), 0);
  for (uint32_t n = 0; n < model.node_count(); ++n) {
    removed[n] = !model.topology.node_triangles[n].empty() && sheet.star(n).empty();
  }
  return removed;
}

// The remaining valve; its triangles have the tissue of the fine triangles they came from.
Valve remaining_valve(const Model &model, const Coarsener &work,
                      const std::vector<uint8_t> &removed) {
  std::vector<uint8_t> removed_triangles;
  for (const Tri &triangle : work.sheet().triangles()) {
    removed_triangles.push_back(LiveSheet::is_gone(triangle));
  }
  Valve valve = model.valve;
  valve.triangles = work.sheet().triangles();
  remove_triangles(valve, removed_triangles);
  valve.chords = work.chordae().left();
  std::erase_if(valve.annulus.edit(), [&](uint32_t node) { return removed[node] != 0; });
  remove_nodes(valve, removed);
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
  // a vertex of a regular sheet has an area of sqrt(3)/2 edge^2; one of a boundary has half
  const double area = std::accumulate(model.rest_area.begin(), model.rest_area.end(), 0.0);
  double boundary = 0;
  for (size_t e = 0; e < model.topology.edges.size(); ++e) {
    if (model.topology.edge_triangles[e][1] == none) boundary += model.rest_length[e];
  }
  const double inside = area / (std::sqrt(0.75) * edge * edge), half = 0.5 * boundary / edge;
  return static_cast<size_t>(std::lround(std::min(inside + half, 1e9)));
}

Coarsened coarsen(const Model &model, size_t vertices, std::vector<ChordStep> *steps) {
  const size_t before = sheet_vertices(model);
  MVS_MUST(vertices <= before, MVS_E_ARGUMENT, "vertices",
           "coarsen: the leaflets have %zu vertices, %zu were asked for: refine for more of them",
           before, vertices);
  Coarsener work(model);
  const size_t left = before - work.remove_vertices(before - vertices);
  MVS_MUST(left == vertices, MVS_E_ARGUMENT, "vertices",
           "coarsen: %zu vertices are too few for this valve, it needs %zu for its annulus, free "
           "edge, borders, chordae and triangles in shape: ask for at least as many",
           vertices, left);
  const std::vector<uint8_t> removed = removed_nodes(model, work.sheet());
  std::vector<uint32_t> nodes;
  for (uint32_t n = 0; n < removed.size(); ++n) {
    if (!removed[n]) nodes.push_back(n);
  }
  Valve valve = remaining_valve(model, work, removed);
  Coarsened made;
  made.model = make_model(valve, &model);
  made.map = make_level_map(*made.model, model, std::move(nodes));
  average_tissue(model, made.map, *made.model, valve);
  made.model = make_model(std::move(valve), &model);
  made.report = report_of(model, made, work);
  if (steps) *steps = work.chordae().steps();
  return made;
}

}  // namespace mvs::core
