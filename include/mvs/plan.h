/* The surgical plan: all operations on a valve as a JSON file that can be replayed; and the
 * journal, which keeps every operation across a crash. formats/FORMAT.md describes both.
 *
 * A plan replayed on the same valve gives the same snapshot hash. On another valve parts are found
 * by name and places on leaflets by anatomical coordinates; a missing part is refused with a
 * sentence that names the step. Tools of a plan are added to those that exist, under other ids
 * where theirs are in use; existing tools do not change. */
#ifndef MVS_PLAN_H
#define MVS_PLAN_H

#include "base.h"
#include "op.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Optional contents of a plan besides the operations. */
typedef struct mvs_plan_options {
  uint32_t struct_size;
  uint32_t measures;  /* 1: the measures before and after each operation */
  const char *author; /* UTF-8, nullable */
  const char *notes;  /* UTF-8, nullable */
} mvs_plan_options;

/* Write the plan of a snapshot, from the valve that was set or loaded to the snapshot: to a file,
 * or to memory (at most `capacity` bytes; stores the number of bytes of the whole plan in *size;
 * `data` is nullable if `capacity` is 0). `options` is nullable. */
MVS_API mvs_result mvs_save_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options,
                                 const char *path);
MVS_API mvs_result mvs_write_plan(const mvs_snapshot *snapshot, const mvs_plan_options *options,
                                  void *data, uint64_t capacity, uint64_t *size);

/* Outcome of a replay. */
typedef struct mvs_replay {
  uint32_t struct_size;
  uint32_t operations;  /* operations applied */
  uint32_t same_valve;  /* 1: the plan was made on this valve */
  uint32_t same_result; /* 1: the final hash equals that of the plan; of a journal: its last record
                           was whole */
} mvs_replay;

/* Replays a plan, the text of its file, on the present valve: completely, or not at all with a
 * sentence about the step that failed. Settling and stepping are replayed as well; the progress
 * callback is called for each of them and can cancel (MVS_E_CANCELLED). `replay` is nullable. */
MVS_API mvs_result mvs_replay_plan(mvs_sim *sim, const void *data, uint64_t size,
                                   mvs_replay *replay);

/* Checks whether mvs_replay_plan would apply every operation of a plan, and that its tools exist
 * where it moves or removes them. The simulator does not change; settling is not replayed. Warns as
 * mvs_replay_plan of other units, from the calling thread. `sim` is nullable: what depends on no
 * valve is checked, such as keys and types. `replay` is nullable. */
MVS_API mvs_result mvs_check_plan(const mvs_sim *sim, const void *data, uint64_t size,
                                  mvs_replay *replay);

/* Start and end a journal of the present valve in a new file. While it is open, each operation,
 * undo, redo and checkpoint is on the disk before its call returns, or the call fails with MVS_E_IO
 * and nothing changes. Loads, settles and steps are written with the operation, undo, redo or
 * checkpoint that follows them: those after the last one are not in the journal. It fails as well
 * if the file was deleted meanwhile, and so does mvs_close_journal, which closes the journal all
 * the same. The history so far is written first, with its undone operations and its checkpoints.
 * MVS_E_STATE if the file exists; if the call fails, no file remains. One simulator at a time has a
 * journal open; mvs_recover_journal of another, in this or another process, gives MVS_E_STATE. A
 * journal of more than 1 GiB could not be read: the call that would make it so long fails with
 * MVS_E_STATE.
 *
 * A new valve ends the journal, with a warning in the log: also the same valve with other tissue
 * (mvs_set_leaflet) or another mesh, and a snapshot of another valve that is restored. Operations
 * after it are in no journal until one is opened again. */
MVS_API mvs_result mvs_open_journal(mvs_sim *sim, const char *path);
MVS_API mvs_result mvs_close_journal(mvs_sim *sim);

/* Repeats all records of a journal after a crash and continues the journal. The simulator must have
 * the valve on which the history began (given by mvs_set_valve or a file without a history), or the
 * session on which the journal was opened, as its file has it; MVS_E_STATE names the hash
 * otherwise. A last record that the crash cut short, or that is damaged, is dropped:
 * replay->same_result is 0 then. `replay` is nullable. */
MVS_API mvs_result mvs_recover_journal(mvs_sim *sim, const char *path, mvs_replay *replay);

#ifdef __cplusplus
}
#endif
#endif
