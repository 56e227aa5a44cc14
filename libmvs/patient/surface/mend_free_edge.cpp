// Pairs of vertices of the free edge with a short straight line and a long way along the edge.
#include "patient/surface/mend_free_edge.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/sides.h"
#include "patient/findings.h"
#include "patient/surface/fill_hole.h"

namespace mvs::core {
namespace {

// The way along the edge over the straight line from which on it is a notch: a missing triangle has
// 2, a missing square 3. The dip of a normal free edge at a commissure has 1.4 and stays, unless
// the edge is torn, with three sharp notches or more: then the edge between tears is no shape of
// the leaflet, and valleys may be tears as well.
constexpr double sharp_detour = 1.5, gentle_detour = 1.2;
constexpr size_t sharp_of_torn = 3;
// m: vertices of a cleft up to this far above its deepest one are its bottom.
constexpr double bottom_height = 0.3e-3;
// A valley of the edge is seen by straight lines up to this length, half as long again as the mouth
// of a notch: a notch is no deeper there. Straight sides with the detour of a notch are 0.56 of the
// line deep.
constexpr double widest_valley = 1.5 * widest_notch, valley_depth = 0.5;
// m: the edge beyond both ends of a notch is looked at so far. Where it goes on outward on both
// sides, by this share of the depth, the bottom is that of a wider valley: the one at a commissure,
// which a torn edge has as well. The edge beside a tear goes on along its mouth.
constexpr double shoulder = 4e-3, rising = 0.4;
constexpr size_t most_vertices = 60;  // of a notch; three voxels a mm over 20 mm
// Along the edge: 13 mm deep. A cleft of a coarse edge may be longer, so that the corner of a
// narrow orifice is one.
constexpr double longest_valley = 3 * widest_valley;

struct Notch {
  size_t first = 0, count = 0;  // in the loop: the ends and the vertices between
  double saved = 0;             // m: way along the edge less the straight line
  double width = 0, depth = 0;  // m
};

class NotchedRim {
 public:
  // Vertices that are `kept` stay on the edge. A torn edge has gentle notches as well.
  NotchedRim(LeafletSheet &sheet, std::vector<uint32_t> &loop, std::vector<uint8_t> kept,
             bool is_torn)
      : sheet_(sheet),
        loop_(loop),
        detour_(is_torn ? gentle_detour : sharp_detour),
        is_torn_(is_torn),
        kept_(std::move(kept)),
        normal_(sheet.x.size(), Vec3::Zero()) {
    for (const Tri &t : sheet.triangles) {
      const Vec3 n = (sheet.x[t[1]] - sheet.x[t[0]]).cross(sheet.x[t[2]] - sheet.x[t[0]]);
      for (const uint32_t i : t) normal_[i] += n;
    }
    for (const Side &side : sorted_sides(sheet.triangles)) edges_.push_back(side.edge);
    keep_clefts();
  }

  // The notch that shortens the edge most; without any, `count` is 0.
  Notch largest() const {
    Notch best;
    for (size_t k = 0; k < loop_.size(); ++k) {
      const Notch here = from(k);
      if (here.saved > best.saved) best = here;
    }
    return best;
  }

  // Returns the vertices that are no longer on the edge.
  std::vector<uint32_t> fill(const Notch &notch) {
    std::vector<uint32_t> ring;
    for (size_t k = 0; k < notch.count; ++k) ring.push_back(vertex(notch.first + k));
    const std::vector<uint32_t> mouth = divide_mouth(notch);
    ring.insert(ring.end(), mouth.rbegin(), mouth.rend());
    const size_t before = sheet_.triangles.size();
    fill_hole(sheet_, ring);
    for (size_t t = before; t < sheet_.triangles.size(); ++t) {
      const Tri &tri = sheet_.triangles[t];
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t a = tri[k], b = tri[(k + 1) % 3];
        edges_.push_back({std::min(a, b), std::max(a, b)});
      }
    }
    std::sort(edges_.begin(), edges_.end());
    normal_.resize(sheet_.x.size(), Vec3::Zero());
    std::vector<uint32_t> kept;
    for (size_t k = notch.count - 1; k <= loop_.size(); ++k)
      kept.push_back(vertex(notch.first + k));
    kept.insert(kept.end(), mouth.begin(), mouth.end());
    loop_ = std::move(kept);
    return {ring.begin() + 1, ring.end() - static_cast<std::ptrdiff_t>(mouth.size()) - 1};
  }

 private:
  // New vertices on the straight line over a notch, from its first to its last, about as far apart
  // as those of the notch. On a mouth of one side, 50 times as long as the others, halving put
  // vertex after vertex: triangles without height, whose folds stayed in every mesh made from them.
  // They are fewer than the vertices that leave the edge, so that filling ends.
  std::vector<uint32_t> divide_mouth(const Notch &notch) {
    const uint32_t a = vertex(notch.first), b = vertex(notch.first + notch.count - 1);
    const double side = (notch.width + notch.saved) / static_cast<double>(notch.count - 1);
    const auto nearest = static_cast<size_t>(std::floor(notch.width / side + 0.5));
    const size_t sides = std::min(nearest, notch.count - 2);
    std::vector<uint32_t> made;
    for (size_t k = 1; k < sides; ++k) {
      const double to_b = static_cast<double>(k) / static_cast<double>(sides), to_a = 1 - to_b;
      made.push_back(static_cast<uint32_t>(sheet_.x.size()));
      sheet_.x.push_back(Vec3(to_a * sheet_.x[a] + to_b * sheet_.x[b]));
      normal_.push_back(Vec3(to_a * normal_[a] + to_b * normal_[b]));
      if (sheet_.thickness.empty()) continue;
      sheet_.thickness.push_back(to_a * sheet_.thickness[a] + to_b * sheet_.thickness[b]);
    }
    return made;
  }

  bool stays(uint32_t i) const { return i < kept_.size() && kept_[i] != 0; }
  uint32_t vertex(size_t k) const { return loop_[k % loop_.size()]; }
  const Vec3 &at(size_t k) const { return sheet_.x[vertex(k)]; }

  // The best notch that begins at a place of the loop.
  Notch from(size_t first) const {
    Notch best;
    double way = 0;
    Vec3 normal = normal_[vertex(first)];
    const size_t most = std::min(most_vertices, loop_.size() - 3);
    for (size_t step = 1; step <= most; ++step) {
      way += (at(first + step) - at(first + step - 1)).norm();
      normal += normal_[vertex(first + step)];
      const double width = (at(first + step) - at(first)).norm();
      if (step < 2 || width > widest_notch || way < detour_ * width) continue;
      if (way - width <= best.saved) continue;
      Notch notch{first, step + 1, way - width, width, 0};
      if (!is_inward(notch, normal) || notch.depth > deepest_notch) continue;
      if (!is_in_valley(notch, normal)) best = notch;
    }
    return best;
  }

  // Whether the vertices between lie on the side of the tissue, not too deep, and the mouth is no
  // edge yet. The tissue is on the left of the edge, seen from the tip of the normal.
  bool is_inward(Notch &notch, const Vec3 &normal) const {
    const uint32_t a = vertex(notch.first), b = vertex(notch.first + notch.count - 1);
    const Edge mouth = {std::min(a, b), std::max(a, b)};
    if (std::binary_search(edges_.begin(), edges_.end(), mouth)) return false;
    const Vec3 along = sheet_.x[b] - sheet_.x[a];
    const Vec3 inward = normal.cross(along);
    const double size = inward.norm();
    if (!(size > 0)) return false;
    for (size_t k = 1; k + 1 < notch.count; ++k) {
      if (stays(vertex(notch.first + k))) return false;
      if ((at(notch.first + k) - sheet_.x[a]).dot(inward) <= 0) return false;
      notch.depth = std::max(notch.depth, depth_of(notch, k));
    }
    return true;
  }

  // Whether the edge rises beyond both ends of a notch, seen from its mouth.
  bool is_in_valley(const Notch &notch, const Vec3 &normal) const {
    const size_t n = loop_.size(), last = notch.first + notch.count - 1;
    const Vec3 outward = (at(last) - at(notch.first)).cross(normal).normalized();
    const auto rise = [&](size_t from, size_t step) {
      double way = 0, most = 0;
      size_t k = from;
      for (size_t steps = 0; way < shoulder && steps < n - notch.count; ++steps, k += step) {
        way += (at(k + step) - at(k)).norm();
        most = std::max(most, (at(k + step) - at(from)).dot(outward));
      }
      return most;
    };
    const double least = rising * notch.depth;
    const size_t backwards = n - 1;  // modulo n
    return rise(notch.first, backwards) > least && rise(last, 1) > least;
  }

  // m, of a vertex of a notch from the straight line over its mouth.
  double depth_of(const Notch &notch, size_t k) const {
    const Vec3 &a = at(notch.first), &b = at(notch.first + notch.count - 1);
    const Vec3 along = b - a, off = at(notch.first + k) - a;
    const double length2 = along.squaredNorm();
    const double share = length2 > 0 ? std::clamp(off.dot(along) / length2, 0.0, 1.0) : 0;
    return (off - share * along).norm();
  }

  // Whether a stretch of the edge is deeper than wide, or a valley: beyond the widest notch it goes
  // on as steep as the sides of one. A torn edge has no valleys.
  bool is_cleft(const Notch &cleft, double way) const {
    if (cleft.width <= widest_notch) return cleft.depth > std::max(deepest_notch, cleft.width);
    return !is_torn_ && way >= sharp_detour * cleft.width &&
           cleft.depth > std::max(deepest_notch, valley_depth * cleft.width);
  }

  // Marks the bottoms of clefts and valleys, which are too deep to be notches, so that no notch has
  // such a bottom. The corner of the orifice at a commissure is one as well.
  void keep_clefts() {
    std::vector<uint8_t> is_bottom(sheet_.x.size(), 0);
    for (size_t first = 0; first < loop_.size(); ++first) {
      double way = 0;
      Vec3 normal = normal_[vertex(first)];
      for (size_t step = 1; step <= loop_.size() - 3; ++step) {
        way += (at(first + step) - at(first + step - 1)).norm();
        if (step > most_vertices && way > longest_valley) break;
        normal += normal_[vertex(first + step)];
        Notch cleft{first, step + 1, 0, (at(first + step) - at(first)).norm(), 0};
        if (step < 2 || cleft.width > widest_valley) continue;
        if (!is_inward(cleft, normal) || !is_cleft(cleft, way)) continue;
        for (size_t k = 1; k < step; ++k) {
          if (depth_of(cleft, k) > cleft.depth - bottom_height) is_bottom[vertex(first + k)] = 1;
        }
      }
    }
    for (size_t i = 0; i < is_bottom.size(); ++i) {
      if (is_bottom[i] != 0) kept_[i] = 1;
    }
  }

  LeafletSheet &sheet_;
  std::vector<uint32_t> &loop_;
  double detour_;
  bool is_torn_;
  std::vector<uint8_t> kept_;  // vertices that stay on the edge
  std::vector<Vec3> normal_;   // of each vertex, by area
  std::vector<Edge> edges_;    // of the sheet, sorted
};

FilledNotches fill_all(bool is_torn, const std::vector<uint8_t> &kept, LeafletSheet &sheet,
                       std::vector<uint32_t> &loop) {
  FilledNotches filled;
  filled.sheet_triangles = sheet.triangles.size();
  const double area = surface_area(sheet.x, sheet.triangles);
  NotchedRim edge(sheet, loop, kept, is_torn);
  for (Notch notch = edge.largest(); notch.count > 0; notch = edge.largest()) {
    filled.inner.push_back(edge.fill(notch));
    filled.last.push_back(sheet.triangles.size());
    filled.deepest = std::max(filled.deepest, notch.depth);
    filled.mean_depth += notch.depth;
    filled.saved += notch.saved;
  }
  filled.area = surface_area(sheet.x, sheet.triangles) - area;
  if (!filled.last.empty()) filled.mean_depth /= static_cast<double>(filled.last.size());
  return filled;
}

}  // namespace

FilledNotches fill_notches(LeafletSheet &sheet, std::vector<uint32_t> &rim,
                           const std::vector<uint8_t> &kept) {
  LeafletSheet with_sharp = sheet;
  std::vector<uint32_t> loop = rim;
  FilledNotches sharp = fill_all(false, kept, with_sharp, loop);
  if (sharp.last.size() >= sharp_of_torn) return fill_all(true, kept, sheet, rim);
  sheet = std::move(with_sharp);
  rim = std::move(loop);
  return sharp;
}

bool keep_crossing(const FilledNotches &notches, const std::vector<Edge> &crossings,
                   std::vector<uint8_t> &kept) {
  std::vector<uint8_t> chosen(notches.last.size(), 0);
  for (const Edge &pair : crossings) {
    for (const uint32_t t : pair) {
      if (t < notches.sheet_triangles) continue;
      const auto above = std::upper_bound(notches.last.begin(), notches.last.end(), t);
      chosen[static_cast<size_t>(above - notches.last.begin())] = 1;
    }
  }
  bool any = false;
  const bool all = std::find(chosen.begin(), chosen.end(), 1) == chosen.end();
  for (size_t n = 0; n < chosen.size(); ++n) {
    if (chosen[n] == 0 && !all) continue;
    for (const uint32_t i : notches.inner[n]) {
      if (i >= kept.size()) continue;  // made by a filling
      any = any || kept[i] == 0;
      kept[i] = 1;
    }
  }
  return any;
}

void report_notches(const FilledNotches &notches, NotchesOf rim, Findings &findings) {
  if (notches.last.empty()) return;
  const bool is_annulus = rim == NotchesOf::annulus;
  std::string sentence = format(
      "%zu notches of the %s, up to %.1f mm deep and at most %.0f mm wide, were filled with %.1f "
      "mm2 of tissue; the %s is %.1f mm shorter for it. ",
      notches.last.size(), is_annulus ? "annulus" : "free edge", notches.deepest * 1e3,
      widest_notch * 1e3, notches.area * 1e6, is_annulus ? "annulus" : "edge", notches.saved * 1e3);
  sentence += is_annulus
                  ? "If tissue ends there, extend the notch in the surface"
                  : "Deeper clefts are kept: if a notch is a cleft, extend it in the surface";
  const std::vector<double> values = {notches.deepest, notches.saved, notches.mean_depth};
  findings.push_back({is_annulus ? "annulus_notches" : "free_edge", FindingSource::guessed, 0.6,
                      std::move(sentence), values, "m"});
}

}  // namespace mvs::core
