// Groups of idle branch points that chordae join are moved together, or not at all.
#include "sensitivity/idle_branches.h"

#include "model/chord_law.h"

namespace mvs::core {
namespace {

constexpr int sweeps = 200;

class IdleBranches {
 public:
  IdleBranches(const Model &model, double tolerance, std::vector<Vec3> &x)
      : model_(model), x_(x), is_idle_(x.size(), 0) {
    for (uint32_t i = 0; i < x.size(); ++i) {
      if (model.topology.node_kind[i] != NodeKind::branch) continue;
      is_idle_[i] = 1;
      for_each_chord(i, [&](const Chord &chord) {
        const double strain = length(chord) / chord.rest_length - 1;
        if (chord_tension(model.valve, chord, strain) > tolerance) is_idle_[i] = 0;
      });
    }
  }

  bool slacken(double margin) {
    bool moved = false;
    for (uint32_t i = 0; i < x_.size(); ++i) {
      if (is_idle_[i]) moved = slacken_group(group_of(i), margin) || moved;
    }
    return moved;
  }

 private:
  template <typename Use>
  void for_each_chord(uint32_t node, Use use) const {
    const Rows &rows = model_.topology.node_chords;
    for (uint32_t k = rows.start[node]; k < rows.start[node + 1]; ++k) {
      use(model_.valve.chords[rows.items[k]]);
    }
  }
  double length(const Chord &chord) const { return (x_[chord.b] - x_[chord.a]).norm(); }

  // The idle points that chordae join to one; takes them out of the list.
  std::vector<uint32_t> group_of(uint32_t first) {
    std::vector<uint32_t> group = {first};
    is_idle_[first] = 0;
    for (size_t k = 0; k < group.size(); ++k) {
      const uint32_t node = group[k];
      for_each_chord(node, [&](const Chord &chord) {
        const uint32_t other = chord.other_end(node);
        if (!is_idle_[other]) return;
        is_idle_[other] = 0;
        group.push_back(other);
      });
    }
    return group;
  }

  // The largest length above the rest length less the margin.
  double excess(const std::vector<uint32_t> &group, double margin) const {
    double most = -1;
    for (const uint32_t node : group) {
      for_each_chord(node, [&](const Chord &chord) {
        most = std::max(most, length(chord) - (chord.rest_length - margin));
      });
    }
    return most;
  }

  // Moves each point by the mean of the excesses of its chordae, towards their other ends.
  bool slacken_group(const std::vector<uint32_t> &group, double margin) {
    std::vector<Vec3> before;
    before.reserve(group.size());
    for (const uint32_t node : group) before.push_back(x_[node]);
    if (excess(group, margin) <= 0) return false;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      for (const uint32_t node : group) {
        Vec3 sum = Vec3::Zero();
        int pulls = 0;
        for_each_chord(node, [&](const Chord &chord) {
          const double over = length(chord) - (chord.rest_length - 2 * margin);
          if (over <= 0) return;
          sum += over * (x_[chord.other_end(node)] - x_[node]).normalized();
          ++pulls;
        });
        if (pulls > 0) x_[node] += sum / pulls;
      }
      if (excess(group, margin) <= 0) return true;
    }
    for (size_t k = 0; k < group.size(); ++k) x_[group[k]] = before[k];
    return false;
  }

  const Model &model_;
  std::vector<Vec3> &x_;
  std::vector<uint8_t> is_idle_;
};

}  // namespace

bool slacken_idle_branches(const Model &model, double tolerance, double margin,
                           std::vector<Vec3> &x) {
  return IdleBranches(model, tolerance, x).slacken(margin);
}

}  // namespace mvs::core
