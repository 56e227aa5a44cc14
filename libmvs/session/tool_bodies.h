// Bodies of convex tools as the public interface describes them.
#pragma once

#include <mvs/tool.h>

#include <string>
#include <vector>

#include "model/tool_shape.h"

namespace mvs::core {

// Makes the shape of a tool; throws MVS_E_ARGUMENT with the name of the wrong field in the public
// struct `of`. Appends a
// sentence for each hull whose superfluous vertices were dropped, unless `strict`, which refuses
// them.
ToolShapePtr read_bodies(const std::vector<mvs_body_desc> &bodies, const std::string &of,
                         bool strict, std::vector<std::string> &warnings);

// A quaternion of any length, all zero for none, as modified Rodrigues parameters; throws
// MVS_E_ARGUMENT for numbers that are not finite.
Vec3 read_orientation(const double given[4], const char *what);

}  // namespace mvs::core
