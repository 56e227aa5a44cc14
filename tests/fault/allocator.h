// An operator new that fails when told to, and counts what is alive.
#pragma once

namespace fault {

// From here the n-th allocation of this thread fails, and all after it; 0: none does.
void fail_from(long n);

// Whether an allocation has failed since.
bool has_failed();

// Allocations of this thread since the last fail_from.
long allocations();

// Allocations of this thread that are alive.
long alive();

}  // namespace fault
