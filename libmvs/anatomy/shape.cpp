// Smooth surface of a parametric valve: closed formulas of PARAMETRIC.md.
#include "anatomy/shape.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace mvs::core {
namespace {

// The annulus is y = AP/2 (cos + flatness sin^2): 0 is an ellipse, 1/2 a straight anterior side.
constexpr double flatness = 0.3;
// Position and width of the clefts beside P2, as a share of the angle from the P point to a
// commissure.
constexpr double cleft = 0.38;
constexpr double cleft_width = 0.1;
// Tilt of the open leaflet at annulus and free edge, rad: it leans inwards and turns until it hangs
// almost vertically.
constexpr double tilt_annulus = 1.0;
constexpr double tilt_edge = 0.05;
// The lean is directed to the coaptation line, with this share of its x towards the middle.
constexpr double inward_pull = 0.8;
// Largest sum of both leans as a share of the AP diameter, so that the open orifice stays open.
constexpr double greatest_lean = 0.65;
// Position of the coaptation line of the founding shape from posterior to anterior annulus.
constexpr double coaptation_share = 0.4;
// Lean of the open leaflets of the healthy shape: share of the way to the coaptation line, and sine
// of the largest mean tilt.
constexpr double open_lean = 0.45;
constexpr double greatest_tilt = 0.8;

double square(double a) {
  return a * a;
}

}  // namespace

// The closed target: width of the coaptation line as a share of the annulus, length of a loaded
// leaflet over its rest length, sag of the belly below the straight line as a share of its length.
struct Shape::Closed {
  double span, stretch, sag;
};

const Shape::Closed &Shape::target() const {
  // Founding: slightly below the kink of its law. Healthy: what the stiffest tissues stretch by at
  // 120 mmHg, so that they seal; its line ends near the commissures, where the leaflets fold; the
  // sag keeps the bellies of the softest tissues, which stretch by 60 %, below 2 mm of billow.
  static constexpr Closed founding = {0.86, 1.15, 0}, healthy_target = {0.95, 1.1, 0.07};
  return healthy() ? healthy_target : founding;
}

Shape::Turn Shape::turn_by(double angle) {
  return {math::sin(angle), math::cos(angle)};
}

// Inward and downward distance at share v along a leaflet of unit length that turns evenly from
// tilt a to tilt b; `at_a` is the turn by a.
std::array<double, 2> Shape::generator(double a, const Turn &at_a, double b, double v) {
  const Turn here = turn_by(a + (b - a) * v);
  return {(at_a.cos - here.cos) / (b - a), (here.sin - at_a.sin) / (b - a)};
}

Shape::Shape(const Dimensions &dimensions) : d_(dimensions) {
  constexpr int samples = 720;
  double length = 0;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < samples; ++i) {
    const Vec3 a = annulus(2 * pi * i / samples), b = annulus(2 * pi * (i + 1) / samples);
    length += (b - a).norm();
    sum += (b - a).norm() * 0.5 * (a + b);
  }
  centroid_ = sum / length;
  centroid_.x() = 0;
  share_ = healthy() ? balanced_share() : coaptation_share;
  if (healthy()) {
    reach_a_ = reach(0);
    reach_commissure_ = reach(commissure);
    reach_p_ = reach(pi);
    return;
  }
  const double inwards = generator(tilt_annulus, turn_by(tilt_annulus), tilt_edge, 1)[0];
  const double lean = inwards * (height(0) + height(pi));
  tilt_scale_ = std::min(1.0, greatest_lean * d_.annulus_ap / lean);
  tilt_ = turn_by(tilt_scale_ * tilt_annulus);
}

double Shape::cleft_theta() {
  return pi - cleft * (pi - commissure);
}

Vec3 Shape::annulus(double theta) const {
  return annulus(turn_by(theta));
}

Vec3 Shape::annulus(const Turn &theta) const {
  const double c = theta.cos, s = theta.sin;
  return Vec3(0.5 * d_.annulus_cc * s, 0.5 * d_.annulus_ap * (c + flatness * s * s),
              0.5 * d_.saddle_height * (c * c - s * s)) -
         centroid_;
}

double Shape::height(double theta) const {
  const double angle = std::abs(theta);
  return healthy() ? healthy_height(angle, turn_by(angle), reach(angle)) : founding_height(angle);
}

Vec3 Shape::open(const Place &place) const {
  return healthy() ? healthy_open(place) : founding_open(place);
}

// Depth of the clefts at t, 0 at the P point and 1 at a commissure.
double Shape::cleft_dip(double t) const {
  return d_.indentation_depth * math::exp(-square((t - cleft) / cleft_width));
}

double Shape::founding_height(double angle) const {
  const double base = d_.commissure_height;
  if (angle < commissure) {
    const double s = angle / commissure;
    return base + (d_.anterior_height - base) * square(1 - s * s * s);
  }
  const double t = (pi - angle) / (pi - commissure);
  return base + (d_.posterior_height - base) * square(1 - square(square(t))) - cleft_dip(t);
}

Vec3 Shape::founding_open(const Place &place) const {
  const Turn turn = turn_by(place.theta);
  const Vec3 base = annulus(turn);
  Vec3 inward = coaptation(turn) - base;
  inward.x() = -inward_pull * base.x();
  inward.z() = 0;
  inward.normalize();
  const auto run = generator(tilt_scale_ * tilt_annulus, tilt_, tilt_scale_ * tilt_edge, place.v);
  const double h = height(place.theta);
  return base + h * run[0] * inward - Vec3(0, 0, h * run[1]);
}

Vec3 Shape::coaptation(const Turn &theta) const {
  const double s = theta.sin, c = std::abs(theta.cos);
  const double y = 0.5 * d_.annulus_ap * (flatness * s * s + (2 * share_ - 1) * c);
  return {target().span * 0.5 * d_.annulus_cc * s, y - centroid_.y(), -d_.coaptation_depth};
}

Vec3 Shape::closed(const Place &place) const {
  const Turn turn = turn_by(place.theta);
  const Vec3 base = d_.annulus_contraction * annulus(turn);
  const Vec3 line = coaptation(turn);
  const double run = target().stretch * height(place.theta) * place.v;
  const double reach = (line - base).norm();
  if (run >= reach) return line - Vec3(0, 0, run - reach);
  const double u = run / reach;
  const Vec3 straight = base + u * (line - base);
  return healthy() ? Vec3(straight - Vec3(0, 0, target().sag * reach * 4 * u * (1 - u))) : straight;
}

double Shape::reach(double theta) const {
  const Turn turn = turn_by(theta);
  return (coaptation(turn) - annulus(turn)).norm();
}

double Shape::balanced_share() const {
  Shape trial = *this;
  double low = 0.1, high = 0.5;
  for (int i = 0; i < 50; ++i) {
    trial.share_ = 0.5 * (low + high);
    const double anterior = target().stretch * d_.anterior_height - trial.reach(0);
    const double posterior = target().stretch * d_.posterior_height - trial.reach(pi);
    (anterior < posterior ? low : high) = trial.share_;
  }
  return 0.5 * (low + high);
}

// The heights at A2, P2 and the commissures are given; in between the overlap of the stretched
// leaflet beyond the coaptation line goes from one to the other as cos^2, so that the free edges of
// both leaflets meet all along the line.
double Shape::healthy_height(double angle, const Turn &turn, double reach) const {
  const bool anterior = angle < commissure;
  const double middle = anterior ? d_.anterior_height : d_.posterior_height;
  const double w = square(turn.cos), s = target().stretch;
  const double between = (1 - w) * d_.commissure_height + w * middle;
  const double chord = (1 - w) * reach_commissure_ + w * (anterior ? reach_a_ : reach_p_);
  // at most 30 %, for combinations of dimensions far from any anatomy
  const double more = std::clamp((reach - chord) / s, -0.3 * between, 0.3 * between);
  return between + more - (anterior ? 0 : cleft_dip((pi - angle) / (pi - commissure)));
}

// An arc that hangs vertically at the free edge and leans towards the coaptation line, by the same
// share of the way everywhere: the open orifice is that line, widened, and ends in points at the
// commissures, where the leaflets have to fold.
Vec3 Shape::healthy_open(const Place &place) const {
  const Turn turn = turn_by(place.theta);
  const Vec3 base = annulus(turn);
  Vec3 way = coaptation(turn) - base;
  const double h = healthy_height(std::abs(place.theta), turn, way.norm());
  way.z() = 0;
  const double distance = way.norm();
  const double lean = std::min(open_lean * distance / h, greatest_tilt);
  // the tilt goes evenly from 2 m at the annulus to 0, m on average
  const double m = math::atan2(lean, std::sqrt(1 - lean * lean));
  const double half = m * place.v, tilt = 2 * m - half;
  const double length = h * place.v * (half < 1e-4 ? 1 - half * half / 6 : math::sin(half) / half);
  const Vec3 inward = distance > 0 ? Vec3(way / distance) : Vec3::Zero();
  return base + length * math::sin(tilt) * inward - Vec3(0, 0, length * math::cos(tilt));
}

std::vector<Vec3> Shape::medial_tips() const {
  const double x = 0.5 * d_.papillary_separation, z = -d_.papillary_depth;
  const double y = -0.12 * d_.annulus_ap;
  return {{x, y + 1 * mm, z}, {x + 1.5 * mm, y, z}, {x, y - 1 * mm, z}};
}

ArcLength::ArcLength(const Shape &shape, double v, double theta0, double theta1)
    : theta0_(theta0), theta1_(theta1), length_{0} {
  constexpr int samples = 1000;
  step_ = (theta1 - theta0) / samples;
  Vec3 last = shape.open({theta0, v});
  for (int i = 1; i <= samples; ++i) {
    const Vec3 next = shape.open({theta0 + i * step_, v});
    length_.push_back(length_.back() + (next - last).norm());
    last = next;
  }
}

double ArcLength::theta_at(double length) const {
  if (length >= total()) return theta1_;
  const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, length);
  const double low = *(above - 1), share = (length - low) / (*above - low);
  return theta0_ + step_ * (static_cast<double>(above - length_.begin()) - 1 + share);
}

}  // namespace mvs::core
