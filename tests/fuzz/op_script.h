// Any bytes as a script of operations, tools, undo, redo, settle, step, save and load, checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fuzz {

// Runs a script on a small valve; aborts with a sentence at the first call that breaks a property
// of ops.cpp.
void run_op_script(const uint8_t *data, size_t size);

}  // namespace fuzz
