// Distances between convex bodies and tissue, their barrier, and the springs of frames.
#include "energy/convex_contact.h"

#include <algorithm>
#include <cmath>

#include "collision/contact_params.h"
#include "collision/near_parts.h"
#include "energy/contact.h"
#include "energy/settings.h"

namespace mvs::core {
namespace {

constexpr double frame_stiffness = settings::instrument::frame_stiffness;

// Adds the weights of corner k of the difference of both hulls, times a factor.
void add_corner(const SmoothDistance &found, uint32_t k, size_t parts,
                const std::vector<FrameWeights> &weights, double factor, BodyContact::Weights &to) {
  to[found.second[k]] -= factor;
  const FrameWeights &w = weights[found.first[k]];
  for (uint32_t p = 0; p < frame_points; ++p) to[parts + p] += factor * w[p];
}

BodyContact contact_of(const SmoothDistance &found, std::span<const uint32_t> part, uint32_t frame,
                       const std::vector<FrameWeights> &weights) {
  BodyContact c{};
  for (const uint32_t i : part) c.node[c.count++] = i;
  c.parts = c.count;
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
  c.factor = found.factor;
  c.bend = found.bend;
  return c;
}

// A direction of sliding that depends on the others to rounding is held.
constexpr double least_independence = 1e-13;

// The second derivative of one contact. With D = (d - R) / m, r = sum w_k x_k, n = r / |r|, P = I -
// n n^T, t_a = sum slide_ak x_k, and closest points that slide so that n t_a = D m_a, block (k, l)
// is
//   w_k w_l (E'' n n^T / m^2 + E' P / (m d)) - E' / m sum_ab (G^-1)_ab u_ka u_lb^T,
//   G_ab = t_a P t_b / d - D m_ab,   u_ka = slide_ka n + w_k (P t_a / d - m_a / m n).
// The projected Hessian leaves out the terms with P / d: E'' is positive and E' negative. It keeps
// the stiffness of a facet against a turn, without which a Newton step turns it much too far.
class BodyContactHessian {
 public:
  BodyContactHessian(const BodyContact &s, const Barrier &b, bool exact, const std::vector<Vec3> &x)
      : contact_(s), first_(s.strength * b.first / s.factor), exact_(exact) {
    const double second = s.strength / s.range * b.second / (s.factor * s.factor);
    const double across = exact ? first_ / s.distance : 0;
    along_ = (second - across) * s.normal * s.normal.transpose();
    along_.diagonal().array() += across;
    if (exact || s.bend > 0) slide(x);
  }

  Mat3 block(uint32_t k, uint32_t l) const {
    Mat3 sum = contact_.weight[k] * contact_.weight[l] * along_;
    for (uint32_t a = 0; a < slides_; ++a) sum -= first_ * u_[a][k] * u_[a][l].transpose();
    return sum;
  }

 private:
  static constexpr uint32_t most = BodyContact::most_slides;

  void slide(const std::vector<Vec3> &x) {
    const BodyContact &s = contact_;
    slides_ = s.slides;
    std::array<Vec3, most> across;  // P t_a
    for (uint32_t a = 0; a < slides_; ++a) {
      Vec3 t = Vec3::Zero();
      for (uint32_t k = 0; k < s.count; ++k) t += s.slide[a][k] * x[s.node[k]];
      across[a] = t - s.normal.dot(t) * s.normal;
      double factor = 0;  // m_a
      for (uint32_t k = 0; k < s.parts; ++k) factor -= s.bend * s.weight[k] * s.slide[a][k];
      for (uint32_t b = 0; b <= a; ++b) {
        double both = 0;
        for (uint32_t k = 0; k < s.parts; ++k) both += s.slide[a][k] * s.slide[b][k];
        gram_[a][b] = across[a].dot(across[b]) / s.distance + s.gap() * s.bend * both;
      }
      Vec3 turn = -factor / s.factor * s.normal;
      if (exact_) turn += across[a] / s.distance;
      for (uint32_t k = 0; k < s.count; ++k)
        u_[a][k] = s.slide[a][k] * s.normal + s.weight[k] * turn;
    }
    decorrelate();
  }

  // Replaces u by L^-1 u, G = L L^T.
  void decorrelate() {
    for (uint32_t a = 0; a < slides_; ++a) {
      const double whole = gram_[a][a];
      for (uint32_t b = 0; b <= a; ++b) {
        for (uint32_t c = 0; c < b; ++c) gram_[a][b] -= gram_[a][c] * gram_[b][c];
        if (b < a) gram_[a][b] = gram_[b][b] > 0 ? gram_[a][b] / gram_[b][b] : 0;
      }
      const bool is_free = gram_[a][a] > least_independence * whole;
      gram_[a][a] = is_free ? std::sqrt(gram_[a][a]) : 0;
      for (uint32_t k = 0; k < contact_.count; ++k) {
        for (uint32_t c = 0; c < a; ++c) u_[a][k] -= gram_[a][c] * u_[c][k];
        if (is_free)
          u_[a][k] /= gram_[a][a];
        else
          u_[a][k].setZero();
      }
    }
  }

  const BodyContact &contact_;
  double first_;  // E' / m
  bool exact_;
  Mat3 along_;
  uint32_t slides_ = 0;
  std::array<std::array<double, most>, most> gram_;
  std::array<std::array<Vec3, BodyContact::most_nodes>, most> u_;
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
         {body.radius, barrier_range,
          tool_barrier_strength(*model_, model_->rest_area[t] / 3, instrument.tool.max_force)});
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
  constexpr double share = settings::instrument::smoothing;
  if (is_apart(box_, corners, law.radius + (1 + 0.5 * share) * law.range)) return;
  const SmoothDistance found =
      smooth_distance(vertices_, corners, law.radius, share, law.range, &body.edges);
  if (found.is_beyond || found.count == 0) return;
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
    const Vec3 f = c.strength / c.factor * barrier(c.gap() / c.range).first * c.normal;
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
                                HessianAssembler &assembler) const {
  bool complete = true;
  for (const BodyContact &c : contacts_) {
    const BodyContactHessian blocks(c, barrier(c.gap() / c.range), curvature == Curvature::exact,
                                    x);
    for (uint32_t k = 0; k < c.count; ++k) {
      assembler.add_diagonal(c.node[k], blocks.block(k, k));
      for (uint32_t l = 0; l < k; ++l)
        complete = assembler.add(c.node[k], c.node[l], blocks.block(k, l)) && complete;
    }
  }
  for (const FrameEdge &e : edges_) {
    const Vec3 d = x[e.node[1]] - x[e.node[0]];
    const double length = d.norm();
    const Mat3 block = axial_block(d / length, frame_stiffness,
                                   frame_stiffness * (1 - e.length / length), curvature);
    assembler.add_diagonal(e.node[0], block);
    assembler.add_diagonal(e.node[1], block);
    complete = assembler.add(e.node[0], e.node[1], -block) && complete;
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
