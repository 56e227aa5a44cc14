// Applies one operation to copies of model and state, with all checks; all or nothing.
#pragma once

#include <string>

#include "model/model.h"
#include "surgery/operation.h"

namespace mvs::core {

// Result of an operation.
struct Operated {
  ModelState current;
  Id made = 0;
  std::string title;
};

// Applies an operation to a model and its state. Throws if it is not possible; `before` never
// changes.
Operated perform(const ModelState &before, const Operation &op);

}  // namespace mvs::core
