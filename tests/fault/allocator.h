// A global operator new that fails on request and counts live allocations.
#pragma once

namespace fault {

// The n-th allocation of this thread from now on fails, and all after it; 0: every allocation
// succeeds.
void fail_from(long n);

// Whether an allocation has failed since.
bool has_failed();

// Allocations of this thread since the last fail_from.
long allocations();

// Allocations of this thread that are alive.
long alive();

}  // namespace fault
