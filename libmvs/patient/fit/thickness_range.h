// How far the thickness of a patient's leaflets may be off.
#pragma once

#include "model/valve.h"
#include "patient/leaflet_sheet.h"

namespace mvs::core {

// m, the mean of all triangles by number, or that of the leaflets.
double mean_thickness(const Valve &valve);

// m: mid-surfaces of leaflets that touch are a thickness apart; less where triangles are small, so
// that tissue next to each other on the sheet is outside the contact.
double contact_thickness(const Valve &valve);

// The valve with all thicknesses times a factor, and the contact thickness of that.
Valve with_thickness(const Valve &valve, double factor);

// Adds the finding that leaflets touch at a smaller distance than they are thick, if the difference
// is a millimetre or more, from which on a gap between them counts as an orifice.
void report_thin_contact(const Valve &valve, Findings &findings);

// Adds the finding of a thickness that is known up to an error (m; 0: exact, no finding).
void report_thickness_error(double error, Findings &findings);

}  // namespace mvs::core
