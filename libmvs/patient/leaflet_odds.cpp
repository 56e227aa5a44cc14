// Cues as normal deviates. The odds of two sides are the fourth root of what independent cues give,
// as these depend on each other; pairs near each other share their errors.
#include "patient/leaflet_odds.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "linalg/small_solve.h"

namespace mvs::core {
namespace {

struct Cue {
  double mean, deviation;
  double off(double value) const { return (value - mean) / deviation; }
};

// Heights of the leaflets at the commissures over the median one: 8 to 10 mm of 13 to 20.
constexpr Cue end_height = {0.55, 0.15};
// Logarithm of the height of the anterior leaflet over that of the posterior one: 22 to 25 mm over
// 12 to 14 mm; 26 over 15 mm in a valve from CT.
constexpr Cue height_ratio = {0.55, 0.25};
// Share of the annulus: 0.35 to 0.45 between trigones and commissures, 0.5 where the commissures
// are at its widest place.
constexpr Cue attachment = {0.42, 0.08};
// Way from the line between the commissures to the middle of the anterior annulus, over that from
// there to the middle of the posterior annulus: the annulus is D-shaped, flat at the aorta. 0.33 in
// a valve from CT, 0.38 in one from ultrasound, 0.42 to 0.5 in parametric ones; 0.2 to 0.25 where
// the anterior leaflet has the third of the annulus that textbooks give it.
constexpr Cue flatness = {0.36, 0.1};
// Distance of the commissures over the largest width of the annulus: they end its long axis.
constexpr Cue end_distance = {0.95, 0.08};
// Place of the papillary tips from the middle of the annulus towards the A point, over the AP
// diameter: a little posterior; 0.44 posterior in a valve from CT.
constexpr Cue tips_forward = {-0.2, 0.2};
// Sine of the angle between the line of the commissures and that of the papillary muscles.
constexpr Cue tips_turn = {0, 0.3};

// Deviation of a height from that of a leaflet with a smooth edge, over the median height:
// scallops, indentations, tears. Deviations go on over 8 mm, so that 120 samples count as 15.
constexpr double height_deviation = 0.25, height_samples = 8;
constexpr double least_height = 0.05;  // of a leaflet: a fit of another shape may be negative

constexpr double dependence = 0.25;
constexpr size_t near = 4;  // samples of about 1 mm

double squared(double v) {
  return v * v;
}

// Heights along the annulus as two leaflets have them that meet where they are low: straight from
// end to end, and above it a parabola on the anterior side (a dome) and half an ellipse on the
// posterior one (as high almost everywhere). All heights are over the median one.
struct TwoLeaflets {
  double end = 0;                      // the mean of both ends
  double anterior = 0, posterior = 0;  // in the middle
  double left = 0;                     // sum of the squared deviations
};

// By least squares. A place of low height that is no end is a deviation: without them, clefts and
// the indentations between scallops passed for commissures, as they are as low.
TwoLeaflets two_leaflets(const std::vector<double> &height, double median, size_t from, size_t to) {
  const size_t n = height.size(), count = to - from;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  double all = 0;
  for (size_t k = 0; k < n; ++k) {
    const bool anterior = k <= count;
    const double u = anterior ? static_cast<double>(k) / static_cast<double>(count)
                              : static_cast<double>(k - count) / static_cast<double>(n - count);
    const double dome = 4 * u * (1 - u);
    const Eigen::Vector4d row(anterior ? 1 - u : u, anterior ? u : 1 - u, anterior ? dome : 0,
                              anterior ? 0 : std::sqrt(dome));
    const double h = height[(from + k) % n] / median;
    normal += row * row.transpose();
    right += h * row;
    all += h * h;
  }
  const Eigen::Vector4d found = solve_positive<4>(normal, right);
  const double end = 0.5 * (found[0] + found[1]);
  return {end, end + found[2], end + found[3], std::max(0.0, all - found.dot(right))};
}

}  // namespace

ArcOdds::ArcOdds(const AnnulusSamples &annulus) : annulus_(annulus) {
  std::vector<double> sorted = annulus.height;
  std::sort(sorted.begin(), sorted.end());
  median_ = sorted[sorted.size() / 2];
  for (const Vec3 &p : annulus.points) {
    for (const Vec3 &q : annulus.points) width_ = std::max(width_, (p - q).norm());
  }
}

// Deviations of the papillary tips: their place, and the direction in which they lie apart.
double ArcOdds::forward_of_tips(const Vec3 &ends, const Vec3 &across) const {
  const std::vector<Vec3> &tips = annulus_.tips;
  if (tips.empty()) return 0;
  Vec3 centre = Vec3::Zero(), middle = Vec3::Zero();
  for (const Vec3 &p : annulus_.points) {
    centre += p / static_cast<double>(annulus_.points.size());
  }
  Vec3 apart = Vec3::Zero();
  for (const Vec3 &p : tips) {
    middle += p / static_cast<double>(tips.size());
    for (const Vec3 &q : tips) {
      if ((p - q).squaredNorm() > apart.squaredNorm()) apart = p - q;
    }
  }
  const double diameter = across.norm();
  double sum = squared(tips_forward.off((middle - centre).dot(across) / (diameter * diameter)));
  if (apart.norm() > 0 && ends.norm() > 0) {
    const double cosine = apart.dot(ends) / (apart.norm() * ends.norm());
    sum += squared(tips_turn.off(std::sqrt(std::max(0.0, 1 - cosine * cosine))));
  }
  return sum;
}

double ArcOdds::misfit(size_t from, size_t to) const {
  const size_t n = annulus_.points.size();
  const Vec3 &a = annulus_.points[from % n], &b = annulus_.points[to % n];
  const Vec3 &anterior = annulus_.points[(from + to) / 2 % n];
  const Vec3 &posterior = annulus_.points[(from + to + n) / 2 % n];
  const Vec3 across = anterior - posterior, middle = 0.5 * (a + b);
  const double diameter2 = std::max(across.squaredNorm(), 1e-12);
  const double share = static_cast<double>(to - from) / static_cast<double>(n);
  const TwoLeaflets fit = two_leaflets(annulus_.height, median_, from, to);
  const double ratio = std::max(fit.anterior, least_height) / std::max(fit.posterior, least_height);
  double sum = fit.left / (height_samples * squared(height_deviation));
  sum += squared(std::max(0.0, end_height.off(fit.end)));
  sum += squared(height_ratio.off(math::log(ratio)));
  sum += squared(attachment.off(share));
  sum += squared(flatness.off((anterior - middle).dot(across) / diameter2));
  sum += squared(std::min(0.0, end_distance.off((a - b).norm() / width_)));
  return sum + forward_of_tips(a - b, across);
}

ArcGuess ArcOdds::best(double least_share) const {
  const size_t n = annulus_.points.size();
  const size_t gap = static_cast<size_t>(least_share * static_cast<double>(n));
  ArcGuess guess;
  double least = INFINITY;
  std::vector<double> misfits(n * n, INFINITY);
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + gap; j <= i + n - gap; ++j) {
      const double here = misfits[i * n + j % n] = misfit(i, j);
      if (here >= least) continue;
      least = here;
      guess.from = i;
      guess.to = j;
    }
  }
  // the posterior of pairs of feet, whatever lies between, and of the side
  const auto apart = [n](size_t a, size_t b) {
    const size_t d = a > b ? a - b : b - a;
    return std::min(d, n - d);
  };
  double all = 0, pair = 0, any_side = 0, this_side = 0;
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j) {
      const double m = misfits[i * n + j];
      if (m == INFINITY) continue;
      const double weight = math::exp(-0.5 * (m - least));
      all += weight;
      const double side = math::exp(-0.5 * dependence * (m - least));
      any_side += side;
      // twice the way from one end of the guess to the middle of this arc
      const size_t middle2 = (2 * (i + n - guess.from) + (j + n - i) % n) % (2 * n);
      if (middle2 < 2 * (guess.to - guess.from)) this_side += side;
      const size_t to = guess.to % n;
      if ((apart(i, guess.from) <= near && apart(j, to) <= near) ||
          (apart(j, guess.from) <= near && apart(i, to) <= near)) {
        pair += weight;
      }
    }
  }
  guess.confidence = pair / all;
  guess.orientation = this_side / any_side;
  return guess;
}

double ArcOdds::is_anterior(size_t from, size_t to) const {
  const size_t n = annulus_.points.size();
  const double difference = misfit(to % n, from + (to >= n ? 0 : n)) - misfit(from, to);
  return 1 / (1 + math::exp(-0.5 * dependence * difference));
}

}  // namespace mvs::core
