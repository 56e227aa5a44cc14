// The library's own backend: see factor_block.cpp.
#pragma once

#include <memory>

#include "base/factor.h"

namespace mvs {

std::unique_ptr<Factor> make_block_factor();

}  // namespace mvs
