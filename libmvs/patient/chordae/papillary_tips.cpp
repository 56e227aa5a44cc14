// Grouping of given tips; places of assumed ones.
#include "patient/chordae/papillary_tips.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "patient/chordae/annulus_frame.h"
#include "patient/findings.h"

namespace mvs::core {
namespace {

constexpr size_t most_tips = 64;
// m: normal tips are 23.5 +- 4 mm below the annulus, and less than 40 mm in dilated ventricles.
constexpr double farthest_tip = 80e-3;
// m: tips move by a few millimetres in a beat.
constexpr double farthest_motion = 15e-3;
// m below the mean plane of the annulus: the annulus itself is up to 7 mm off that plane.
constexpr double least_tip_depth = 5e-3;

// Places of normal anatomy, as those of the parametric valve (anatomy/PARAMETRIC.md), in widths of
// the annulus: 23.5 mm below its plane and 20 mm apart at a width of 35 mm; a little posterior of
// the centre.
constexpr double assumed_depth = 23.5 / 35, assumed_separation = 20.0 / 35;
constexpr double assumed_posterior = 0.12;  // of the AP diameter
// Share of the AP diameter from the centre towards the A point, beyond which tips are unusual.
constexpr double most_forward = 0.2;
// In widths of the annulus. Normal depths are 0.67 +- 0.11, those of dilated ventricles up to
// about 1.1; normal tips are 0.57 apart. Beyond these given tips are doubted.
constexpr double least_depth = 0.3, most_depth = 1.3, least_apart = 0.25;
// Confidence of given tips that contradict normal anatomy.
constexpr double doubtful_tips = 0.4;
// m: a tip is at least this much below the lowest leaflet, as chordae have a length.
constexpr double below_leaflets = 1e-3;

// Two, the anterolateral one first.
std::vector<Vec3> assumed_tips(const PatientGeometry &g, const AnnulusFrame &frame) {
  double depth = assumed_depth * frame.width;
  for (const uint32_t i : g.rims.free_edge) {
    depth = std::max(depth, below_leaflets - frame.local(g.sheet.x[i])[2]);
  }
  const double half = 0.5 * assumed_separation * frame.width;
  const double y = -assumed_posterior * frame.diameter;
  return {frame.global({frame.middle - half, y, -depth}),
          frame.global({frame.middle + half, y, -depth})};
}

void check_tip(const Vec3 &tip, size_t number, const AnnulusFrame &frame) {
  const Vec3 local = frame.local(tip);
  MVS_MUST(local.norm() <= farthest_tip, MVS_E_OP, "papillary_tips",
           "papillary tip %zu lies %.0f mm from the centre of the annulus, at most %.0f mm are "
           "accepted: are both in one frame (LPS or RAS), in m (--unit of a file), and of one "
           "patient?",
           number, local.norm() * 1e3, farthest_tip * 1e3);
  MVS_MUST(local[2] <= -least_tip_depth, MVS_E_OP, "papillary_tips",
           "papillary tip %zu lies %.1f mm %s the plane of the annulus; tips are at least %.0f mm "
           "below it: are both in one frame (LPS or RAS) and in m (--unit of a file), and is the "
           "annulus the rim at the atrium?",
           number, std::abs(local[2]) * 1e3, local[2] > 0 ? "above" : "below",
           least_tip_depth * 1e3);
}

// Loaded tips are the same ones, at most a few millimetres away.
void check_loaded(const std::vector<Vec3> &given, const std::vector<Vec3> &loaded) {
  MVS_MUST(
      loaded.empty() || loaded.size() == given.size(), MVS_E_ARGUMENT, "closed_tips",
      "%zu papillary tips under load are given and %zu at rest: give the same tips in the same "
      "order, or leave closed_tips out",
      loaded.size(), given.size());
  for (size_t k = 0; k < loaded.size(); ++k) {
    const double by = (loaded[k] - given[k]).norm();
    MVS_MUST(
        by <= farthest_motion, MVS_E_OP, "closed_tips",
        "papillary tip %zu would move by %.1f mm under load, at most %.0f mm are accepted: are "
        "both in one frame (LPS or RAS), and in the same order?",
        k + 1, by * 1e3, farthest_motion * 1e3);
  }
}

bool is_medial(const Vec3 &tip, const AnnulusFrame &frame) {
  return frame.local(tip)[0] > frame.middle;
}

std::string words_of(const std::vector<Vec3> &tips, const std::vector<Vec3> &loaded) {
  double least = HUGE_VAL, most = 0;
  for (size_t k = 0; k < tips.size(); ++k) {
    const double by = (loaded[k] - tips[k]).norm();
    least = std::min(least, by);
    most = std::max(most, by);
  }
  return format("the tips of the papillary muscles move by %.1f to %.1f mm under load, ",
                least * 1e3, most * 1e3);
}

// Tips that follow the annulus.
std::vector<Vec3> followed(const std::vector<Vec3> &tips, const Rigid &annulus,
                           Findings &findings) {
  std::vector<Vec3> loaded;
  loaded.reserve(tips.size());
  for (const Vec3 &p : tips) loaded.push_back(annulus(p));
  // without values: read back as given ones they would not follow edited tips
  findings.push_back({"head_motion",
                      FindingSource::assumed,
                      0.4,
                      words_of(tips, loaded) +
                          "with the annulus as a whole, from which they keep their distance in "
                          "normal beats; give the loaded tips if they are known",
                      {},
                      ""});
  return loaded;
}

void report_assumed_tips(const std::vector<Vec3> &two, const AnnulusFrame &frame,
                         Findings &findings) {
  findings.push_back({"papillary_tips",
                      FindingSource::assumed,
                      0.2,
                      format("two tips of normal anatomy, %.1f mm below the plane of the annulus; "
                             "lengths of chordae and tethering follow from them: give the tips of "
                             "the papillary muscles at the phase of the surface",
                             -frame.local(two[0])[2] * 1e3),
                      {},
                      ""});
  set_points(two, findings.back());
}

Vec3 mean_place(const std::vector<Vec3> &tips, const AnnulusFrame &frame) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3 &tip : tips) sum += frame.local(tip);
  return sum / static_cast<double>(tips.size());
}

// The contradictions of given tips to normal anatomy, in words; "" without one.
std::string doubts_of(const PapillaryTips &tips, const AnnulusFrame &frame) {
  const Vec3 al = mean_place(tips.anterolateral, frame), pm = mean_place(tips.posteromedial, frame);
  const Vec3 apart = pm - al;
  const double depth[2] = {-al[2], -pm[2]};
  std::string words;
  if (0.5 * (al[1] + pm[1]) > most_forward * frame.diameter) {
    words +=
        "; they lie under the anterior leaflet, where normal tips lie under the posterior one: "
        "give "
        "a point of the anterior leaflet if both are swapped, and check the frame (LPS or RAS) of "
        "the tips";
  }
  if (std::min(depth[0], depth[1]) < least_depth * frame.width ||
      std::max(depth[0], depth[1]) > most_depth * frame.width) {
    words += format(
        "; they lie %.0f and %.0f mm below the plane of the annulus, which is %.0f mm wide: normal "
        "tips lie at about two thirds of that width",
        depth[0] * 1e3, depth[1] * 1e3, frame.width * 1e3);
  }
  if (apart.norm() < least_apart * frame.width) {
    words += format("; both muscles are %.0f mm apart: are both tips of one muscle?",
                    apart.norm() * 1e3);
  } else if (std::abs(apart[1]) > apart[0]) {
    words +=
        "; they lie one behind the other, under A2 and P2, where normal ones lie below the "
        "commissures: check commissures, frame and anterior leaflet";
  }
  return words;
}

void report_given_tips(const PapillaryTips &tips, const std::vector<Vec3> &given,
                       const AnnulusFrame &frame, Findings &findings) {
  const std::string doubts = doubts_of(tips, frame);
  findings.push_back({"papillary_tips",
                      FindingSource::given,
                      doubts.empty() ? 1 : doubtful_tips,
                      format("the given points: %zu anterolateral, %zu posteromedial",
                             tips.anterolateral.size(), tips.posteromedial.size()) +
                          doubts,
                      {},
                      ""});
  set_points(given, findings.back());
}

}  // namespace

PapillaryTips find_papillary_tips(const std::vector<Vec3> &given, const PatientGeometry &g,
                                  Findings &findings, const std::vector<Vec3> &loaded,
                                  const std::optional<Rigid> &annulus) {
  const AnnulusFrame frame = annulus_frame(g, AnnulusCurve(g, g.sheet.x));
  MVS_MUST(given.size() <= most_tips, MVS_E_ARGUMENT, "papillary_tips",
           "%zu papillary tips are given, at most %zu are accepted", given.size(), most_tips);
  check_loaded(given, loaded);
  for (size_t k = 0; k < given.size(); ++k) check_tip(given[k], k + 1, frame);
  const std::vector<Vec3> all = given.empty() ? assumed_tips(g, frame) : given;
  PapillaryTips tips;
  for (const Vec3 &tip : all) {
    (is_medial(tip, frame) ? tips.posteromedial : tips.anterolateral).push_back(tip);
  }
  MVS_MUST(
      !tips.anterolateral.empty() && !tips.posteromedial.empty(), MVS_E_OP, "papillary_tips",
      "%s papillary %s on the %s side of the plane between the commissures: give at least one tip "
      "of each of the two papillary muscles, or check commissures and anterior leaflet",
      all.size() == 1 ? "the only" : format("all %zu", all.size()).c_str(),
      all.size() == 1 ? "tip lies" : "tips lie",
      tips.anterolateral.empty() ? "posteromedial" : "anterolateral");
  if (given.empty()) {
    report_assumed_tips(all, frame, findings);
  } else {
    report_given_tips(tips, given, frame, findings);
  }
  std::vector<Vec3> moved = loaded;
  if (!loaded.empty()) {
    findings.push_back(
        {"closed_tips", FindingSource::given, 1, words_of(all, loaded) + "as given", {}, ""});
    set_points(loaded, findings.back());
  } else if (annulus) {
    moved = followed(all, *annulus, findings);
  }
  for (size_t k = 0; k < moved.size(); ++k) {
    (is_medial(all[k], frame) ? tips.loaded_posteromedial : tips.loaded_anterolateral)
        .push_back(moved[k]);
  }
  return tips;
}

}  // namespace mvs::core
