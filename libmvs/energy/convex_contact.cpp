// Distances between convex bodies and tissue, their barrier, and the springs of frames.
#include "energy/convex_contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/near_parts.h"
#include "energy/settings.h"
#include "geometry/convex_distance.h"

namespace mvs::core {
namespace {

constexpr double frame_stiffness = settings::instrument::frame_stiffness;

// Adds the weights of corner k of the difference of both hulls, times a factor.
void add_corner(const ConvexDistance &found, uint32_t k, size_t parts,
                const std::vector<FrameWeights> &weights, double factor, BodyContact::Weights &to) {
  to[found.second[k]] -= factor;
  const FrameWeights &w = weights[found.first[k]];
  for (uint32_t p = 0; p < frame_points; ++p) to[parts + p] += factor * w[p];
}

BodyContact contact_of(const ConvexDistance &found, std::span<const uint32_t> part, uint32_t frame,
                       const std::vector<FrameWeights> &weights) {
  BodyContact c{};
  for (const uint32_t i : part) c.node[c.count++] = i;
  for (uint32_t p = 0; p < frame_points; ++p) c.node[c.count++] = frame + p;
  for (uint32_t k = 0; k < found.count; ++k)
    add_corner(found, k, part.size(), weights, found.weight[k], c.weight);
  for (uint32_t k = 1; k < found.count; ++k) {
    add_corner(found, k, part.size(), weights, 1, c.slide[k - 1]);
    add_corner(found, 0, part.size(), weights, -1, c.slide[k - 1]);
  }
  c.slides = found.count - 1;
  c.distance = found.distance;
  c.normal = found.apart / found.distance;
  return c;
}

// The second derivative of one contact: the form of ContactPairHessian (energy/barrier.cpp) over
// more nodes.
class BodyContactHessian {
 public:
  BodyContactHessian(const BodyContact &s, double second, double c, const std::vector<Vec3> &x)
      : contact_(s), c_(c) {
    along_ = (second - c) * s.normal * s.normal.transpose();
    along_.diagonal().array() += c;
    if (c != 0) slide(x);
  }

  Mat3 block(uint32_t k, uint32_t l) const {
    Mat3 sum = contact_.weight[k] * contact_.weight[l] * along_;
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b)
        sum -= c_ * inverse_(a, b) * u_[a][k] * u_[b][l].transpose();
    }
    return sum;
  }

 private:
  void slide(const std::vector<Vec3> &x) {
    slides_ = contact_.slides;
    std::array<Vec3, 2> t{Vec3::Zero(), Vec3::Zero()};
    Eigen::Matrix2d gram = Eigen::Matrix2d::Identity();
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t k = 0; k < contact_.count; ++k)
        t[a] += contact_.slide[a][k] * x[contact_.node[k]];
    }
    for (uint32_t a = 0; a < slides_; ++a) {
      for (uint32_t b = 0; b < slides_; ++b) gram(a, b) = t[a].dot(t[b]);
      for (uint32_t k = 0; k < contact_.count; ++k) {
        u_[a][k] =
            contact_.weight[k] * t[a] + contact_.slide[a][k] * contact_.distance * contact_.normal;
      }
    }
    inverse_ = gram.inverse();
  }

  const BodyContact &contact_;
  double c_;
  Mat3 along_;
  uint32_t slides_ = 0;
  std::array<std::array<Vec3, BodyContact::most_nodes>, 2> u_;
  Eigen::Matrix2d inverse_;
};

}  // namespace

void ConvexContactTerm::collect(const std::vector<Vec3> &x, const ConvexBodies &bodies) {
  contacts_.clear();
  edges_.clear();
  for (const ConvexInstrument &instrument : bodies.all()) {
    const double length = frame_edge(instrument.tool.length);
    for (uint32_t k = 1; k < frame_points; ++k) {
      for (uint32_t l = 0; l < k; ++l)
        edges_.push_back({{instrument.frame + k, instrument.frame + l}, length});
    }
    for (const ConvexBody &body : instrument.bodies) collect_body(x, instrument, body);
  }
}

void ConvexContactTerm::collect_body(const std::vector<Vec3> &x, const ConvexInstrument &instrument,
                                     const ConvexBody &body) {
  const Valve &valve = model_->valve;
  if (body.vertices.empty() && body.chords.empty()) return;
  place_body(*instrument.tool.shape, body.index,
             std::span(x).subspan(instrument.frame, frame_points), vertices_);
  box_ = {};
  for (const Vec3 &v : vertices_) box_.add(v);
  const double range = tool_range(*model_), kappa = valve.contact_stiffness;
  for (const uint32_t v : body.vertices) {
    take(x, instrument, body, std::array{v}, {body.radius, range, kappa * model_->vertex_area[v]});
  }
  const double barrier_range = barrier_share * valve.contact_thickness;
  for (const uint32_t t : body.triangles) {
    take(x, instrument, body, valve.triangles[t],
         {body.radius, barrier_range, 0.5 * kappa * (model_->rest_area[t] / 3)});
  }
  for (const uint32_t c : body.chords) {
    const Chord &chord = valve.chords[c];
    const double radius = chord_radius(chord);
    take(x, instrument, body, std::array{chord.a, chord.b},
         {body.radius + radius, range, kappa * radius * chord.rest_length});
  }
}

void ConvexContactTerm::take(const std::vector<Vec3> &x, const ConvexInstrument &instrument,
                             const ConvexBody &body, std::span<const uint32_t> part,
                             const Law &law) {
  std::array<Vec3, 3> place;
  for (size_t k = 0; k < part.size(); ++k) place[k] = x[part[k]];
  const auto corners = std::span<const Vec3>(place).first(part.size());
  const double reach = law.radius + law.range;
  if (is_apart(box_, corners, reach)) return;
  const ConvexDistance found = convex_distance(vertices_, corners, reach);
  if (found.is_beyond || found.distance >= reach || found.count == 0) return;
  BodyContact c =
      contact_of(found, part, instrument.frame, instrument.tool.shape->weights(body.index));
  c.radius = law.radius;
  c.range = law.range;
  c.strength = law.strength;
  contacts_.push_back(c);
}

double ConvexContactTerm::energy(const std::vector<Vec3> &x) const {
  double sum = 0;
  for (const BodyContact &c : contacts_)
    sum += c.strength * c.range * barrier(c.gap() / c.range).value;
  for (const FrameEdge &e : edges_) {
    const double longer = (x[e.node[1]] - x[e.node[0]]).norm() - e.length;
    sum += 0.5 * frame_stiffness * longer * longer;
  }
  return sum;
}

void ConvexContactTerm::add_gradient(const std::vector<Vec3> &x, std::vector<Vec3> &g) const {
  for (const BodyContact &c : contacts_) {
    const Vec3 f = c.strength * barrier(c.gap() / c.range).first * c.normal;
    for (uint32_t k = 0; k < c.count; ++k) g[c.node[k]] += c.weight[k] * f;
  }
  for (const FrameEdge &e : edges_) {
    const Vec3 d = x[e.node[1]] - x[e.node[0]];
    const Vec3 f = frame_stiffness * (1 - e.length / d.norm()) * d;
    g[e.node[0]] -= f;
    g[e.node[1]] += f;
  }
}

bool ConvexContactTerm::hessian(const std::vector<Vec3> &x, Curvature curvature,
                                HessianAssembler &system) const {
  bool complete = true;
  const bool exact = curvature == Curvature::exact;
  for (const BodyContact &c : contacts_) {
    const Barrier b = barrier(c.gap() / c.range);
    const BodyContactHessian blocks(c, c.strength / c.range * b.second,
                                    exact ? c.strength * b.first / c.distance : 0, x);
    for (uint32_t k = 0; k < c.count; ++k) {
      system.add_diagonal(c.node[k], blocks.block(k, k));
      for (uint32_t l = 0; l < k; ++l)
        complete = system.add(c.node[k], c.node[l], blocks.block(k, l)) && complete;
    }
  }
  for (const FrameEdge &e : edges_) {
    const Vec3 d = x[e.node[1]] - x[e.node[0]];
    const double length = d.norm();
    const Mat3 block = axial_block(d / length, frame_stiffness,
                                   frame_stiffness * (1 - e.length / length), curvature);
    system.add_diagonal(e.node[0], block);
    system.add_diagonal(e.node[1], block);
    complete = system.add(e.node[0], e.node[1], -block) && complete;
  }
  return complete;
}

void ConvexContactTerm::add_pairs(std::vector<Edge> &pairs) const {
  for (const BodyContact &c : contacts_) {
    for (uint32_t k = 0; k < c.count; ++k) {
      for (uint32_t l = 0; l < k; ++l) pairs.push_back({c.node[k], c.node[l]});
    }
  }
  for (const FrameEdge &e : edges_) pairs.push_back(e.node);
}

}  // namespace mvs::core
