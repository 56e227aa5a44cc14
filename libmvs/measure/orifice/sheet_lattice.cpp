// Numbers of lattice points, a cut from the annulus to the free edge, and angles around the valve.
#include "measure/orifice/sheet_lattice.h"

#include <algorithm>
#include <cmath>

namespace mvs::core::orifice {
namespace {

constexpr double most_parts = 12;  // of a side

double mean_edge(const Model &model, const std::vector<Vec3> &x) {
  double sum = 0;
  for (const Edge &e : model.topology.edges) sum += (x[e[0]] - x[e[1]]).norm();
  return sum / static_cast<double>(model.topology.edges.size());
}

uint32_t parts_for(double edge, double spacing) {
  return static_cast<uint32_t>(std::clamp(std::ceil(edge / spacing), 1.0, most_parts));
}

// The corner of a triangle that is a node.
size_t corner_of(const Tri &triangle, uint32_t node) {
  return static_cast<size_t>(std::find(triangle.begin(), triangle.end(), node) - triangle.begin());
}

// The side of a triangle that is an edge.
size_t side_of(const Tri &edges, uint32_t edge) {
  return corner_of(edges, edge);
}

// A share of a turn as the nearest one to zero.
double wrapped(double turns) {
  return turns - std::floor(turns + 0.5);
}

}  // namespace

bool is_cylinder(const Model &model) {
  const Topology &topology = model.topology;
  const size_t triangles = model.valve.triangles.size();
  if (triangles == 0 || topology.free_edges.size() != 1) return false;
  size_t nodes = 0, border = 0;
  for (size_t v = 0; v + 1 < topology.node_triangles.start.size(); ++v) {
    nodes += topology.node_triangles.start[v + 1] > topology.node_triangles.start[v];
  }
  for (const Edge &t : topology.edge_triangles) border += t[1] == none;
  std::vector<uint8_t> seen(triangles, 0);
  const auto all = connected_triangles(topology, 0, seen, [](uint32_t) { return true; });
  const std::vector<uint32_t> &annulus = model.valve.annulus;
  for (size_t k = 0; k < annulus.size(); ++k) {
    const uint32_t e = edge_between(topology, annulus[k], annulus[(k + 1) % annulus.size()]);
    if (e == none || topology.edge_triangles[e][1] != none) return false;
  }
  return all.size() == triangles && nodes + triangles == topology.edges.size() &&
         border == annulus.size() + topology.free_edges[0].size();
}

SheetLattice::SheetLattice(const Model &model, const std::vector<Vec3> &x, double spacing)
    : model_(model),
      x_(x),
      n_(parts_for(mean_edge(model, x), spacing)),
      first_on_edge_(static_cast<uint32_t>(x.size())),
      first_inside_(first_on_edge_ + static_cast<uint32_t>(model.topology.edges.size()) * (n_ - 1)),
      turns_(model.valve.triangles.size(), {0, 0, 0}),
      angle_(model.valve.triangles.size()) {
  for (uint32_t i = 1; i < n_; ++i) {
    for (uint32_t j = 1; i + j < n_; ++j) inside_.push_back({i, j});
  }
  cut_open();
  spread_angles();
}

SheetLattice::Place SheetLattice::corner_place(uint32_t triangle, uint32_t node) const {
  Place place{triangle, {0, 0, 0}};
  place.share[corner_of(model_.valve.triangles[triangle], node)] = n_;
  return place;
}

// Points of an edge are numbered from its smaller node.
SheetLattice::Place SheetLattice::edge_place(uint32_t triangle, uint32_t v) const {
  const uint32_t edge = (v - first_on_edge_) / (n_ - 1),
                 along = 1 + (v - first_on_edge_) % (n_ - 1);
  const Tri &corners = model_.valve.triangles[triangle];
  const size_t a = side_of(model_.topology.triangle_edges[triangle], edge), b = (a + 1) % 3;
  Place place{triangle, {0, 0, 0}};
  const bool from_a = corners[a] < corners[b];
  place.share[a] = from_a ? n_ - along : along;
  place.share[b] = n_ - place.share[a];
  return place;
}

SheetLattice::Place SheetLattice::inside_place(uint32_t v) const {
  const uint32_t count = static_cast<uint32_t>(inside_.size()), k = v - first_inside_;
  const auto [i, j] = inside_[k % count];
  return {k / count, {i, j, n_ - i - j}};
}

uint32_t SheetLattice::number(const Place &place) const {
  const std::array<uint32_t, 3> &s = place.share;
  const Tri &corners = model_.valve.triangles[place.triangle];
  for (size_t k = 0; k < 3; ++k) {
    if (s[k] == n_) return corners[k];
  }
  for (size_t a = 0; a < 3; ++a) {
    const size_t b = (a + 1) % 3, c = (a + 2) % 3;
    if (s[c] != 0) continue;
    const uint32_t along = corners[a] < corners[b] ? s[b] : s[a];
    return first_on_edge_ + model_.topology.triangle_edges[place.triangle][a] * (n_ - 1) + along -
           1;
  }
  // rows of inside_ with first shares 1 to s[0] - 1 hold n - 2, n - 3, ... points
  const uint32_t before = (s[0] - 1) * (n_ - 2) - (s[0] - 1) * (s[0] - 2) / 2;
  return first_inside_ + place.triangle * static_cast<uint32_t>(inside_.size()) + before + s[1] - 1;
}

uint32_t SheetLattice::size() const {
  return first_inside_ + static_cast<uint32_t>(inside_.size() * model_.valve.triangles.size());
}

Vec3 SheetLattice::point(uint32_t v) const {
  if (v < first_on_edge_) return x_[v];
  if (v < first_inside_) {
    const Edge &e = model_.topology.edges[(v - first_on_edge_) / (n_ - 1)];
    const double along = static_cast<double>(1 + (v - first_on_edge_) % (n_ - 1)) / n_;
    return x_[e[0]] + along * (x_[e[1]] - x_[e[0]]);
  }
  const Place place = inside_place(v);
  const Tri &t = model_.valve.triangles[place.triangle];
  return (place.share[0] * x_[t[0]] + place.share[1] * x_[t[1]] + place.share[2] * x_[t[2]]) / n_;
}

// Points of a side count as its larger node, so that both triangles at a side agree.
int SheetLattice::turns_at(const Place &place) const {
  const Tri &corners = model_.valve.triangles[place.triangle];
  const std::array<int, 3> &turns = turns_[place.triangle];
  size_t at = 0;
  size_t zeros = 0;
  for (size_t k = 0; k < 3; ++k) zeros += place.share[k] == 0;
  if (zeros > 0) {
    at = place.share[0] > 0 ? 0 : place.share[1] > 0 ? 1 : 2;
    for (size_t k = 0; k < 3; ++k) {
      if (place.share[k] > 0 && corners[k] > corners[at]) at = k;
    }
  }
  return turns[at];
}

double SheetLattice::angle_at(const Place &place) const {
  const std::array<double, 3> &angle = angle_[place.triangle];
  return (place.share[0] * angle[0] + place.share[1] * angle[1] + place.share[2] * angle[2]) / n_;
}

// Chooses a strip of triangles from the annulus to the free edge by breadth-first search. Crossing
// the middle of the strip from right to left counts one turn: along the winding of each triangle,
// the side through which the strip enters has -1 and the one through which it leaves +1.
void SheetLattice::cut_open() {
  const Topology &topology = model_.topology;
  const std::vector<uint32_t> &annulus = model_.valve.annulus;
  const uint32_t entry = edge_between(topology, annulus[0], annulus[1]);
  const std::vector<uint32_t> &loop = topology.free_edges[0];
  const uint32_t exit = edge_between(topology, loop[0], loop[1]);
  const uint32_t first = topology.edge_triangles[entry][0], last = topology.edge_triangles[exit][0];
  std::vector<uint32_t> came_through(turns_.size(), none), queue = {last};
  came_through[last] = exit;
  for (size_t i = 0; i < queue.size() && came_through[first] == none; ++i) {
    for (const uint32_t e : topology.triangle_edges[queue[i]]) {
      for (const uint32_t t : topology.edge_triangles[e]) {
        if (t == none || came_through[t] != none) continue;
        came_through[t] = e;
        queue.push_back(t);
      }
    }
  }
  for (uint32_t t = first, in = entry; t != none;) {
    const uint32_t out = came_through[t];
    const size_t a = side_of(topology.triangle_edges[t], in), b = (a + 1) % 3, c = (a + 2) % 3;
    // side a, from corner a to b, has -1; the side that leaves is b to c or c to a
    const bool leaves_at_b = topology.triangle_edges[t][b] == out;
    turns_[t][a] = 0;
    turns_[t][b] = -1;
    turns_[t][c] = leaves_at_b ? 0 : -1;
    if (t == last) return;
    const Edge &both = topology.edge_triangles[out];
    t = both[0] == t ? both[1] : both[0];
    in = out;
  }
}

// Gives each node the mean angle of its neighbours nearer to the annulus, whose own nodes have
// angles by their order.
void SheetLattice::spread_angles() {
  const Topology &topology = model_.topology;
  const std::vector<uint32_t> &annulus = model_.valve.annulus;
  std::vector<double> angle(x_.size(), 0);
  std::vector<uint32_t> layer(x_.size(), none), queue = annulus;
  for (size_t k = 0; k < annulus.size(); ++k) {
    angle[annulus[k]] = static_cast<double>(k) / static_cast<double>(annulus.size());
    layer[annulus[k]] = 0;
  }
  const auto for_each_other = [&](uint32_t v, auto visit) {
    const Rows &around = topology.node_triangles;
    for (uint32_t i = around.start[v]; i < around.start[v + 1]; ++i) {
      for (const uint32_t w : model_.valve.triangles[around.items[i]]) visit(w);
    }
  };
  for (size_t i = 0; i < queue.size(); ++i) {
    const uint32_t v = queue[i];
    double sum = 0, count = 0, base = 0;
    for_each_other(v, [&](uint32_t w) {
      if (layer[w] == none) {
        layer[w] = layer[v] + 1;
        queue.push_back(w);
      }
      if (layer[w] >= layer[v]) return;
      if (count == 0) base = angle[w];
      sum += wrapped(angle[w] - base);
      ++count;
    });
    if (count > 0) angle[v] = base + sum / count;
  }
  for (size_t t = 0; t < angle_.size(); ++t) {
    const Tri &c = model_.valve.triangles[t];
    angle_[t] = {0, wrapped(angle[c[1]] - angle[c[0]]), wrapped(angle[c[2]] - angle[c[0]])};
  }
}

}  // namespace mvs::core::orifice
