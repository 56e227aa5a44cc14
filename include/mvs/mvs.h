/* The stable interface of libmvs in C; experimental.h has the rest. */
#ifndef MVS_MVS_H
#define MVS_MVS_H

#include "base.h"
#include "cost.h"
#include "device.h"
#include "file.h"
#include "op.h"
#include "plan.h"
#include "sim.h"
#include "snapshot.h"
#include "tool.h"
#include "valve.h"

#endif
