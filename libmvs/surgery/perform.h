// Applying one operation: on copies, checked as any valve is, all or nothing.
#pragma once

#include <string>

#include "model/model.h"
#include "surgery/operation.h"

namespace mvs::core {

// What an operation did.
struct Operated {
  ModelState current;
  Id made = 0;
  std::string title;
};

// Applies an operation to a picture; throws and leaves it as it is if that cannot be done.
Operated perform(const ModelState &before, const Operation &op);

}  // namespace mvs::core
