// Sums plane waves over the nodes and limits the displacement.
#include "ensemble/perturbation.h"

#include <algorithm>
#include <limits>

#include "base/math.h"
#include "collision/broad_phase.h"
#include "collision/step_limiter.h"

namespace mvs::core {
namespace {

constexpr int wave_count = 24;
constexpr double longest_wave = 8;  // times the shortest: from pleats to half a leaflet

struct Wave {
  Vec3 along;  // wave vector, rad/m
  Vec3 towards;
  double phase;
};

// Wavelengths are uniform in their logarithm: as many long waves as short ones.
std::vector<Wave> make_waves(double wavelength, Random &random) {
  constexpr double turn = 6.283185307179586;
  std::vector<Wave> waves(wave_count);
  for (Wave &wave : waves) {
    const double length = wavelength * math::pow(longest_wave, random.uniform());
    wave.along = turn / length * random.direction();
    wave.towards = random.direction();
    wave.phase = turn * random.uniform();
  }
  return waves;
}

double to_nearest_prescribed(const Model &model, const std::vector<Vec3> &x, const Vec3 &at) {
  double nearest2 = std::numeric_limits<double>::infinity();
  for (size_t j = 0; j < x.size(); ++j) {
    if (model.topology.fixed[j]) nearest2 = std::min(nearest2, (x[j] - at).squaredNorm());
  }
  return std::sqrt(nearest2);
}

std::vector<Vec3> displacements(const Model &model, const std::vector<Vec3> &x,
                                const Disturbance &how, Random &random) {
  const std::vector<Wave> waves = make_waves(how.wavelength, random);
  std::vector<Vec3> dx(x.size(), Vec3::Zero());
  for (size_t i = 0; i < x.size(); ++i) {
    if (model.topology.fixed[i]) continue;
    for (const Wave &w : waves) dx[i] += math::cos(w.along.dot(x[i]) + w.phase) * w.towards;
    dx[i] *= std::min(1.0, to_nearest_prescribed(model, x, x[i]) / how.wavelength);
  }
  return dx;
}

double longest(const std::vector<Vec3> &dx) {
  double square = 0;
  for (const Vec3 &d : dx) square = std::max(square, d.squaredNorm());
  return std::sqrt(square);
}

}  // namespace

double disturb(const Model &model, std::vector<Vec3> &x, const Disturbance &how, Random random) {
  std::vector<Vec3> dx = displacements(model, x, how, random);
  const double farthest = longest(dx);
  if (how.longest <= 0 || farthest == 0) return 0;
  for (Vec3 &d : dx) d *= how.longest / farthest;
  BroadPhase broad_phase(model);
  StepLimiter().limit(model, x, 0, broad_phase, dx);
  for (size_t i = 0; i < x.size(); ++i) x[i] += dx[i];
  return longest(dx);
}

}  // namespace mvs::core
