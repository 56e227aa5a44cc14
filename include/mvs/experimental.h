/* Experimental interface: surfaces in files, valves from surfaces, ensembles, sensitivities, mesh
 * levels and the profile of the solver.
 *
 * Everything else in include/mvs is stable. The functions and structs of this header, of build.h,
 * of surface_file.h, of ensemble.h, of sensitivity.h and of levels.h may change in any version;
 * mvs.h does not include them. */
#ifndef MVS_EXPERIMENTAL_H
#define MVS_EXPERIMENTAL_H

#include "base.h"
#include "build.h"
#include "ensemble.h"
#include "levels.h"
#include "profile.h"
#include "sensitivity.h"
#include "surface_file.h"

#endif
