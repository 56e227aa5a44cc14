// Suture of the two sides of a cut.
#pragma once

#include "surgery/cutting/cut.h"

namespace mvs::core {

// Joins the two sides of a cut by sutures, from its node `turn`, where the sides part, to its ends;
// adds nodes where only one side has a node. `name` is the prefix of the suture names. Returns the
// number of sutures.
uint32_t sew(Surgery &s, const CutLine &line, size_t turn, const std::string &name);

}  // namespace mvs::core
