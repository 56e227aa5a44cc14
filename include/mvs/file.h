/* Load and save: a valve with its state from and to a path or memory.
 *
 * Formats are chosen by MVS_FORMAT_* or, where AUTO, by the ending of the path. Files are written
 * beside their target and renamed, so a target is either the old file or the whole new one. */
#ifndef MVS_FILE_H
#define MVS_FILE_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

enum mvs_format_e {
  MVS_FORMAT_AUTO = 0,
  MVS_FORMAT_OBJ = 1, /* extended OBJ (formats/FORMAT.md), read and write, exact round trip */
  MVS_FORMAT_VTP = 2, /* VTK XML PolyData, write only: for ParaView and Slicer */
  MVS_FORMAT_H5 = 3,  /* HDF5, read and write: the history as well, to undo and redo in; ParaView
                         and h5py open it too. MVS_E_UNSUPPORTED in a build without HDF5 */
  MVS_FORMAT_INP = 4, /* Abaqus input, read only: shells, trusses, materials, prescribed nodes and
                         pressure. What a valve has no place for, and what had to be chosen, goes to
                         the log, MVS_LOG_WARNING. The valve is at rest, with the load of the file
                         set: mvs_get_load tells it, mvs_settle works towards it */
  MVS_FORMAT_FEB = 5  /* FEBio 4.0 model, write only: a valve at rest, to be closed there under the
                         load of the snapshot. MVS_E_UNSUPPORTED where FEBio lacks the law */
};
typedef uint32_t mvs_format;

/* Replaces the valve and state of a simulator by those of a file, and its history by that of an
 * HDF5 file, by an empty one else. The sentence of a failure begins
 * with "path: ", or "path:line: " for MVS_E_FORMAT. */
MVS_API mvs_result mvs_load_file(mvs_sim *sim, const char *path, uint32_t format);

/* The same from `size` bytes of memory; AUTO is MVS_FORMAT_OBJ. */
MVS_API mvs_result mvs_load_memory(mvs_sim *sim, const void *data, uint64_t size, uint32_t format);

/* Writes a snapshot to a path, over what is there. */
MVS_API mvs_result mvs_save_file(const mvs_snapshot *snapshot, const char *path, uint32_t format);

/* Writes a snapshot to memory: at most `capacity` bytes, and the true number to *size; AUTO is
 * MVS_FORMAT_OBJ. With capacity 0 (`data` nullable) only the size is told. */
MVS_API mvs_result mvs_save_memory(const mvs_snapshot *snapshot, uint32_t format, void *data,
                                   uint64_t capacity, uint64_t *size);

#ifdef __cplusplus
}
#endif
#endif
