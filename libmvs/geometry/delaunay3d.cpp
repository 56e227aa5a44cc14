// Incremental insertion in integer arithmetic.
#include "geometry/delaunay3d.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/types.h"
#include "geometry/edge_table.h"
#include "geometry/lattice_predicates.h"
#include "geometry/sphere_side.h"

namespace mvs::core {
namespace {

// Returns the Morton code of a point: the interleaved bits of its coordinates.
uint64_t z_order(const LatticePoint &p) {
  uint64_t code = 0;
  for (int bit = 20; bit >= 0; --bit) {
    for (int k = 0; k < 3; ++k) code = code << 1 | ((p[k] >> bit) & 1);
  }
  return code;
}

// Half of the points form the last round, a quarter the one before, and so on, by a fixed shuffle.
std::vector<uint32_t> insertion_order(const std::vector<LatticePoint> &points) {
  struct Key {
    uint32_t round, point;
    uint64_t z;
  };
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (uint32_t i = 0; i < points.size(); ++i) {
    const uint32_t shuffled = (i + 1) * 0x9e3779b1u;
    const uint32_t early = std::min(std::countl_zero(shuffled ^ (shuffled << 15)), 12);
    keys.push_back({12 - early, i, z_order(points[i])});
  }
  std::sort(keys.begin(), keys.end(), [](const Key &a, const Key &b) {
    return std::tie(a.round, a.z, a.point) < std::tie(b.round, b.z, b.point);
  });
  std::vector<uint32_t> order;
  order.reserve(keys.size());
  for (const Key &key : keys) order.push_back(key.point);
  return order;
}

class DelaunayBuilder {
 public:
  explicit DelaunayBuilder(const std::vector<LatticePoint> &points);

  // Inserts a vertex. Returns it, or an earlier one in the same place.
  uint32_t insert(uint32_t vertex);
  std::vector<Tetrahedron> finish();

 private:
  struct CavityFacet {
    std::array<uint32_t, 4> corner;  // the new vertex at `place`
    uint32_t place;
    uint32_t outside;  // the tetrahedron on the other side, or `none`,
    uint32_t back;     // and its face
  };

  const LatticePoint &at(uint32_t vertex) const { return point_[vertex]; }
  uint32_t locate(const LatticePoint &p);
  bool sphere_has(const std::array<uint32_t, 4> &corner, uint32_t vertex) const;
  void find_cavity(uint32_t start, uint32_t vertex);
  void fill_cavity();
  uint32_t vacancy();
  void join_outside(const CavityFacet &facet, uint32_t t);
  void join_inside(const CavityFacet &facet, uint32_t t);
  uint32_t number_in_cavity(uint32_t vertex);

  std::vector<LatticePoint> point_;
  std::vector<SpherePoint> for_sphere_;  // the same
  std::vector<Tetrahedron> tetrahedra_;
  // A number for each tetrahedron: 2 * insertion, + 1 if its sphere has the vertex.
  std::vector<uint64_t> seen_;
  uint64_t insertion_ = 0;
  uint32_t last_ = 0;
  std::vector<uint32_t> cavity_, vacant_;
  std::vector<CavityFacet> facets_;
  EdgeTable table_;
  // For each vertex, the last insertion with it on the cavity, and its number there.
  std::vector<uint64_t> on_cavity_;
  std::vector<uint32_t> number_;
  uint32_t numbers_ = 0;
};

// Divides the box into six tetrahedra around its diagonal.
DelaunayBuilder::DelaunayBuilder(const std::vector<LatticePoint> &points) : point_(points) {
  const uint32_t first = static_cast<uint32_t>(points.size());
  for (int k = 0; k < 8; ++k) {
    point_.push_back(
        {(k & 1) * lattice_size, (k >> 1 & 1) * lattice_size, (k >> 2 & 1) * lattice_size});
  }
  for (const LatticePoint &p : point_) {
    for_sphere_.push_back({{double(p[0]), double(p[1]), double(p[2]), 0}});
  }
  const std::array<uint32_t, 6> around = {1, 3, 2, 6, 4, 5};
  for (uint32_t k = 0; k < 6; ++k) {
    const uint32_t after = (k + 1) % 6, before = (k + 5) % 6;
    // faces opposite the two ends of the diagonal lie on the box
    tetrahedra_.push_back({{first, first + around[k], first + around[after], first + 7},
                           {none, after, before, none}});
  }
  seen_.assign(tetrahedra_.size(), 0);
  on_cavity_.assign(point_.size(), 0);
  number_.assign(point_.size(), 0);
}

// Visibility walk: moves to the neighbour across a face that separates from p.
uint32_t DelaunayBuilder::locate(const LatticePoint &p) {
  uint32_t t = last_, came_from = none;
  for (uint32_t turn = 0;; ++turn) {
    const Tetrahedron &here = tetrahedra_[t];
    uint32_t next = none;
    for (uint32_t j = 0; j < 4 && next == none; ++j) {
      const uint32_t k = (j + turn) % 4;  // the rotation prevents cycles
      if (here.neighbour[k] == came_from || here.neighbour[k] == none) continue;
      std::array<uint32_t, 4> c = here.corner;
      const auto corner = [&](uint32_t i) -> const LatticePoint & { return i == k ? p : at(c[i]); };
      if (volume(corner(0), corner(1), corner(2), corner(3)) < 0) next = here.neighbour[k];
    }
    if (next == none) return t;
    came_from = t;
    t = next;
  }
}

// Whether the sphere through these corners has a vertex strictly inside.
bool DelaunayBuilder::sphere_has(const std::array<uint32_t, 4> &c, uint32_t vertex) const {
  const SphereSide side = sphere_side(for_sphere_[c[0]], for_sphere_[c[1]], for_sphere_[c[2]],
                                      for_sphere_[c[3]], for_sphere_[vertex]);
  if (side != SphereSide::unknown) return side == SphereSide::inside;
  return in_sphere(at(c[0]), at(c[1]), at(c[2]), at(c[3]), at(vertex));
}

// Finds the cavity: all tetrahedra whose sphere has the vertex, and the faces around them.
void DelaunayBuilder::find_cavity(uint32_t start, uint32_t vertex) {
  ++insertion_;
  cavity_.assign(1, start);
  facets_.clear();
  seen_[start] = 2 * insertion_ + 1;
  for (size_t i = 0; i < cavity_.size(); ++i) {
    const Tetrahedron here = tetrahedra_[cavity_[i]];
    for (uint32_t k = 0; k < 4; ++k) {
      const uint32_t n = here.neighbour[k];
      if (n != none && seen_[n] < 2 * insertion_) {
        const bool hit = sphere_has(tetrahedra_[n].corner, vertex);
        seen_[n] = 2 * insertion_ + hit;
        if (hit) cavity_.push_back(n);
      }
      if (n != none && seen_[n] == 2 * insertion_ + 1) continue;
      CavityFacet &facet = facets_.emplace_back();
      facet = {here.corner, k, n, 0};
      facet.corner[k] = vertex;
      if (n == none) continue;
      const std::array<uint32_t, 4> &around = tetrahedra_[n].neighbour;
      while (around[facet.back] != cavity_[i]) ++facet.back;
    }
  }
}

// Returns the index for a new tetrahedron: one of the cavity, as long as there are any.
uint32_t DelaunayBuilder::vacancy() {
  if (vacant_.empty()) {
    tetrahedra_.emplace_back();
    seen_.push_back(0);
    return static_cast<uint32_t>(tetrahedra_.size() - 1);
  }
  const uint32_t t = vacant_.back();
  vacant_.pop_back();
  seen_[t] = 0;
  return t;
}

// Links the new tetrahedron of a facet with the old one outside.
void DelaunayBuilder::join_outside(const CavityFacet &facet, uint32_t t) {
  tetrahedra_[t].neighbour[facet.place] = facet.outside;
  if (facet.outside != none) tetrahedra_[facet.outside].neighbour[facet.back] = t;
}

uint32_t DelaunayBuilder::number_in_cavity(uint32_t vertex) {
  if (on_cavity_[vertex] != insertion_) {
    on_cavity_[vertex] = insertion_;
    number_[vertex] = numbers_++;
  }
  return number_[vertex];
}

// Links it with the new ones across the edges of the facet that exist already.
void DelaunayBuilder::join_inside(const CavityFacet &facet, uint32_t t) {
  constexpr std::array<std::array<uint32_t, 3>, 4> others = {
      {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}};
  const std::array<uint32_t, 3> &face = others[facet.place];
  const uint32_t a = number_in_cavity(facet.corner[face[0]]);
  const uint32_t b = number_in_cavity(facet.corner[face[1]]);
  const uint32_t c = number_in_cavity(facet.corner[face[2]]);
  const auto join = [&](uint32_t from, uint32_t to, uint32_t k) {
    const EdgeTable::Side *other = table_.match(from, to, t, k);
    if (other == nullptr) return;
    tetrahedra_[t].neighbour[k] = other->tetrahedron;
    tetrahedra_[other->tetrahedron].neighbour[other->face] = t;
  };
  join(b, c, face[0]);
  join(a, c, face[1]);
  join(a, b, face[2]);
}

void DelaunayBuilder::fill_cavity() {
  vacant_.insert(vacant_.end(), cavity_.begin(), cavity_.end());
  numbers_ = 0;
  table_.clear(facets_.size() / 2 + 2);  // vertices of a triangulated sphere
  for (const CavityFacet &facet : facets_) {
    last_ = vacancy();
    tetrahedra_[last_].corner = facet.corner;
    join_outside(facet, last_);
    join_inside(facet, last_);
  }
}

uint32_t DelaunayBuilder::insert(uint32_t vertex) {
  const uint32_t start = locate(at(vertex));
  for (const uint32_t corner : tetrahedra_[start].corner) {
    const LatticePoint &p = at(corner), &q = at(vertex);
    if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return corner;
  }
  find_cavity(start, vertex);
  fill_cavity();
  return vertex;
}

// Removes the unused tetrahedra.
std::vector<Tetrahedron> DelaunayBuilder::finish() {
  std::vector<uint32_t> number(tetrahedra_.size(), 0);
  for (const uint32_t t : vacant_) number[t] = none;
  uint32_t count = 0;
  for (uint32_t &n : number) {
    if (n != none) n = count++;
  }
  std::vector<Tetrahedron> kept;
  kept.reserve(count);
  for (size_t t = 0; t < tetrahedra_.size(); ++t) {
    if (number[t] == none) continue;
    kept.push_back(tetrahedra_[t]);
    for (uint32_t &n : kept.back().neighbour) {
      if (n != none) n = number[n];
    }
  }
  return kept;
}

}  // namespace

Delaunay delaunay(const std::vector<LatticePoint> &points) {
  DelaunayBuilder builder(points);
  Delaunay result;
  result.stands_for.resize(points.size());
  for (const uint32_t i : insertion_order(points)) result.stands_for[i] = builder.insert(i);
  result.tetrahedra = builder.finish();
  return result;
}

}  // namespace mvs::core
