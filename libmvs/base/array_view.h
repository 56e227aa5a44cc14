// Conversion of the caller's strided arrays into vectors, with checks of type and layout.
#pragma once

#include <mvs/base.h>

#include <array>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Returns whether an array is given: one whose fields are all zero is not.
bool is_given(const mvs_array &array);

// Points or directions: F64 or F32, 3 components. An array that is not given is empty.
std::vector<Vec3> read_points(const mvs_array &array, const char *what);

// Pairs of numbers: F64 or F32, 2 components.
std::vector<std::array<double, 2>> read_pairs(const mvs_array &array, const char *what);

// One number a row: F64 or F32, 1 component.
std::vector<double> read_numbers(const mvs_array &array, const char *what);

// Indices: U32, 1 component.
std::vector<uint32_t> read_indices(const mvs_array &array, const char *what);

// Triangles: U32, 3 components.
std::vector<Tri> read_triangles(const mvs_array &array, const char *what);

// Throws if a list of structs is implausibly long, or has a count but no pointer.
void check_list(const void *list, uint64_t count, const char *what);

}  // namespace mvs::core
