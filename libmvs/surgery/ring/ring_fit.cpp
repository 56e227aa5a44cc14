// Search over the start point, with the Kabsch motion for each.
#include "surgery/ring/ring_fit.h"

#include <cmath>

namespace mvs::core {
namespace {

constexpr int samples = 180;

struct Search {
  const Loop &ring;
  const RingSeat &seat;
  std::vector<Vec3> target;  // on the annulus, at equal shares from the A point

  RingFit at(double start, bool reversed) const {
    RingFit fit{{}, start, reversed, 0};
    std::vector<Vec3> source;
    for (size_t k = 0; k < target.size(); ++k) {
      source.push_back(seat_of(ring, fit, static_cast<double>(k) / samples));
    }
    fit.motion = seat.motion ? *seat.motion : register_points(source, target);
    for (size_t k = 0; k < target.size(); ++k) {
      fit.squares += (fit.motion(source[k]) - target[k]).squaredNorm() / samples;
    }
    return fit;
  }

  // Golden section search between the neighbours of the best start, to 1e-9 of the length, so that
  // the result does not depend on the start of the given curve.
  RingFit refined(RingFit best) const {
    const double golden = 0.5 * (std::sqrt(5.0) - 1);
    double low = best.start - 1.0 / samples, high = best.start + 1.0 / samples;
    while (high - low > 1e-9) {
      const double step = golden * (high - low);
      const RingFit left = at(high - step, best.reversed), right = at(low + step, best.reversed);
      (left.squares < right.squares ? high : low) =
          left.squares < right.squares ? right.start : left.start;
      const RingFit &better = left.squares < right.squares ? left : right;
      if (better.squares < best.squares) best = better;
    }
    return best;
  }
};

}  // namespace

Vec3 seat_of(const Loop &ring, const RingFit &fit, double u) {
  return fit.motion(ring.at((fit.reversed ? fit.start - u : fit.start + u) * ring.length()));
}

RingFit fit_ring(const Loop &ring, const Loop &annulus, double a, const RingSeat &seat) {
  Search search{ring, seat, {}};
  for (int k = 0; k < samples; ++k) {
    search.target.push_back(annulus.at(a + annulus.length() * k / samples));
  }
  const int starts = seat.start_is_a ? 1 : samples;
  RingFit best = search.at(0, false);
  for (int k = 0; k < starts; ++k) {
    for (const bool reversed : {false, true}) {
      const RingFit fit = search.at(static_cast<double>(k) / samples, reversed);
      if (fit.squares < best.squares) best = fit;
    }
  }
  return seat.start_is_a ? best : search.refined(best);
}

}  // namespace mvs::core
