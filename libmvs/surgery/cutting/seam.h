// Sewing the two sides of a cut together.
#pragma once

#include "surgery/cutting/cut.h"

namespace mvs::core {

// Joins the two sides of a line by sutures, from its node `turn`, where the sides part, to its
// ends; nodes are added where one side has one and the other has none near. `name` begins the names
// of the sutures. Gives how many there are.
uint32_t sew(Surgery &s, const CutLine &line, size_t turn, const std::string &name);

}  // namespace mvs::core
