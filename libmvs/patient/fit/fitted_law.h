// The tissue law with which a valve, its chordae fitted, closes nearest to a given surface.
//
// An open surface does not show it, and fitted lengths make up for a wrong law in part only: a law
// that is too stiff leaves the belly and the free edge a millimetre and more from the closed
// leaflets, or asks for tissue past the free edge of the open ones. So a coarse valve is fitted
// with each of three laws. Fung-type leaflets are left out: their fits take several times as long.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "patient/fit/fit_to_closed.h"
#include "patient/leaflet_sheet.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// The default first.
inline constexpr std::array fitted_laws = {LeafletLawId::bilinear, LeafletLawId::prot,
                                           LeafletLawId::may_newman_yin};
// The mesh on which laws are compared has half of the default vertices, for a third of the time.
// With one search for each law in the place of three, the assumed tips of one valve decided the
// law.
inline constexpr double law_vertices = 500;

// A coarse valve with one law, its chordae fitted and closed from open.
struct LawFit {
  LeafletLawId law = LeafletLawId::bilinear;
  double distance = 0;  // m, RMS: of the given surface from the valve
  double edge = 0;      // m, RMS: by which the free edge was moved out
  double leak = 0;      // m2
  double rms = 0;       // m: that of the fit (ChordFit)
  GroupFactors factor;  // on the lengths of chordae
  bool at_rest = true;
  bool given_up = false;  // before its last search
};

// Fits each of `valves`, on the sheet of `g`, each with a law of its own. A valve is left out if it
// diverges or crosses itself. Their searches take turns, and a law that falls far behind another is
// given up. Laws share the workers.
//
// The distance is that of the given surface from the valve, not the other way round: where the
// surface lacks tissue, as along the free edge, a valve without error is far from it whatever its
// tissue. `tell` is called before each closure.
std::vector<LawFit> fit_laws(std::vector<Valve> valves, const PatientGeometry &g,
                             const ClosedSurface &given, bool edge_is_exact, const TellShare &tell,
                             Workers *workers = nullptr);

// Distance and moved edge together, m.
double misfit_of(const LawFit &fit);

// The nearest first, those that still creep last.
std::vector<LawFit> in_order(std::vector<LawFit> fits);

// The laws that may be that of the patient, of fits in order: those up to a quarter farther away
// than the first. The surface hardly determines the law among them.
std::vector<LawFit> plausible_laws(const std::vector<LawFit> &fits);

// The finding "tissue", whose value is the number of the law that is taken, of fits in order.
Finding tissue_found(const std::vector<LawFit> &fits, LeafletLawId taken);

}  // namespace mvs::core
