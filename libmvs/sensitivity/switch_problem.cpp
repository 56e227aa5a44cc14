// Active set inside Newton's method, with a dense factor of as many rows as there are switches.
#include "sensitivity/switch_problem.h"

#include <algorithm>
#include <cmath>

#include "energy/barrier.h"
#include "sensitivity/dense_factor.h"
#include "sensitivity/settings.h"

namespace mvs::core {
namespace {

namespace set = settings::sensitivity;

// Force and stiffness of contact that begins, at a depth.
struct Push {
  double force, stiffness;
};
Push push_at(const Switch &s, double depth) {
  if (depth <= 0) return {0, 0};
  const Barrier b = barrier(1 - depth / s.range);
  return {-s.strength * b.first, s.strength / s.range * b.second};
}

// t = offset + slope u, by the side of u.
struct Branch {
  double offset = 0, up = 0, down = 0;
};

std::vector<Branch> branches_at(const std::vector<Switch> &switches, const std::vector<double> &u,
                                double step) {
  std::vector<Branch> list;
  for (size_t i = 0; i < switches.size(); ++i) {
    const Switch &s = switches[i];
    if (!s.begins()) {
      list.push_back({0, s.up, s.down});
      continue;
    }
    const double slope = push_at(s, s.over + step * u[i]).stiffness - push_at(s, s.over).stiffness;
    list.push_back({extra_force(s, step * u[i]) / step - slope * u[i], slope, slope});
  }
  return list;
}

// u of the switches in these states.
std::vector<double> rates_in(const std::vector<Branch> &branches, const std::vector<uint8_t> &grows,
                             const std::vector<double> &flexibility,
                             const std::vector<double> &rates) {
  const size_t m = rates.size();
  std::vector<double> a(m * m, 0), u = rates;
  for (size_t i = 0; i < m; ++i) {
    for (size_t j = 0; j < m; ++j) {
      const double slope = grows[j] ? branches[j].up : branches[j].down;
      a[i * m + j] = flexibility[i * m + j] * slope + (i == j ? 1.0 : 0.0);
      u[i] -= flexibility[i * m + j] * branches[j].offset;
    }
  }
  const DenseFactor factor(m, std::move(a));
  if (!factor.is_regular()) return {};
  factor.solve(u);
  return u;
}

// The rates of consistent states, or an empty list.
std::vector<double> active_set(const std::vector<Branch> &branches,
                               const std::vector<double> &flexibility,
                               const std::vector<double> &rates) {
  const size_t m = rates.size();
  std::vector<uint8_t> grows(m);
  for (size_t i = 0; i < m; ++i) grows[i] = rates[i] > 0;
  for (int change = 0; change < set::most_state_changes; ++change) {
    std::vector<double> u = rates_in(branches, grows, flexibility, rates);
    if (u.empty()) return u;
    bool is_consistent = true;
    for (size_t i = 0; i < m; ++i) {
      if ((u[i] > 0) == (grows[i] != 0) || branches[i].up == branches[i].down) continue;
      is_consistent = false;
      grows[i] ^= 1;
      if (change >= set::block_changes) break;
    }
    if (is_consistent) return u;
  }
  return {};
}

// The largest rate while contact that begins does not push.
double fastest_without_begins(const std::vector<Switch> &switches,
                              const std::vector<double> &flexibility,
                              const std::vector<double> &rates) {
  std::vector<Branch> open;
  for (const Switch &s : switches) {
    const double now = s.begins() ? push_at(s, s.over).stiffness : 0;
    open.push_back(s.begins() ? Branch{0, -now, -now} : Branch{0, s.up, s.down});
  }
  double fastest = 0;
  for (const double rate : active_set(open, flexibility, rates)) {
    fastest = std::max(fastest, std::abs(rate));
  }
  return fastest;
}

}  // namespace

double extra_force(const Switch &s, double by) {
  if (s.begins()) {
    const Push now = push_at(s, s.over);
    return push_at(s, s.over + by).force - now.force - now.stiffness * by;
  }
  const double u = s.over + by;
  return (u > 0 ? s.up : s.down) * u;
}

std::vector<double> extra_forces(const std::vector<Switch> &switches,
                                 const std::vector<double> &flexibility,
                                 const std::vector<double> &rates, double travel) {
  const double fastest = fastest_without_begins(switches, flexibility, rates);
  std::vector<double> t(switches.size(), 0);
  if (!(fastest > 0)) return t;
  const double step = travel / fastest;
  std::vector<double> u = rates;
  for (int iteration = 0; iteration < set::newton_iterations; ++iteration) {
    const std::vector<Branch> branches = branches_at(switches, u, step);
    const std::vector<double> next = active_set(branches, flexibility, rates);
    if (next.empty()) return {};
    double change = 0;
    for (size_t i = 0; i < u.size(); ++i) {
      const Branch &b = branches[i];
      t[i] = b.offset + (next[i] > 0 ? b.up : b.down) * next[i];
      change = std::max(change, switches[i].begins() ? std::abs(next[i] - u[i]) : 0);
    }
    u = next;
    if (change <= set::newton_tolerance * fastest) return t;
  }
  return {};
}

}  // namespace mvs::core
