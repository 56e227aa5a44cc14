// Rows of places by interpolated arc length, nearest free vertices, trees of neighbours.
#include "patient/chordae/chord_places.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

// The pattern of the healthy parametric valve (anatomy/PARAMETRIC.md): shares of all leaves, shares
// of the way from annulus to free edge.
constexpr double basal_part = 0.13, rough_part = 0.29, strut_part = 0.105;
constexpr double rough_v = 0.75, strut_v = 0.5, belly_v = 0.25, basal_v = 0.35;
// Struts end at this share of the way from A point to commissure, basal chordae begin at this share
// from commissure to P point. Leaves within this share of a row from the commissure are its fan.
constexpr double strut_end = 0.7, basal_begin = 0.15, fan_share = 0.08;
constexpr uint32_t least_leaves = 8;  // of a half
constexpr size_t most_leaves = 3, most_strut_leaves = 4;

// Arc length of the free edge from the A point, over the foot: half of the edge for each muscle.
class EdgeLength {
 public:
  EdgeLength(const PatientGeometry &g) : loop_(g.coordinates.annulus_length) {
    const std::vector<uint32_t> &edge = g.rims.free_edge;
    const std::vector<double> &foot = g.coordinates.foot;
    const size_t n = edge.size();
    MVS_MUST(n >= 3, MVS_E_OP, "free edge", "the free edge has %zu vertices", n);
    double turn = 0;
    for (size_t k = 0; k < n; ++k) turn += around(foot[edge[k]], foot[edge[(k + 1) % n]], loop_);
    const bool forward = turn > 0;
    // feet along the edge, without those that go back
    double s = 0, t = foot[edge[0]], most = t;
    for (size_t k = 0; k <= n; ++k) {
      const uint32_t here = edge[forward ? k % n : (n - k) % n];
      if (k > 0) {
        const uint32_t last = edge[forward ? (k - 1) % n : (n - k + 1) % n];
        s += (g.sheet.x[here] - g.sheet.x[last]).norm();
        t += around(foot[last], foot[here], loop_);
      }
      most = std::max(most, t);
      foot_.push_back(most);
      length_.push_back(s);
    }
    MVS_MUST(std::abs(t - foot_[0] - loop_) < 1e-6 * loop_, MVS_E_OP, "free edge",
             "the free edge does not go around the annulus once: give the leaflets as one sheet "
             "between annulus and free edge");
    foot_.back() = foot_[0] + loop_;
    origin_ = at(0.5 * (g.arcs.from + g.arcs.to));
  }

  // m along the free edge from the A point to a foot, on the side of that muscle.
  double from_a(double foot, bool medial) const {
    const double s = at(foot) - origin_, total = length_.back();
    return medial ? wrapped(-s, total) : wrapped(s, total);
  }

 private:
  double at(double foot) const {
    const double f = foot_[0] + wrapped(foot - foot_[0], loop_);
    const auto above = std::upper_bound(foot_.begin() + 1, foot_.end() - 1, f);
    const size_t k = static_cast<size_t>(above - foot_.begin()) - 1;
    const double step = foot_[k + 1] - foot_[k];
    const double share = step > 0 ? std::clamp((f - foot_[k]) / step, 0.0, 1.0) : 0;
    return length_[k] + share * (length_[k + 1] - length_[k]);
  }

  double loop_, origin_ = 0;
  std::vector<double> foot_, length_;
};

struct Row {
  ChordKind kind;
  double v;         // share of the way from annulus to free edge
  double from, to;  // m along the annulus from the A point
  uint32_t count;
};

struct Spot {
  ChordKind kind;
  double r, v;  // m along the row from the A point; share
};

// One half of the sheet, from the A point over a commissure to the P point.
class Half {
 public:
  Half(const PatientGeometry &g, const EdgeLength &edge, bool medial)
      : g_(g), edge_(edge), medial_(medial), a_(0.5 * (g.arcs.from + g.arcs.to)) {}

  double commissure() const { return 0.5 * (g_.arcs.to - g_.arcs.from); }
  double end() const { return 0.5 * g_.coordinates.annulus_length; }
  bool contains(uint32_t vertex) const { return (offset(vertex) < 0) == medial_; }
  bool is_anterior(uint32_t vertex) const { return std::abs(offset(vertex)) < commissure(); }
  // m along a row from the A point: lengths of rows go evenly from that of the annulus to that of
  // the free edge.
  double along(double w, double v) const {
    const double foot = a_ + (medial_ ? -w : w);
    return (1 - v) * w + v * (w > 0 ? edge_.from_a(foot, medial_) : 0);
  }
  double along(uint32_t vertex, double v) const { return along(std::abs(offset(vertex)), v); }

 private:
  double offset(uint32_t vertex) const {
    return around(a_, g_.coordinates.foot[vertex], g_.coordinates.annulus_length);
  }

  const PatientGeometry &g_;
  const EdgeLength &edge_;
  bool medial_;
  double a_;
};

std::vector<Row> chord_rows(const Half &half, uint32_t leaves) {
  const auto part = [&](double share) {
    return std::max(1u, static_cast<uint32_t>(std::floor(share * leaves + 0.5)));
  };
  const uint32_t basal = part(basal_part), rough = part(rough_part), struts = part(strut_part);
  const uint32_t others = basal + rough + 2 * struts;
  const double c = half.commissure(), end = half.end();
  return {{ChordKind::marginal, 1, 0, end, std::max(leaves, others + 1) - others},
          {ChordKind::rough_zone, rough_v, 0, end, rough},
          {ChordKind::strut, strut_v, 0, strut_end * c, struts},
          {ChordKind::strut, belly_v, 0, strut_end * c, struts},
          {ChordKind::basal, basal_v, c + basal_begin * (end - c), end, basal}};
}

std::vector<Spot> spots_of(const Half &half, const Row &row) {
  const double from = half.along(row.from, row.v), to = half.along(row.to, row.v);
  const double fan = fan_share * half.along(half.end(), row.v);
  const double commissure = half.along(half.commissure(), row.v);
  std::vector<Spot> spots;
  for (uint32_t i = 0; i < row.count; ++i) {
    const double r = from + (i + 0.5) / row.count * (to - from);
    const bool in_fan = (row.kind == ChordKind::marginal || row.kind == ChordKind::rough_zone) &&
                        std::abs(r - commissure) < fan;
    spots.push_back({in_fan ? ChordKind::commissural : row.kind, r, row.v});
  }
  return spots;
}

// Runs of one kind, divided into trees of about equal size: lists of indices of spots.
std::vector<std::vector<size_t>> divide(const std::vector<Spot> &spots) {
  std::vector<std::vector<size_t>> trees;
  for (size_t first = 0; first < spots.size();) {
    size_t last = first + 1;
    while (last < spots.size() && spots[last].kind == spots[first].kind) ++last;
    const size_t most = spots[first].kind == ChordKind::strut ? most_strut_leaves : most_leaves;
    const size_t size = last - first, count = (size + most - 1) / most;
    for (size_t i = 0; i < count; ++i) {
      trees.emplace_back();
      for (size_t k = i * size / count; k < (i + 1) * size / count; ++k) {
        trees.back().push_back(first + k);
      }
    }
    first = last;
  }
  return trees;
}

size_t count_segments(const Half &half, uint32_t leaves) {
  size_t count = 0;
  for (const Row &row : chord_rows(half, leaves)) {
    for (const std::vector<size_t> &tree : divide(spots_of(half, row))) {
      count += tree.size() + (tree.size() > 1 ? 1 : 0);
    }
  }
  return count;
}

// Marginal chordae that a half has vertices for: two of three along its free edge.
uint32_t room_of(const PatientGeometry &g, const Half &half) {
  const auto count = std::count_if(g.rims.free_edge.begin(), g.rims.free_edge.end(),
                                   [&](uint32_t i) { return half.contains(i); });
  return static_cast<uint32_t>(2 * count / 3);
}

// Gives each place the nearest vertex of its half that is free, in coordinates along the sheet.
class FreeVertices {
 public:
  explicit FreeVertices(const PatientGeometry &g)
      : g_(g),
        on_edge_(marks_of(g.rims.free_edge, g.sheet.x.size())),
        taken_(marks_of(g.rims.annulus, g.sheet.x.size())) {}

  uint32_t take(const Half &half, const Spot &spot, const Row &row) {
    const SheetCoordinates &c = g_.coordinates;
    uint32_t best = none;
    double best_distance = 0;
    for (uint32_t i = 0; i < taken_.size(); ++i) {
      if (taken_[i] || on_edge_[i] != (row.v == 1) || !half.contains(i)) continue;
      if (row.kind == ChordKind::strut && !half.is_anterior(i)) continue;
      if (row.kind == ChordKind::basal && half.is_anterior(i)) continue;
      const double along = half.along(i, row.v) - spot.r;
      const double across = (c.share[i] - row.v) * c.whole[i];
      const double distance = along * along + across * across;
      if (best != none && distance >= best_distance) continue;
      best = i;
      best_distance = distance;
    }
    MVS_MUST(best != none, MVS_E_OP, "chords",
             "the sheet of %zu vertices has too few %s for its chordae: ask for fewer chords or "
             "shorter edges",
             taken_.size(), row.v == 1 ? "vertices along the free edge" : "vertices inside");
    taken_[best] = 1;
    return best;
  }

 private:
  const PatientGeometry &g_;
  std::vector<uint8_t> on_edge_, taken_;
};

std::vector<ChordTree> plan_half(const Half &half, uint32_t leaves, FreeVertices &vertices) {
  std::vector<ChordTree> trees;
  for (const Row &row : chord_rows(half, leaves)) {
    const std::vector<Spot> spots = spots_of(half, row);
    for (const std::vector<size_t> &tree : divide(spots)) {
      trees.push_back({spots[tree.front()].kind, {}});
      for (const size_t k : tree) {
        trees.back().leaves.push_back(vertices.take(half, spots[k], row));
      }
    }
  }
  return trees;
}

}  // namespace

ChordPlan plan_chords(const PatientGeometry &g, uint32_t segments) {
  MVS_MUST(segments >= 20 && segments <= 400, MVS_E_ARGUMENT, "chords",
           "%u chord segments are asked for: the number has to be 20 to 400", segments);
  const EdgeLength edge(g);
  const Half lateral(g, edge, false), medial(g, edge, true);
  const uint32_t room = std::min(room_of(g, lateral), room_of(g, medial));
  // the largest number of leaves that fits
  uint32_t leaves = (segments + 1) / 2;
  const auto fits = [&] {
    return chord_rows(lateral, leaves).front().count <= room &&
           count_segments(lateral, leaves) + count_segments(medial, leaves) <= segments;
  };
  while (leaves > least_leaves && !fits()) --leaves;
  MVS_MUST(fits(), MVS_E_OP, "chords",
           "the free edge has room for %u marginal chordae in one half, at least %u are needed: "
           "ask for shorter edges",
           room, chord_rows(lateral, least_leaves).front().count);
  FreeVertices vertices(g);
  ChordPlan plan;
  plan.anterolateral = plan_half(lateral, leaves, vertices);
  plan.posteromedial = plan_half(medial, leaves, vertices);
  return plan;
}

}  // namespace mvs::core
