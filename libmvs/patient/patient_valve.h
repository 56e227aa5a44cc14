// The valve of a patient on a mesh of a wanted size.
#pragma once

#include "model/model.h"
#include "patient/annulus/annulus_motion.h"
#include "patient/chordae/papillary_tips.h"
#include "patient/findings.h"
#include "patient/mesh/remesh_sheet.h"
#include "patient/mid_sheet.h"
#include "patient/patient_geometry.h"

namespace mvs::core {

// Sides of equilateral triangles, m, with which a sheet has a number of vertices.
double edge_for(const LeafletSheet &sheet, double vertices);

// The sheet with triangles of the sides `edge`, and its leaflets, whose commissures are among the
// findings.
PatientGeometry patient_geometry(const MidSheet &mid, double edge, Findings &findings);

// The figures of a new mesh. With a flat triangle or a side far below the wanted one it has a low
// confidence and says where to mend the labels or the surface.
Finding mesh_finding(size_t vertices, double edge, const RemeshReport &report);

// Annulus and papillary tips, at rest and under load.
struct Boundary {
  AnnulusMotion annulus;
  PapillaryTips tips;

  bool moves() const { return annulus.moves() || !tips.loaded_anterolateral.empty(); }
};

// Leaflets of one law with their thickness, and chordae to the tips.
Valve patient_valve(const BuildSettings &settings, LeafletLawId law, const PatientGeometry &g,
                    const Boundary &boundary, Findings &findings);

}  // namespace mvs::core
