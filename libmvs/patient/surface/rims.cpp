// Cuts, fills, orders and orients the rims; refuses closed leaflets.
#include "patient/surface/rims.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "patient/findings.h"
#include "patient/surface/boundary.h"
#include "patient/surface/cut_annulus.h"
#include "patient/surface/cut_handles.h"
#include "patient/surface/facing_area.h"
#include "patient/surface/holes.h"
#include "patient/surface/pinched_gaps.h"
#include "patient/surface/which_rim.h"

namespace mvs::core {
namespace {

// m: a free edge so far from the plane of the annulus is on the side of the ventricle. Normal
// leaflets reach 10 mm deep; at 2.5 mm noise of an image can turn the sign.
constexpr double sure_depth = 5e-3;
// m: the mean width of the orifice (twice its area over the length of the free edge). Real and
// parametric open valves have 3.7 mm and more; below one thickness the edges touch along most of
// their length.
constexpr double closed_width = 1e-3, doubtful_width = 3e-3;
// Closed leaflets also touch where their edges lie apart below the coaptation or one of them leaks:
// the atrial side of 8 to 33 % of the area of closed valves has the other leaflet within 2 mm, of
// open ones none.
constexpr double coapted_gap = 2e-3, coapted_share = 0.04;
// These three lengths scale with the annulus: the edges of an infant's valve with an annulus of
// 33 mm lie 1 mm apart.

std::string list_of_lengths(const std::vector<RimLoop> &rims) {
  std::string list;
  for (size_t k = 0; k < std::min<size_t>(rims.size(), 6); ++k) {
    const Vec3 &c = rims[k].shape.centre;
    list += format("%s%.0f mm around (%.0f, %.0f, %.0f) mm", k > 0 ? ", " : "",
                   rims[k].shape.length * 1e3, c.x() * 1e3, c.y() * 1e3, c.z() * 1e3);
  }
  return list + (rims.size() > 6 ? ", ..." : "");
}

void check_rims(const std::vector<RimLoop> &rims) {
  MVS_MUST(!rims.empty(), MVS_E_OP, "triangles",
           "the surface is closed: give it as skin, or open it at annulus and free edge");
  MVS_MUST(rims.size() != 1, MVS_E_OP, "triangles",
           "the surface has one boundary, %s; leaflets have two, annulus and free edge: is the "
           "orifice closed by triangles, or is this a part of a leaflet?",
           list_of_lengths(rims).c_str());
  MVS_MUST(
      rims.size() == 2, MVS_E_OP, "triangles",
      "the surface has %zu boundaries: %s; leaflets have two, annulus and free edge, and only "
      "holes below a fifth of the longest boundary, or of less than %.0f mm2 within one leaflet, "
      "are filled: close the others. Cut a bridge of tissue between the leaflets, as a clip "
      "leaves; "
      "an operation on the valve makes it again",
      rims.size(), list_of_lengths(rims).c_str(), long_hole_area * 1e6);
}

void check_handles(LeafletSheet &sheet, Findings &findings) {
  const size_t handles = cut_handles(sheet, 0, findings);
  MVS_MUST(handles == 0, MVS_E_OP, "triangles",
           "the surface has %zu handles more than %.0f mm around: leaflets touch and are joined "
           "there, or a bridge of tissue passes over the orifice; open the surface at these places "
           "(smaller handles are cut)",
           handles, longest_handle * 1e3);
}

// Normals into the atrium: the direction from the free edge to the annulus, or from the tips if
// they are given. Returns whether the triangles were turned.
bool orient(LeafletSheet &sheet, std::vector<RimLoop> &rims, const std::vector<Vec3> &tips,
            Findings &findings) {
  const LoopShape &annulus = rims[0].shape, &edge = rims[1].shape;
  const Vec3 axis = annulus.area.normalized();
  const double depth = axis.dot(annulus.centre - edge.centre);
  double up = depth;
  Finding finding;
  finding.name = "atrium";
  finding.sentence = format("the free edge lies %.1f mm below the annulus", std::abs(depth) * 1e3);
  finding.confidence = std::clamp(std::abs(depth) / sure_depth, 0.0, 1.0);
  if (!tips.empty()) {
    up = 0;
    for (const Vec3 &tip : tips) up += axis.dot(annulus.centre - tip);
    up /= static_cast<double>(tips.size());
    const bool agree = (up > 0) == (depth > 0);
    MVS_MUST(
        agree || std::abs(depth) < sure_depth, MVS_E_OP, "papillary_tips",
        "the papillary tips lie %.1f mm from the annulus, and the free edge %.1f mm on the "
        "other side: tips are below the leaflets; are both in one frame (LPS or RAS), and in m "
        "(--unit of a file)?",
        std::abs(up) * 1e3, std::abs(depth) * 1e3);
    finding.sentence = format(
        "away from the papillary tips, %.1f mm from the annulus; the free edge lies %.1f mm on %s "
        "side",
        std::abs(up) * 1e3, std::abs(depth) * 1e3, agree ? "the same" : "the other");
    finding.confidence = agree ? 1 : 0.5;
  }
  MVS_MUST(
      up != 0, MVS_E_OP, "triangles",
      "the free edge lies in the plane of the annulus: give the papillary tips, so that atrium "
      "and ventricle can be told apart");
  if (up < 0) {
    for (Tri &t : sheet.triangles) std::swap(t[1], t[2]);
    for (RimLoop &rim : rims) {
      std::reverse(rim.loop.begin() + 1, rim.loop.end());
      rim.shape.area = -rim.shape.area;
    }
  }
  // with the other rim as annulus the atrium is on the other side
  if (const Finding *found = find_finding(findings, "annulus")) {
    finding.confidence = std::min(finding.confidence, found->confidence);
  }
  const Vec3 into_atrium = up < 0 ? Vec3(-axis) : axis;
  finding.value = {into_atrium.x(), into_atrium.y(), into_atrium.z()};
  findings.push_back(finding);
  return up < 0;
}

// A closed valve has no orifice seen from the atrium, or a narrow one with leaflets that coapt. An
// open valve with a slit as orifice is refused.
void check_open(const LeafletSheet &sheet, const std::vector<RimLoop> &rims, Findings &findings) {
  const LoopShape &annulus = rims[0].shape, &edge = rims[1].shape;
  const double area = std::abs(edge.area.dot(annulus.area.normalized()));
  const double width = 2 * area / edge.length;
  const double scale = std::min(1.0, annulus.length / whole_annulus);
  MVS_MUST(width >= scale * closed_width, MVS_E_OP, "points",
           "the leaflets seem to be closed: their edges are %.2f mm apart in the mean, seen from "
           "the atrium; give the open leaflets, and these as the closed ones",
           width * 1e3);
  const bool doubtful = width < scale * doubtful_width;
  const double coapted = doubtful ? facing_share(sheet, scale * coapted_gap) : 0;
  MVS_MUST(coapted < coapted_share, MVS_E_OP, "points",
           "the leaflets seem to be closed: %.0f %% of their area lie within %.1f mm of the other "
           "leaflet, and their edges are %.2f mm apart in the mean, seen from the atrium; give the "
           "open leaflets, and these as the closed ones",
           coapted * 100, scale * coapted_gap * 1e3, width * 1e3);
  Finding finding;
  finding.name = "orifice";
  finding.confidence = std::min(1.0, width / (scale * doubtful_width));
  finding.sentence = format("%.0f mm2 between the free edges as scanned, seen from the atrium%s",
                            area * 1e6, doubtful ? ": are these the open leaflets?" : "");
  finding.value = {area};
  finding.unit = "m2";
  findings.push_back(finding);
}

// Fills holes; two rims remain.
std::vector<RimLoop> rims_without_holes(LeafletSheet &sheet, FilledHoles &filled) {
  std::vector<RimLoop> rims = sorted_rims(sheet);
  fill_holes(sheet, rims, filled);
  check_rims(rims);
  return rims;
}

}  // namespace

SheetRims find_rims(LeafletSheet &sheet, const RimLandmarks &landmarks, Findings &findings) {
  fill_pinched_gaps(sheet, findings);
  cut_along_annulus(sheet, landmarks, findings);
  FilledHoles filled;
  std::vector<RimLoop> rims = rims_without_holes(sheet, filled);
  const size_t triangles = sheet.triangles.size();
  check_handles(sheet, findings);
  const bool is_cut = sheet.triangles.size() != triangles;
  if (is_cut) rims = rims_without_holes(sheet, filled);  // a cut may have passed a rim
  report_holes(filled, findings);
  order_rims(sheet, landmarks, rims, findings);
  const bool turned = orient(sheet, rims, landmarks.tips, findings);
  check_open(sheet, rims, findings);
  return {std::move(rims[0].loop), std::move(rims[1].loop), turned};
}

}  // namespace mvs::core
