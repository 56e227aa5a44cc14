// Splits, flips and collapses (Botsch & Kobbelt 2004).
#include <algorithm>

#include "geometry/distance.h"
#include "patient/coordinates.h"
#include "patient/mesh/sheet_edit.h"

namespace mvs::core {
namespace {

// Cosines of the least angles that a flip or a collapse may leave, unless there were worse ones.
constexpr double flip_limit = 0.9659;      // cos 15 degrees
constexpr double collapse_limit = 0.9744;  // cos 13 degrees
// A gain in cosine, which keeps two equal diagonals from taking turns.
constexpr double flip_gain = 1e-6;
// Distance of the middle of an edge from the input that is accepted anyway, in wanted edges: that
// of an edge on a sphere with a radius of 2.5 edges is 0.05.
constexpr double off_input = 0.1;
// Distance from the middle of an edge over its length, up to which a place is the middle: positions
// of some cm are rounded to 1e-15 of it.
constexpr double at_middle = 1e-9;

uint32_t third_corner(const Tri &t, uint32_t a, uint32_t b) {
  for (const uint32_t corner : t) {
    if (corner != a && corner != b) return corner;
  }
  return none;
}

Tri with_corner(Tri t, uint32_t from, uint32_t to) {
  std::replace(t.begin(), t.end(), from, to);
  return t;
}

}  // namespace

bool SheetEditor::split(const Edge &edge) {
  const auto [a, b] = edge;
  const uint32_t t = mesh_.triangle_from(a, b), u = mesh_.triangle_from(b, a);
  const MeshVertex &va = mesh_.vertex[a], &vb = mesh_.vertex[b];
  const Vec3 middle = 0.5 * (mesh_.x[a] + mesh_.x[b]);
  MeshVertex v;
  Vec3 x;
  const bool on_rim = t == none || u == none;
  if (on_rim) {
    const RimCurve &curve = input_.curve(va.rim);
    const double way = va.after == b ? wrapped(vb.arc - va.arc, curve.length())
                                     : -wrapped(va.arc - vb.arc, curve.length());
    v.rim = va.rim;
    v.arc = wrapped(va.arc + 0.5 * way, curve.length());
    v.place = curve.place_at(v.arc);
    v.before = va.after == b ? a : b;
    v.after = va.after == b ? b : a;
    x = curve.at(v.arc);
  } else {
    const SurfacePlace from_a = input_.walk.closest_from(va.place, middle);
    const SurfacePlace from_b = input_.walk.closest_from(vb.place, middle);
    const Vec3 near_a = input_.walk.at(from_a), near_b = input_.walk.at(from_b);
    const bool take_a = (near_a - middle).squaredNorm() <= (near_b - middle).squaredNorm();
    v.place = take_a ? from_a : from_b;
    x = take_a ? near_a : near_b;
  }
  v.normal = input_.walk.normal_at(v.place);
  const auto m = static_cast<uint32_t>(mesh_.x.size());
  auto next = static_cast<uint32_t>(mesh_.triangles.size());
  SheetPatch patch;
  for (const uint32_t id : {t, u}) {
    if (id == none) continue;
    const Tri &tri = mesh_.triangles[id];
    patch.id.insert(patch.id.end(), {id, next++});
    patch.before.insert(patch.before.end(), {tri, Tri{none, none, none}});
    patch.after.insert(patch.after.end(), {with_corner(tri, b, m), with_corner(tri, a, m)});
  }
  const Look before = look_at(patch.before);
  mesh_.x.push_back(x);
  mesh_.vertex.push_back(v);
  mesh_.star.emplace_back();
  // halves of a triangle may be thinner than it: 1 accepts every angle
  const bool halves = (x - middle).norm() <= at_middle * mesh_.length(a, b);
  bool made = replace(patch, 1, halves ? Change::halve : Change::split, before);
  if (!made && !on_rim) {
    mesh_.x[m] = middle;  // as the triangles are, whichever way they face
    made = replace(patch, 1, Change::halve, before);
  }
  if (!made) {
    mesh_.x.pop_back();
    mesh_.vertex.pop_back();
    mesh_.star.pop_back();
  } else if (on_rim) {
    mesh_.vertex[v.before].after = m;
    mesh_.vertex[v.after].before = m;
  }
  return made;
}

uint32_t SheetEditor::valence(uint32_t v) const {
  const auto triangles = static_cast<uint32_t>(mesh_.star[v].size());
  return mesh_.vertex[v].rim == Rim::inside ? triangles : triangles + 1;
}

// Distance of the middle of two vertices from the input, by walks from both.
double SheetEditor::distance_of_middle(uint32_t a, uint32_t b) const {
  const Vec3 middle = 0.5 * (mesh_.x[a] + mesh_.x[b]);
  const auto from = [&](uint32_t v) {
    const SurfaceWalk &walk = input_.walk;
    return (walk.at(walk.closest_from(mesh_.vertex[v].place, middle)) - middle).squaredNorm();
  };
  return std::sqrt(std::min(from(a), from(b)));
}

bool SheetEditor::flip(const Edge &edge, EditFor reason) {
  const auto [a, b] = edge;
  const uint32_t t = mesh_.triangle_from(a, b), u = mesh_.triangle_from(b, a);
  if (t == none || u == none) return false;
  const uint32_t c = third_corner(mesh_.triangles[t], a, b);
  const uint32_t d = third_corner(mesh_.triangles[u], a, b);
  const Rim rim_c = mesh_.vertex[c].rim, rim_d = mesh_.vertex[d].rim;
  if (rim_c != Rim::inside && rim_c == rim_d) return false;
  const auto excess = [&](uint32_t v, int change) {
    const int wanted = mesh_.vertex[v].rim == Rim::inside ? 6 : 4;
    const int off = static_cast<int>(valence(v)) + change - wanted;
    return off * off;
  };
  if (reason == EditFor::spacing) {
    const int now = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
    const int then = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
    if (then >= now) return false;
  }
  const std::array<Tri, 2> made = {Tri{a, d, c}, Tri{d, b, c}};
  const auto worst_of = [&](const std::array<Tri, 2> &pair) {
    const auto cosine = [&](const Tri &tri) {
      return worst_cosine(mesh_.x[tri[0]], mesh_.x[tri[1]], mesh_.x[tri[2]]);
    };
    return std::max(cosine(pair[0]), cosine(pair[1]));
  };
  const double worst = worst_of({mesh_.triangles[t], mesh_.triangles[u]});
  const double limit = reason == EditFor::angle ? worst - flip_gain : std::max(flip_limit, worst);
  if (worst_of(made) > limit || mesh_.are_joined(c, d)) return false;
  SheetPatch patch;
  patch.id = {t, u};
  patch.before = {mesh_.triangles[t], mesh_.triangles[u]};
  patch.after = {made[0], made[1]};
  const double off = distance_of_middle(c, d);
  if (off > off_input * edge_ && off > distance_of_middle(a, b)) return false;
  return replace(patch, limit, Change::flip, look_at(patch.before));
}

// Whether a collapse of a into b leaves a manifold with two rims: the link condition (Dey,
// Edelsbrunner, Guha, Nekhayev 1999), and a rim vertex goes along its rim only.
bool SheetEditor::may_merge(uint32_t a, uint32_t b) const {
  const uint32_t t = mesh_.triangle_from(a, b), u = mesh_.triangle_from(b, a);
  const bool on_rim = t == none || u == none;
  if (mesh_.vertex[a].rim != Rim::inside && !on_rim) return false;
  std::vector<uint32_t> common;
  for (const uint32_t s : mesh_.star[a]) {
    for (const uint32_t v : mesh_.triangles[s]) {
      if (v != a && v != b && mesh_.are_joined(v, b)) common.push_back(v);
    }
  }
  std::sort(common.begin(), common.end());
  common.erase(std::unique(common.begin(), common.end()), common.end());
  return common.size() == (on_rim ? 1 : 2);
}

bool SheetEditor::collapse(uint32_t a, uint32_t b, double longest, EditFor reason) {
  if (!may_merge(a, b)) return false;
  SheetPatch patch = star_of(a);
  double off_before = off_input * edge_, off_after = 0;
  for (Tri &t : patch.after) {
    const bool gone = std::find(t.begin(), t.end(), b) != t.end();
    for (const uint32_t v : t) {
      if (gone || v == a) continue;
      if (mesh_.length(v, b) > longest) return false;
      off_before = std::max(off_before, distance_of_middle(a, v));
      off_after = std::max(off_after, distance_of_middle(b, v));
    }
    t = gone ? Tri{none, none, none} : with_corner(t, a, b);
  }
  if (off_after > off_before) return false;
  const MeshVertex old = mesh_.vertex[a];
  if (old.rim != Rim::inside) {
    const RimCurve &curve = input_.curve(old.rim);
    const uint32_t far = old.after == b ? old.before : old.after;
    if (std::abs(around(mesh_.vertex[far].arc, mesh_.vertex[b].arc, curve.length())) > longest) {
      return false;
    }
  }
  const Look before = look_at(patch.before);
  const double limit =
      reason == EditFor::angle ? before.worst - flip_gain : std::max(collapse_limit, before.worst);
  if (!replace(patch, limit, Change::star, before)) return false;
  if (old.rim != Rim::inside) {
    mesh_.vertex[old.before].after = old.after;
    mesh_.vertex[old.after].before = old.before;
  }
  return true;
}

bool SheetEditor::cut_corner(uint32_t v, double longest) {
  const MeshVertex old = mesh_.vertex[v];
  if (old.rim == Rim::inside || mesh_.star[v].size() != 2) return false;
  const uint32_t p = old.before, q = old.after;
  uint32_t w = none;  // behind the vertex: the corner that its two triangles share
  for (const uint32_t corner : mesh_.triangles[mesh_.star[v][0]]) {
    if (corner != v && corner != p && corner != q) w = corner;
  }
  if (w == none || mesh_.vertex[w].rim != Rim::inside || mesh_.star[w].size() != 3) return false;
  if (mesh_.vertex[p].before == q) return false;  // a rim of three sides
  const double way =
      around(mesh_.vertex[p].arc, mesh_.vertex[q].arc, input_.curve(old.rim).length());
  const double limit = off_input * edge_;
  if (std::abs(way) > longest ||
      closest_on_segment(mesh_.x[v], mesh_.x[p], mesh_.x[q]).distance2 > limit * limit) {
    return false;
  }
  SheetPatch patch = star_of(w);
  std::fill(patch.after.begin(), patch.after.end(), Tri{none, none, none});
  commit(patch);
  mesh_.vertex[p].after = q;
  mesh_.vertex[q].before = p;
  return true;
}

}  // namespace mvs::core
