// The affine motion onto rims, the waves towards a given curve, and their findings.
#include "patient/annulus/annulus_motion.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "model/sides.h"
#include "patient/annulus/affine_meeting.h"
#include "patient/findings.h"
#include "patient/fit/closed_pieces.h"
#include "patient/surface/annulus_through.h"
#include "patient/surface/rims.h"

namespace mvs::core {
namespace {

// m: a point of the annulus moves at most so far to a rim of the leaflets: free edges, and the far
// sides of gaps in a rim, are 8 mm away and more but beside the commissures.
constexpr double farthest_rim = 6e-3;
// m: where too little of the annulus lies within that, it is sought so far: in a beat an annulus
// descends by up to 12 mm.
constexpr double farthest_moved_rim = 12e-3;
// m: half of the height of leaflets, by which the middle of all rims lies below the annulus.
constexpr double half_height = 6e-3;
// m, RMS of what remains then: rims from images are right to a voxel. Parts of other rims that the
// annulus meets by chance remain farther away.
constexpr double rms_of_moved = 1e-3;
// m, RMS: errors of rims from images make as much.
constexpr double no_motion = 0.25e-3;
// Norm of the stretch: normal annuli change their diameters by 5 to 15 % in a beat, and 0.4 is 28 %
// of both.
constexpr double most_stretch = 0.4;
constexpr double curve_spacing = 1e-3;  // m, of the points of a given curve
// Curves that an observer places at two phases differ by the motion and by the errors of both, half
// a millimetre and more in each point. The motion of an annulus is long-waved: size, place and tilt
// are one wave a lap, the height of the saddle is two, and a radial change of a D shape up to four.
// Shorter ones would be errors that wrinkle the annulus and stretch the leaflets at it.
constexpr size_t most_waves = 4;
// Confidence of a motion that is found at once, and of one that is sought farther off: an image of
// another place of the table, or another frame, looks the same.
constexpr double confidence_of_rims = 0.6, confidence_of_far_rims = 0.3;
// Confidence that the annulus stays where it lies on no rim, and where it would if it was
// displaced.
constexpr double confidence_of_unseen = 0.3, confidence_of_displaced = 0.1;

// Sides that have one triangle.
std::vector<CurveSide> rims_of(const ClosedSurface &closed) {
  const ClosedPieces pieces = closed_pieces(closed.points, closed.triangles);
  std::vector<Tri> joined;
  joined.reserve(closed.triangles.size());
  for (const Tri &t : closed.triangles) joined.push_back(pieces.joined(t));
  const std::vector<Side> sides = sorted_sides(joined);
  std::vector<CurveSide> rims;
  for_each_edge(sides, [&](size_t first, size_t last) {
    const auto [a, b] = sides[first].edge;
    if (last == first + 1 && a != b) rims.push_back({closed.points[a], closed.points[b]});
  });
  return rims;
}

std::string words_of(const std::vector<Vec3> &annulus, const AnnulusMotion &motion) {
  double sum = 0, most = 0, length = 0, loaded = 0;
  for (size_t k = 0; k < annulus.size(); ++k) {
    const Vec3 &p = annulus[k], &next = annulus[(k + 1) % annulus.size()];
    const double by = (motion(p) - p).norm();
    sum += by;
    most = std::max(most, by);
    length += (next - p).norm();
    loaded += (motion(next) - motion(p)).norm();
  }
  return format(
      "%.1f mm in the mean, %.1f mm at most; its length is %.0f mm under load, %.0f mm open",
      sum / static_cast<double>(annulus.size()) * 1e3, most * 1e3, loaded * 1e3, length * 1e3);
}

std::vector<Vec3> moved_by(const AnnulusMotion &motion, const std::vector<Vec3> &annulus) {
  std::vector<Vec3> loaded;
  loaded.reserve(annulus.size());
  for (const Vec3 &p : annulus) loaded.push_back(motion(p));
  return loaded;
}

void report_measured(const std::vector<Vec3> &annulus, const AnnulusMotion &motion,
                     std::string sentence, Findings &findings) {
  findings.push_back(
      {"closed_annulus", FindingSource::measured, confidence_of_rims, std::move(sentence), {}, ""});
  set_points(moved_by(motion, annulus), findings.back());
}

void report_given(const std::vector<Vec3> &annulus, const std::vector<Vec3> &given,
                  const std::vector<CurveSide> &curve, const AnnulusMotion &motion,
                  Findings &findings) {
  double sum = 0;
  for (const Vec3 &p : moved_by(motion, annulus))
    sum += (nearest_on_sides(curve, p) - p).squaredNorm();
  findings.push_back(
      {"closed_annulus",
       FindingSource::given,
       1,
       "the annulus moves to the given curve, by " + words_of(annulus, motion) +
           format("; %.2f mm (RMS) remain, in waves that are shorter than motions of an annulus",
                  std::sqrt(sum / static_cast<double>(annulus.size())) * 1e3),
       {},
       ""});
  set_points(given, findings.back());  // read back it is the same curve
}

// The displacement, m, with which the annulus would lie on rims that are farther off than it moves;
// 0: none is found. Iterative closest points find the nearest fit only, so that they begin with the
// annulus in the middle of the rims, and above and below it, as free edges lie on one side.
double displacement_to(const std::vector<Vec3> &annulus, const Vec3 &centre,
                       const std::vector<CurveSide> &rims) {
  Vec3 middle = Vec3::Zero(), axis = Vec3::Zero();
  double length = 0;
  for (const auto &[a, b] : rims) {
    middle += (b - a).norm() * (a + b) / 2;
    length += (b - a).norm();
  }
  if (!(length > 0)) return 0;
  for (size_t k = 0; k < annulus.size(); ++k) {
    axis += (annulus[k] - centre).cross(annulus[(k + 1) % annulus.size()] - centre);
  }
  Meeting best;
  double displacement = 0;
  for (const double above : {0.0, half_height, -half_height}) {
    const Vec3 start = middle / length - centre + above * axis.normalized();
    std::vector<Vec3> moved = annulus;
    for (Vec3 &p : moved) p += start;
    const Meeting met = meet(moved, centre + start, rims, farthest_moved_rim);
    if (met.seen < least_on_curve || (displacement > 0 && met.rms >= best.rms)) continue;
    best = met;
    displacement = (start + met.motion.shift).norm();
  }
  const bool found = best.seen >= least_on_curve && best.motion.stretch.norm() <= most_stretch &&
                     best.rms <= rms_of_moved && displacement > farthest_annulus;
  return found ? displacement : 0;
}

// Without values: as a given curve they would be another boundary than this assumption.
Finding unseen_motion(double displacement) {
  Finding finding{"annulus_motion",
                  FindingSource::assumed,
                  confidence_of_unseen,
                  "the annulus is taken to stay under load: too little of it lies near rims of the "
                  "closed surface; give points along the loaded annulus",
                  {},
                  ""};
  if (displacement == 0) return finding;
  finding.confidence = confidence_of_displaced;
  finding.sentence += format(
      "; displaced by %.1f mm it would lie on them, farther than an annulus moves: both surfaces "
      "do not lie in one frame, and have to be registered",
      displacement * 1e3);
  return finding;
}

double rms_of(const std::vector<Vec3> &annulus, const AnnulusMotion &motion) {
  double sum = 0;
  for (const Vec3 &p : annulus) sum += (motion(p) - p).squaredNorm();
  return std::sqrt(sum / static_cast<double>(annulus.size()));
}

// Whether a motion is that of one annulus between two phases.
bool is_plausible(const Meeting &met) {
  return met.seen >= least_on_curve && met.motion.stretch.norm() <= most_stretch &&
         met.motion.shift.norm() <= farthest_annulus;
}

// The meeting with rims of the closed surface, those at hand or others farther off.
struct RimMeeting {
  Meeting met;
  bool is_far = false;
};
RimMeeting meet_rims(const std::vector<Vec3> &annulus, const Vec3 &centre,
                     const std::vector<CurveSide> &rims) {
  const Meeting near = meet(annulus, centre, rims, farthest_rim);
  if (is_plausible(near)) return {near};
  const Meeting far = meet(annulus, centre, rims, farthest_moved_rim);
  return is_plausible(far) && far.rms <= rms_of_moved ? RimMeeting{far, true} : RimMeeting{near};
}

std::string far_words(const Meeting &met) {
  return format(
      "; the closed leaflets are displaced by %.1f mm as a whole: if the annulus does not move so "
      "far, both surfaces do not lie in one frame, and have to be registered",
      met.motion.shift.norm() * 1e3);
}

}  // namespace

Vec3 AnnulusMotion::operator()(const Vec3 &p) const {
  if (!moves_) return p;
  return waves_ ? p + waves_->near(p) : affine(p);
}

bool AnnulusMotion::move_to(const std::vector<Vec3> &annulus, const std::vector<Vec3> &curve) {
  std::vector<Vec3> moved;
  moved.reserve(annulus.size());
  for (const Vec3 &p : annulus) moved.push_back(affine(p));
  ClosedCurve to(curve);
  std::vector<double> place = places_along(to, moved);
  if (place.empty()) {
    to = to.reversed();
    place = places_along(to, moved);
  }
  if (place.empty()) return false;
  std::vector<Vec3> displacement;
  displacement.reserve(annulus.size());
  for (size_t k = 0; k < annulus.size(); ++k) displacement.push_back(to.at(place[k]) - annulus[k]);
  waves_.emplace(ClosedCurve(annulus), displacement, most_waves);
  return true;
}

AnnulusMotion find_annulus_motion(const std::vector<Vec3> &annulus, const std::vector<Vec3> &given,
                                  const ClosedSurface &closed, Findings &findings) {
  AnnulusMotion motion;
  if (given.empty() && closed.triangles.empty()) return motion;
  for (const Vec3 &p : annulus) motion.centre_ += p / static_cast<double>(annulus.size());
  const std::vector<Vec3> through = annulus_through(given, curve_spacing);
  MVS_MUST(given.empty() || !through.empty(), MVS_E_ARGUMENT, "closed_annulus",
           "the %zu points of closed_annulus are no curve around the annulus: give six or more "
           "all around it",
           given.size());
  const std::vector<CurveSide> sides = given.empty() ? rims_of(closed) : sides_of(through);
  RimMeeting of_rims;
  Meeting &met = of_rims.met;
  if (!sides.empty() && given.empty()) of_rims = meet_rims(annulus, motion.centre_, sides);
  if (!given.empty()) met = meet(annulus, motion.centre_, sides, HUGE_VAL);
  motion.moves_ = is_plausible(met);
  motion.stretch_ = met.motion.stretch;
  motion.shift_ = met.motion.shift;
  if (!given.empty()) {
    MVS_MUST(
        motion.moves() && motion.move_to(annulus, through), MVS_E_OP, "closed_annulus",
        "the loaded annulus cannot be that of the open leaflets: its middle lies %.1f mm from "
        "theirs, and %.0f %% of it meets the curve; are both in one frame (LPS or RAS), and of "
        "one patient?",
        met.motion.shift.norm() * 1e3, 100 * met.seen);
    report_given(annulus, given, sides, motion, findings);
  } else if (!motion.moves()) {
    findings.push_back(unseen_motion(displacement_to(annulus, motion.centre_, sides)));
  } else if (rms_of(annulus, motion) < no_motion) {
    motion.moves_ = false;
    report_measured(annulus, motion,
                    "the annulus stays under load: rims of the closed surface lie on it", findings);
  } else {
    report_measured(
        annulus, motion,
        "the annulus moves to rims of the closed surface, by " + words_of(annulus, motion) +
            format("; %.2f mm (RMS) remain on %.0f %% of it; give points along the loaded annulus "
                   "if they are known",
                   met.rms * 1e3, 100 * met.seen) +
            (of_rims.is_far ? far_words(met) : ""),
        findings);
    if (of_rims.is_far) findings.back().confidence = confidence_of_far_rims;
  }
  return motion;
}

Rigid rigid_part(const AnnulusMotion &motion, const std::vector<Vec3> &annulus) {
  return register_points(annulus, moved_by(motion, annulus));
}

}  // namespace mvs::core
