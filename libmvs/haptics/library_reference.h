// Keeps libmvs loaded while code of it may still run: on a thread that cannot be joined, or in a
// signal handler.
#pragma once

namespace mvs::core {

// Takes one of the references that dlopen counts of the library that contains this function, so
// that a dlclose of the host does not unload it. Null in a program that contains it statically.
void *hold_library() noexcept;

// Gives a reference back; null is allowed. The caller runs in the library: another reference, that
// of the host, must exist.
void release_library(void *reference) noexcept;

}  // namespace mvs::core
