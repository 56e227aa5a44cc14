// Gaps between the leaflets that a given closed surface shows, whatever a valve fitted to it does.
//
// A fit brings the simulated valve near to the surface on the whole; a local gap, as of a ruptured
// chord, adds little to that distance, and the fitted valve may close it. So the orifice of the
// surface itself is measured (measure/orifice). Surfaces of images end short of the annulus and
// have holes where tissue is thin; tissue of the fitted valve near the annulus, and far from its
// free edge, fills them, as leaflets do not part there.
//
// Errors of the surface open gaps as well: errors of segmentation networks (0.45 mm in the mean,
// 3.6 mm 95 % Hausdorff) make gaps that are narrower than the largest error along the line where
// leaflets meet, gaps of little area, holes in one leaflet, and gaps beside which leaflets end far
// from where their free edges are (leaflet_reach.h). They do not count
// (tests/validation/shown_gaps.py). Wide false gaps remain, which look like true ones. Narrow true
// gaps are left out, and named; a surface that is known to be better shows these as well. Gaps are
// between the middles of leaflets, and wider than the opening by their thickness.
#pragma once

#include <string>
#include <vector>

#include "patient/fit/surface_match.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

struct ShownGap {
  double area = 0;     // m2
  double width = 0;    // m, of the widest ball in it
  double missing = 0;  // m, of tissue that the surface lacks beside it
  std::string place;   // scallops beside it: "A2 to P2"
};

struct ShownGaps {
  std::string missing;         // a leaflet that the surface lacks: nothing is measured
  std::vector<ShownGap> gaps;  // the largest first; none is narrower than errors of edges are
  double area = 0;             // m2, of all beside which little tissue is missing
  // m2, the same with each gap narrower and wider by the error of its edges; 0: not more than
  // errors of the surface show
  double least = 0, most = 0;
  double error = usual_closed_error;         // m, of places of the surface
  double least_width = 0;                    // m, of gaps that count
  double narrow_area = 0, narrow_width = 0;  // m2, m: of gaps that errors of edges open as wide
};

// A surface with less of a leaflet than this share of it in the fitted valve lacks that leaflet.
inline constexpr double least_of_leaflet = 0.6;

// The least width of gaps that count, in standard deviations of the surface. Leaflets touch along
// 45 mm, and errors are alike over 5 mm, so that the widest place of a sealed valve is the largest
// of ten errors. In 95 % of such valves it is below 2.57 times 1.41 deviations.
inline constexpr double least_widths = 3.6;
// Standard deviations: gaps of thicker tissue count from as much more of width on as it is thicker.
// The least width was found on labels of 0.5 mm, in which tissue of 1 mm touches with its middles
// as far apart; the smaller the errors are, the less of that they hide.
inline constexpr double usual_thicknesses = 2;
// m: nor do larger errors hide more.
inline constexpr double usual_thickness = 1e-3;

// m: the least width of gaps that count, between the middles of leaflets of a thickness, on a
// surface whose places have a standard deviation (m).
double least_gap_width(double deviation, double thickness);

// Whether leaflets with the tissue that is missing beside a gap would close it.
bool would_close(const ShownGap &gap);

// `error`: the standard deviation of places of the surface, m. `x`: the valve that was fitted to
// the surface, closed; the nodes of the model begin with the vertices of the sheet of `g`.
ShownGaps shown_gaps(const ClosedSurface &given, const Model &model, const std::vector<Vec3> &x,
                     const PatientGeometry &g, double error);

// The finding "closed_error" of an error that is given, m; none if it is 0.
void report_closed_error(double error, Findings &findings);

// The finding "shown_gaps". It is doubtful if the valve, which leaks `leak` (m2), closes most of
// what the surface shows, or leaks far more. A wide interval of its leaks excuses neither: the
// worse a valve fits, the wider it is.
void report_shown_gaps(const ShownGaps &shown, double leak, Findings &findings);

}  // namespace mvs::core
