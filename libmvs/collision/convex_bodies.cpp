// Boxes around the motions of convex bodies, and separating planes.
#include "collision/convex_bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/approach.h"
#include "collision/near_parts.h"
#include "geometry/convex_distance.h"

namespace mvs::core {
namespace {

// Share of the arm by which a step may move the points of a frame relative to each other. The
// affine map of the frame then changes by less than 3/4 * 0.3 * 2 * sqrt(4/3) = 0.52 in norm, so
// that it keeps its orientation.
constexpr double most_turn = 0.3;
// A vertex within the arm moves by at most this multiple of the slack of the frame's points: the
// sum of the absolute weights.
constexpr double slack_of_vertex = 2;

// The largest distance of a point's step from the mean step of its frame.
double turn_of(const Vec3 *step) {
  const Vec3 mean = 0.25 * (step[0] + step[1] + step[2] + step[3]);
  double most = 0;
  for (uint32_t k = 0; k < frame_points; ++k) most = std::max(most, (step[k] - mean).squaredNorm());
  return std::sqrt(most);
}

ConvexBody make_body(const ToolShape &shape, uint32_t index) {
  const ToolBody &body = shape.bodies()[index];
  return {index, body.radius, {}, {}, {}, hull_edges(shape.faces(index), body.vertices.size())};
}

void scale(Vec3 *step, double factor) {
  for (uint32_t k = 0; k < frame_points; ++k) step[k] *= factor;
}

}  // namespace

bool ConvexBodies::set_tools(const std::vector<Tool> &tools, uint32_t first) {
  size_t k = 0;
  bool is_any_new = false;
  for (const Tool &tool : tools) {
    const uint32_t frame = first;
    first += tool.points();
    if (tool.kind != ToolKind::convex) continue;
    if (k == instruments_.size() || !instruments_[k].tool.is_same_as(tool)) {
      instruments_.resize(k);
      instruments_.push_back({tool, frame, {}});
      for (uint32_t b = 0; b < tool.shape->bodies().size(); ++b)
        instruments_[k].bodies.push_back(make_body(*tool.shape, b));
      is_any_new = true;
    }
    instruments_[k++].frame = frame;
  }
  instruments_.resize(k);
  return is_any_new;
}

void ConvexBodies::prepare(const std::vector<Vec3> &x, const std::vector<Vec3> &to, double slack) {
  for (ConvexInstrument &instrument : instruments_) {
    for (ConvexBody &body : instrument.bodies) find_near(instrument, body, x, to, slack);
  }
}

// A part is far from a body if all its corners, at both ends of the step, are outside of the same
// side of the box around the body's motion.
void ConvexBodies::find_near(const ConvexInstrument &instrument, ConvexBody &body,
                             const std::vector<Vec3> &x, const std::vector<Vec3> &to,
                             double slack) {
  Aabb box;
  for (const std::vector<Vec3> *at : {&x, &to}) {
    place_body(*instrument.tool.shape, body.index, std::span(*at).subspan(instrument.frame, 4),
               vertices_);
    for (const Vec3 &v : vertices_) box.add(v);
  }
  double thickest = 0;
  for (const Chord &chord : model_->valve.chords)
    thickest = std::max(thickest, chord_radius(chord));
  const double margin =
      body.radius + thickest + tool_range(*model_) + (1 + slack_of_vertex) * slack;
  box.low.array() -= margin;
  box.high.array() += margin;
  outside_.resize(x.size());
  for (size_t i = 0; i < x.size(); ++i)
    outside_[i] = sides_outside(box, x[i]) & sides_outside(box, to[i]);
  body.vertices.clear();
  body.triangles.clear();
  body.chords.clear();
  const auto &triangles = model_->valve.triangles.get();
  for (uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [i, j, k] = triangles[t];
    if ((outside_[i] & outside_[j] & outside_[k]) != 0) continue;
    body.triangles.push_back(t);
    body.vertices.insert(body.vertices.end(), {i, j, k});
  }
  sort_unique(body.vertices);
  const auto &chords = model_->valve.chords.get();
  for (uint32_t c = 0; c < chords.size(); ++c) {
    if ((outside_[chords[c].a] & outside_[chords[c].b]) == 0) body.chords.push_back(c);
  }
}

const std::vector<BodyPair> &ConvexBodies::barrier_pairs(const std::vector<Vec3> &x,
                                                         const std::vector<Vec3> &dx) {
  pairs_.clear();
  for (const ConvexInstrument &instrument : instruments_) {
    const ToolShape &shape = *instrument.tool.shape;
    for (const ConvexBody &body : instrument.bodies) {
      place_body(shape, body.index, std::span(x).subspan(instrument.frame, 4), vertices_);
      place_body(shape, body.index, std::span(dx).subspan(instrument.frame, 4), motion_);
      box_ = {};
      for (const Vec3 &v : vertices_) box_.add(v);
      longest_ = 0;
      for (const Vec3 &m : motion_) longest_ = std::max(longest_, m.squaredNorm());
      longest_ = std::sqrt(longest_);
      for (const uint32_t t : body.triangles)
        add_pair(instrument.frame, body.edges, model_->valve.triangles[t], body.radius, x, dx);
      for (const uint32_t c : body.chords) {
        const Chord &chord = model_->valve.chords[c];
        add_pair(instrument.frame, body.edges, std::array{chord.a, chord.b},
                 body.radius + chord_radius(chord), x, dx);
      }
    }
  }
  return pairs_;
}

// A pair that no point of the step can bring together needs no plane.
void ConvexBodies::add_pair(uint32_t frame, const HullEdges &edges, std::span<const uint32_t> part,
                            double radius, const std::vector<Vec3> &x,
                            const std::vector<Vec3> &dx) {
  std::array<Vec3, 3> place;
  std::array<uint32_t, 3> node;
  double far = 0;
  for (uint32_t k = 0; k < 3; ++k) {
    node[k] = part[std::min<size_t>(k, part.size() - 1)];
    place[k] = x[node[k]];
    far = std::max(far, dx[node[k]].squaredNorm());
  }
  const double approach = longest_ + std::sqrt(far);
  if (approach == 0) return;
  const auto corners = std::span<const Vec3>(place).first(part.size());
  const double cutoff = radius + least_tool_distance + approach / usable_share;
  if (is_apart(box_, corners, cutoff)) return;
  const ConvexDistance found = convex_distance(vertices_, corners, cutoff, &edges);
  if (found.is_beyond) return;
  const Vec3 normal = found.distance > 0 ? Vec3(found.apart / found.distance) : Vec3::Zero();
  const double gap = plane_gap(vertices_, corners, normal);
  pairs_.push_back({frame, node, normal, gap, radius, approach_along(normal)});
}

// A vertex that is farther from the plane than the nearest one may come nearer by the difference.
// The largest approach beyond that is a convex function of the share of the step, and 0 at 0: at a
// share it is at most that share of its value for the whole step.
double ConvexBodies::approach_along(const Vec3 &normal) const {
  double low = std::numeric_limits<double>::infinity(), nearer = 0;
  for (const Vec3 &v : vertices_) low = std::min(low, normal.dot(v));
  for (size_t k = 0; k < vertices_.size(); ++k) {
    const double room = normal.dot(vertices_[k]) - low;
    nearer = std::max(nearer, -normal.dot(motion_[k]) - room);
  }
  return nearer;
}

void ConvexBodies::shorten(std::vector<Vec3> &step, double longest) const {
  for (const ConvexInstrument &instrument : instruments_) {
    Vec3 *const first = step.data() + instrument.frame;
    double length = 0;
    for (uint32_t k = 0; k < frame_points; ++k) length = std::max(length, first[k].norm());
    if (length > longest) scale(first, longest / length);
  }
}

double ConvexBodies::keep_upright(std::vector<Vec3> &dx) const {
  double least = 1;
  for (const ConvexInstrument &instrument : instruments_) {
    Vec3 *const first = dx.data() + instrument.frame;
    const double turn = turn_of(first), most = most_turn * instrument.tool.length;
    if (turn <= most) continue;
    scale(first, most / turn);
    least = std::min(least, most / turn);
  }
  return least;
}

}  // namespace mvs::core
