// Measures a remeshed sheet.
#pragma once

#include "patient/mesh/remesh_sheet.h"
#include "patient/mesh/sheet_mesh.h"

namespace mvs::core {

// `made`: the sheet of the mesh.
RemeshReport report_on(const InputSheet &input, const SheetMesh &mesh, const LeafletSheet &made);

}  // namespace mvs::core
