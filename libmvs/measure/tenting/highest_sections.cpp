// Highest sections by halving at the crossings of the outer two; means by the median and by
// Newton's method.
#include "measure/tenting/highest_sections.h"

namespace mvs::core {
namespace {

// The most halvings of an interval in which more than two sections are the highest.
constexpr int most_crossings = 8;
// Newton's method on a function of a few quadratic parts needs as many steps as parts.
constexpr int most_iterations = 30;

// The mean height of the upper half of an envelope, by length: the conditional value at risk of
// level 1/2, t + integral of max(z - t, 0) / (length / 2) for the median t (Rockafellar and
// Uryasev, J. Risk 2, 2000). `heights` is a buffer.
double mean_of_upper_half(const std::vector<Stretch> &envelope, double length,
                          std::vector<double> &heights) {
  const auto above = [&](double height) {
    std::pair<double, double> sum = {0.0, 0.0};
    for (const Stretch &s : envelope) {
      const auto [part, integral] = s.above(height);
      sum.first += part;
      sum.second += integral;
    }
    return sum;
  };
  heights.clear();
  for (const Stretch &s : envelope) heights.insert(heights.end(), {s.at_from, s.at_to});
  std::sort(heights.begin(), heights.end());
  const double half = 0.5 * length;
  size_t k = 0;  // the last height with half of the envelope above it
  double longer = length;
  for (size_t next = 1; next < heights.size(); ++next) {
    const double part = above(heights[next]).first;
    if (part < half) {
      // the length above falls linearly between two heights
      const double share = longer > part ? (longer - half) / (longer - part) : 0.0;
      const double median = heights[k] + share * (heights[next] - heights[k]);
      return median + above(median).second / half;
    }
    k = next;
    longer = part;
  }
  return heights[k] + above(heights[k]).second / half;
}

// The height H at which the mean of max(z - H, -most) is zero: the mean height, in which tissue far
// below the rest counts as if it were `most` below. Newton's method from below: the mean is convex
// and falls with H.
double censored_mean(const std::vector<Stretch> &envelope, double length, double mean,
                     double most) {
  double height = mean;
  for (int k = 0; k < most_iterations; ++k) {
    double above = 0, excess = 0;  // the integral of max(z - (height - most), 0)
    for (const Stretch &s : envelope) {
      const auto [part, integral] = s.above(height - most);
      above += part;
      excess += integral;
    }
    const double step = (excess - most * length) / above;
    if (!(step > 1e-15)) break;
    height += step;
  }
  return height;
}

}  // namespace

void add_highest(const std::vector<const Section *> &layers, double from, double to,
                 std::vector<Stretch> &envelope, int depth) {
  const Section *left = layers[0], *right = layers[0];
  for (const Section *s : layers) {
    const double at_from = s->height(from), at_to = s->height(to);
    const double left_from = left->height(from), right_to = right->height(to);
    if (at_from > left_from || (at_from == left_from && at_to > left->height(to))) left = s;
    if (at_to > right_to || (at_to == right_to && at_from > right->height(from))) right = s;
  }
  const double above = left->height(from) - right->height(from),
               below = right->height(to) - left->height(to);
  double middle = from;
  if (left != right && depth < most_crossings && above + below > 0) {
    middle = from + above / (above + below) * (to - from);
  }
  if (!(middle > from && middle < to)) {
    envelope.push_back({to - from, left->height(from), right->height(to)});
    return;
  }
  add_highest(layers, from, middle, envelope, depth + 1);
  add_highest(layers, middle, to, envelope, depth + 1);
}

double limited_mean(const std::vector<Stretch> &envelope, double length, double most,
                    std::vector<double> &buffer) {
  double sum = 0;
  for (const Stretch &s : envelope) sum += s.integral();
  const double mean = sum / length, limited = censored_mean(envelope, length, mean, most);
  return limited > mean ? std::min(limited, mean_of_upper_half(envelope, length, buffer)) : mean;
}

}  // namespace mvs::core
