// The operations after which a valve is closed again.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "history/history.h"

namespace bench {

struct Operation {
  std::string kind, name;
  std::function<mvs::core::Operated(const mvs::core::ModelState &closed)> apply;
};

// Every kind of operation on the default valve, chordae and sites by their names.
std::vector<Operation> operations();

}  // namespace bench
