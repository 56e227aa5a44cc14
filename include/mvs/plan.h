/* The surgical plan: what was done to a valve, as a JSON file that can be replayed; and a journal
 * that keeps every operation across a crash. formats/FORMAT.md describes both.
 *
 * Replayed on the same valve a plan gives the same snapshot hash. On another valve parts are found
 * by their names and places on leaflets by their anatomical coordinates; what is not there is
 * refused with a sentence that names the step. Tools that a plan adds come beside those that are
 * held already, under other ids where theirs are taken; what was held stays as it is. */
#ifndef MVS_PLAN_H
#define MVS_PLAN_H

#include "base.h"
#include "op.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What to write into a plan besides the operations. A null pointer or zeros: nothing. */
typedef struct mvs_plan_options {
  uint32_t struct_size;
  uint32_t measures;  /* 1: what the valve measured before and after each operation */
  const char *author; /* nullable */
  const char *notes;  /* nullable */
} mvs_plan_options;

/* Writes the plan of a snapshot, from the valve as it was set or loaded to the snapshot: to a path,
 * or to memory (at most `capacity` bytes, and the true number to *size; with capacity 0, `data`
 * nullable, only the size is told). `options` is nullable. */
MVS_API mvs_result mvs_save_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options,
                                 const char *path);
MVS_API mvs_result mvs_write_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options,
                                  void *data, uint64_t capacity, uint64_t *size);

/* How a plan was replayed. */
typedef struct mvs_replay {
  uint32_t struct_size;
  uint32_t operations;  /* applied */
  uint32_t same_valve;  /* 1: the plan was made on this valve */
  uint32_t same_result; /* 1: the hash at the end is that of the plan */
} mvs_replay;

/* Replays a plan, the text of its file, from the present valve on: all of it, or nothing and the
 * sentence of the step that cannot be done. Settling and stepping are replayed as well; the
 * progress callback is told of each of them in turn and can cancel (MVS_E_CANCELLED). `replay` is
 * nullable. */
MVS_API mvs_result mvs_replay_plan(mvs_sim *sim, const void *data, uint64_t size,
                                   mvs_replay *replay);

/* Says whether mvs_replay_plan would apply every operation of a plan; nothing changes, and nothing
 * is settled on the way. */
MVS_API mvs_result mvs_check_plan(const mvs_sim *sim, const void *data, uint64_t size,
                                  mvs_replay *replay);

/* Starts a journal of the present valve in a new file: from now on each operation, undo, redo and
 * checkpoint is on the disk before the call that did it returns, or the call fails with MVS_E_IO
 * and nothing has changed. What was done to the valve before is written first. Ends by
 * mvs_close_journal, or with the valve. MVS_E_STATE if the file is there already. */
MVS_API mvs_result mvs_open_journal(mvs_sim *sim, const char *path);
MVS_API mvs_result mvs_close_journal(mvs_sim *sim);

/* Redoes what a journal holds, after a crash, on the valve that it was started on (set or load that
 * first; MVS_E_STATE names its hash if it is another one), and goes on with the journal. A record
 * that was cut short by the crash is dropped. `replay` is nullable. */
MVS_API mvs_result mvs_recover_journal(mvs_sim *sim, const char *path, mvs_replay *replay);

#ifdef __cplusplus
}
#endif
#endif
