// Best-first search over links, pairs of lattice points of the sheet that are no more than the
// contact thickness apart, for a closed sequence that goes around the valve.
#include "measure/orifice/seal.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <queue>
#include <tuple>

#include "measure/orifice/sheet_lattice.h"

namespace mvs::core::orifice {
namespace {

constexpr double spacing_of_seal = 0.5;  // of lattice points, in contact thicknesses
// Links up to this share of the contact thickness: the minimum cut rounds points to 0.1 um.
constexpr double longest_link = 0.999;
// Search steps for each step around the valve; a sealed valve needs about eight.
constexpr size_t effort = 16;

// A link from p to q, p < q; turns and angle of the way from p to q by which it was reached.
struct Link {
  uint32_t p, q;
  int turns;
  double angle;
};

// Hash table of links by their ends. Nothing is ever removed.
class LinkTable {
 public:
  explicit LinkTable(size_t most) : slot_(std::bit_ceil(2 * most + 2), none) {}
  // Returns the link with these ends, and adds it if the table lacks it.
  std::pair<uint32_t, bool> find_or_add(const Link &link) {
    const uint64_t key = uint64_t{link.p} << 32 | link.q;
    size_t at = (key * 0x9e3779b97f4a7c15u) >> 32;
    for (;; ++at) {
      uint32_t &slot = slot_[at & (slot_.size() - 1)];
      if (slot == none) {
        slot = static_cast<uint32_t>(links_.size());
        links_.push_back(link);
        return {slot, true};
      }
      if (links_[slot].p == link.p && links_[slot].q == link.q) return {slot, false};
    }
  }
  const Link &operator[](uint32_t k) const { return links_[k]; }
  size_t size() const { return links_.size(); }

 private:
  std::vector<uint32_t> slot_;
  std::vector<Link> links_;
};

// The neighbours of lattice points with their positions. A point is an end of many links, so that
// they are computed when it is met first, and kept.
class Neighbours {
 public:
  struct Step {
    SheetLattice::Step step;
    Vec3 point;  // where it leads
  };

  explicit Neighbours(const SheetLattice &lattice)
      : lattice_(lattice), range_(lattice.size(), {none, none}) {}

  // Calls visit(Step) as SheetLattice::for_each_neighbour does.
  template <typename Visit>
  void for_each(uint32_t v, Visit &&visit) {
    if (range_[v][0] == none) collect(v);
    for (uint32_t k = range_[v][0]; k < range_[v][1]; ++k) visit(steps_[k]);
  }

 private:
  void collect(uint32_t v) {
    range_[v][0] = static_cast<uint32_t>(steps_.size());
    lattice_.for_each_neighbour(v, [&](const SheetLattice::Step &step) {
      steps_.push_back({step, lattice_.point(step.to)});
    });
    range_[v][1] = static_cast<uint32_t>(steps_.size());
  }

  const SheetLattice &lattice_;
  std::vector<std::array<uint32_t, 2>> range_;  // of each point: its steps, once collected
  std::vector<Step> steps_;
};

class Zip {
 public:
  Zip(const SheetLattice &lattice, double longest, size_t most)
      : lattice_(lattice),
        neighbours_(lattice),
        longest2_(longest * longest),
        most_(most),
        table_(most + 64) {}

  // Starts from the link of a point with itself.
  void start(uint32_t v) { add({v, v, 0, 0}); }
  // Returns whether one of the links closes around the valve.
  bool run();

 private:
  void add(Link link);
  void move_end(const Link &link, const Vec3 &other);

  const SheetLattice &lattice_;
  Neighbours neighbours_;
  double longest2_;
  size_t most_;
  LinkTable table_;
  std::priority_queue<std::pair<double, uint32_t>> queue_;  // the widest angle first
  bool closed_ = false;
};

// A link that is reached on two ways with different turns closes around the valve. So does a point
// that is linked with itself by a way of at least one turn.
void Zip::add(Link link) {
  if (link.p > link.q) link = {link.q, link.p, -link.turns, -link.angle};
  if (link.p == link.q && link.turns != 0) closed_ = true;
  const auto [k, is_new] = table_.find_or_add(link);
  if (is_new) queue_.push({std::abs(link.angle), k});
  if (!is_new && table_[k].turns != link.turns) closed_ = true;
}

// Adds the links after one step of q. The triangle of p and this step is within half a contact
// thickness of the sheet: each of its points is between p and a point of the step.
void Zip::move_end(const Link &link, const Vec3 &p) {
  neighbours_.for_each(link.q, [&](const Neighbours::Step &next) {
    if ((next.point - p).squaredNorm() > longest2_) return;
    if (table_.size() >= most_) return;
    const SheetLattice::Step &step = next.step;
    add({link.p, step.to, link.turns + step.turns, link.angle + step.angle});
  });
}

bool Zip::run() {
  while (!queue_.empty() && !closed_ && table_.size() < most_) {
    const Link link = table_[queue_.top().second];
    queue_.pop();
    move_end(link, lattice_.point(link.p));
    move_end({link.q, link.p, -link.turns, -link.angle}, lattice_.point(link.q));
  }
  return closed_;
}

// Nodes where leaflets join, the commissures among them: there both curves begin. All nodes if the
// valve has one leaflet.
std::vector<uint32_t> seams(const Model &model) {
  const Rows &around = model.topology.node_triangles;
  std::vector<uint32_t> sheet, joining;
  for (uint32_t v = 0; v + 1 < around.start.size(); ++v) {
    if (around.start[v] == around.start[v + 1]) continue;
    sheet.push_back(v);
    const auto leaflet = [&](uint32_t i) { return model.valve.triangle_leaflet[around.items[i]]; };
    bool joins = false;
    for (uint32_t i = around.start[v]; i < around.start[v + 1]; ++i) {
      joins |= leaflet(i) != leaflet(around.start[v]);
    }
    if (joins) joining.push_back(v);
  }
  return joining.empty() ? sheet : joining;
}

}  // namespace

bool is_zipped(const Model &model, const std::vector<Vec3> &x) {
  if (!is_cylinder(model)) return false;
  const double seal = model.valve.contact_thickness, spacing = spacing_of_seal * seal;
  const SheetLattice lattice(model, x, spacing);
  double around = 0;
  const std::vector<uint32_t> &annulus = model.valve.annulus;
  for (size_t k = 0; k < annulus.size(); ++k) {
    around += (x[annulus[k]] - x[annulus[(k + 1) % annulus.size()]]).norm();
  }
  const size_t nodes = x.size();
  Zip zip(lattice, longest_link * seal,
          nodes + effort * static_cast<size_t>(std::clamp(around / spacing, 0.0, 1e5)));
  for (const uint32_t v : seams(model)) zip.start(v);
  return zip.run();
}

}  // namespace mvs::core::orifice
