// Operations of older files, as they were meant when they were written.
#pragma once

#include "model/model.h"
#include "surgery/operation.h"

namespace mvs::core {

// Up to version 2 of plans and journals and 4 of sessions, a chord that went to another head
// without a length kept the one that it had: this gives it to the operation. Any other is returned
// as it is.
Operation keeping_length(const Operation &op, const Model &before);

}  // namespace mvs::core
