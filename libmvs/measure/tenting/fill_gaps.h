// Interpolation of a raster over cells without values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mvs::core {

// Push-pull interpolation (Gortler et al., The Lumigraph, SIGGRAPH 1996) of a square raster whose
// side is a power of two: `weight` is the share of a cell that has a value, 0 to 1. Replaces the
// values of the listed cells: by their own as far as they have one, and for the rest by those of
// their surroundings, from ever coarser rasters and a few sweeps of the Laplace equation on each.
// Continuous in weights and values times weights. Without any weight the rest is 0.
void fill_gaps(const std::vector<double> &weight, size_t across, const std::vector<uint32_t> &cells,
               std::vector<double> &values);

}  // namespace mvs::core
