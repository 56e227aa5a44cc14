#include "haptics/ticks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cli {
namespace {

// Upper ends of the histogram's rows, in nominal periods; the last row is unbounded.
constexpr std::array<double, 8> edges = {0.5, 0.9, 1.1, 1.5, 2, 5, 20, 100};

// Nearest-rank percentile: the smallest of the sorted values that at least this share does not
// exceed.
double percentile(const std::vector<double> &sorted, double share) {
  const double rank = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[std::min(sorted.size(), std::max<size_t>(1, static_cast<size_t>(rank))) - 1];
}

constexpr std::array<std::pair<const char *, double>, 4> shares = {
    {{"p50", 0.5}, {"p99", 0.99}, {"p99_9", 0.999}, {"max", 1}}};

Json percentiles_json(std::vector<double> seconds) {
  if (seconds.empty()) return {};
  std::sort(seconds.begin(), seconds.end());
  Json out = Json::object();
  for (const auto &[name, share] : shares) out[name] = 1e6 * percentile(seconds, share);
  return out;
}

std::string percentiles_text(const char *label, std::vector<double> seconds) {
  if (seconds.empty()) return text("  %-10s not measured\n", label);
  std::sort(seconds.begin(), seconds.end());
  std::string line = text("  %-10s", label);
  for (const auto &[name, share] : shares) {
    line += text("  %s %.1f us", share == 0.999 ? "p99.9" : name, 1e6 * percentile(seconds, share));
  }
  return line + "\n";
}

}  // namespace

void Ticks::take(const std::vector<mvs_device_sample> &samples, bool gap) {
  for (const mvs_device_sample &sample : samples) {
    if (count_ == 0) first_s_ = sample.time;
    if (count_ > 0 && !gap) {
      const double period = sample.time - last_s_;
      const double way = std::hypot(sample.position[0] - place_[0], sample.position[1] - place_[1],
                                    sample.position[2] - place_[2]);
      period_s_.push_back(period);
      if (period > 0) fastest_ = std::max(fastest_, way / period);
    }
    gap = false;
    std::copy(sample.position, sample.position + 3, place_.begin());
    if (sample.servo_s > 0) servo_s_.push_back(sample.servo_s);
    last_s_ = sample.time;
    ++count_;
  }
}

std::vector<size_t> Ticks::histogram() const {
  std::vector<size_t> rows(edges.size() + 1, 0);
  for (const double period : period_s_) {
    const auto edge = std::lower_bound(edges.begin(), edges.end(), period / nominal_s_);
    ++rows[edge - edges.begin()];
  }
  return rows;
}

Json Ticks::json() const {
  Json rows = Json::array();
  const std::vector<size_t> counts = histogram();
  for (size_t k = 0; k < counts.size(); ++k) {
    const double from = k == 0 ? 0 : edges[k - 1];
    rows.push_back({{"from_us", 1e6 * nominal_s_ * from},
                    {"to_us", k < edges.size() ? Json(1e6 * nominal_s_ * edges[k]) : Json()},
                    {"count", counts[k]}});
  }
  return {{"period_us", percentiles_json(period_s_)},
          {"servo_us", percentiles_json(servo_s_)},
          {"histogram", rows}};
}

std::string Ticks::text() const {
  std::string lines = percentiles_text("period", period_s_) + percentiles_text("servo", servo_s_);
  const std::vector<size_t> counts = histogram();
  for (size_t k = 0; k < counts.size(); ++k) {
    if (counts[k] == 0) continue;
    const std::string to =
        k < edges.size() ? cli::text("%8.0f", 1e6 * nominal_s_ * edges[k]) : "   more ";
    lines +=
        cli::text("  %8.0f to %s us %9zu %7.3f %%\n", k == 0 ? 0 : 1e6 * nominal_s_ * edges[k - 1],
                  to.c_str(), counts[k],
                  100.0 * static_cast<double>(counts[k]) / static_cast<double>(period_s_.size()));
  }
  return lines;
}

}  // namespace cli
