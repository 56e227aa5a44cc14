// Plans the attachments of the chordae of one papillary muscle: rows of equal arc length on the
// smooth surface, assigned to the nearest free mesh vertices, grouped into trees.
#include "anatomy/chordae.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace mvs::core {
namespace {

// Chordae within this share of a row from the commissure form its fan.
constexpr double commissural_share = 0.08;

struct Spot {
  Place place;
  ChordKind kind;
};

using Row = std::vector<Spot>;

// Returns `count` spots evenly along an arc of the curve v, half a gap from either end.
Row even_row(const ArcLength &arc, double v, uint32_t count, ChordKind kind) {
  Row row;
  for (uint32_t i = 0; i < count; ++i) {
    row.push_back({{arc.theta_at((i + 0.5) / count * arc.total()), v}, kind});
  }
  return row;
}

Row even_row(const Shape &shape, double v, double theta0, double theta1, uint32_t count,
             ChordKind kind) {
  return even_row(ArcLength(shape, v, theta0, theta1), v, count, kind);
}

// A row along the whole curve v; its spots near the commissure are commissural.
Row whole_row(const Shape &shape, double v, uint32_t count, ChordKind kind) {
  const ArcLength arc(shape, v, 0, pi);
  Row row = even_row(arc, v, count, kind);
  const double reach = commissural_share * arc.total();
  const Vec3 commissure = shape.open({Shape::commissure, v});
  for (Spot &spot : row) {
    // an arc is at least as long as its chord, up to rounding
    if ((shape.open(spot.place) - commissure).norm() > (1 + 1e-9) * reach) continue;
    const double from = std::min(spot.place.theta, Shape::commissure);
    const double to = std::max(spot.place.theta, Shape::commissure);
    if (ArcLength(shape, v, from, to).total() < reach) spot.kind = ChordKind::commissural;
  }
  return row;
}

// Returns the rows of one muscle of the founding shape, `count` spots in total: free edge, rough
// zone, strut, base.
std::vector<Row> founding_rows(const Shape &shape, uint32_t count) {
  const auto part = [&](double share) {
    return std::max(1u, static_cast<uint32_t>(std::lround(share * count)));
  };
  const uint32_t basal = part(0.15), rough = part(0.375);
  const uint32_t edge = count - basal - rough - 1;
  constexpr double rough_v = 0.75, strut_v = 0.38, basal_v = 0.35;
  return {whole_row(shape, 1, edge, ChordKind::marginal),
          whole_row(shape, rough_v, rough, ChordKind::rough_zone),
          {{{0.4 * Shape::commissure, strut_v}, ChordKind::strut}},
          even_row(shape, basal_v, 1.15 * Shape::commissure, pi, basal, ChordKind::basal)};
}

// The rows of the healthy shape: struts in two rows carry the belly of the anterior leaflet,
// without which it billows with any soft tissue.
std::vector<Row> healthy_rows(const Shape &shape, uint32_t count) {
  const auto part = [&](double share) {
    return std::max(1u, static_cast<uint32_t>(std::lround(share * count)));
  };
  const uint32_t basal = part(0.13), rough = part(0.29), struts = part(0.105);
  const uint32_t others = basal + rough + 2 * struts, edge = std::max(count, others + 1) - others;
  constexpr double rough_v = 0.75, strut_v = 0.5, belly_v = 0.25, basal_v = 0.35;
  constexpr double strut_end = 0.7 * Shape::commissure;
  return {whole_row(shape, 1, edge, ChordKind::marginal),
          whole_row(shape, rough_v, rough, ChordKind::rough_zone),
          even_row(shape, strut_v, 0, strut_end, struts, ChordKind::strut),
          even_row(shape, belly_v, 0, strut_end, struts, ChordKind::strut),
          even_row(shape, basal_v, 1.15 * Shape::commissure, pi, basal, ChordKind::basal)};
}

// Returns the rows of one muscle with `segments` chord segments. A tree of three branches has four;
// the strut of the founding shape is always plain.
std::vector<Row> plan_rows(const Shape &shape, const Dimensions &d, uint32_t segments) {
  if (d.shape == ParametricShape::healthy) {
    return healthy_rows(shape, d.branching ? (3 * segments + 2) / 4 : segments);
  }
  return founding_rows(shape, d.branching ? 1 + (3 * (segments - 1) + 2) / 4 : segments);
}

// Assigns spots to vertices, each vertex once.
class Snapper {
 public:
  Snapper(const Shape &shape, const HalfSheet &sheet)
      : shape_(shape), sheet_(sheet), taken_(sheet.x.size(), 0) {
    for (size_t i = 0; i < taken_.size(); ++i) {
      // vertices on the mirror plane belong to neither muscle; the annulus has no chordae
      taken_[i] = (sheet.sides[i] & (on_mirror | on_annulus)) != 0;
    }
  }

  uint32_t nearest_free(const Place &place) {
    const Vec3 at = shape_.open(place);
    uint32_t best = none;
    double best_distance = 0;
    for (uint32_t i = 0; i < sheet_.x.size(); ++i) {
      if (taken_[i]) continue;
      const double distance = (sheet_.x[i] - at).squaredNorm();
      if (best != none && distance >= best_distance) continue;
      best = i;
      best_distance = distance;
    }
    MVS_MUST(best != none, MVS_E_ARGUMENT, "chords",
             "parametric valve: the mesh has too few vertices for its chords, ask for more "
             "vertices or fewer chords");
    taken_[best] = 1;
    return best;
  }

 private:
  const Shape &shape_;
  const HalfSheet &sheet_;
  std::vector<uint8_t> taken_;
};

uint32_t nearest_tip(const std::vector<Vec3> &tips, const Vec3 &x) {
  const auto nearer = [&](const Vec3 &a, const Vec3 &b) {
    return (a - x).squaredNorm() < (b - x).squaredNorm();
  };
  return static_cast<uint32_t>(std::min_element(tips.begin(), tips.end(), nearer) - tips.begin());
}

// Divides a run of neighbours into trees of equal size, at most `most`.
void divide_into_trees(const Tree &run, size_t most, std::vector<Tree> &trees) {
  const size_t count = (run.size() + most - 1) / most;
  for (size_t i = 0; i < count; ++i) {
    trees.emplace_back(run.begin() + static_cast<std::ptrdiff_t>(i * run.size() / count),
                       run.begin() + static_cast<std::ptrdiff_t>((i + 1) * run.size() / count));
  }
}

}  // namespace

std::vector<Tree> plan_trees(const Shape &shape, const HalfSheet &sheet, const Dimensions &d) {
  const uint32_t segments = (d.chords + 1) / 2;
  const std::vector<Vec3> tips = shape.medial_tips();
  Snapper snapper(shape, sheet);
  std::vector<Tree> trees;
  for (const Row &row : plan_rows(shape, d, segments)) {
    Tree run;
    for (const Spot &spot : row) {
      const uint32_t vertex = snapper.nearest_free(spot.place);
      const Attachment next{vertex, spot.kind,
                            nearest_tip(tips, shape.closed(sheet.place[vertex]))};
      if (!run.empty() && run.back().tip != next.tip) {
        divide_into_trees(run, d.branching ? 3 : 1, trees);
        run.clear();
      }
      run.push_back(next);
    }
    divide_into_trees(run, d.branching ? 3 : 1, trees);
  }
  return trees;
}

}  // namespace mvs::core
