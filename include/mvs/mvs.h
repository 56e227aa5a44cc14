/* All of libmvs in plain C. */
#ifndef MVS_MVS_H
#define MVS_MVS_H

#include "base.h"
#include "device.h"
#include "ensemble.h"
#include "file.h"
#include "levels.h"
#include "op.h"
#include "plan.h"
#include "sim.h"
#include "snapshot.h"
#include "tool.h"
#include "valve.h"

#endif
