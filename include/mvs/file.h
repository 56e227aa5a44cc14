/* Loading and saving a valve with its state, from and to files or memory.
 *
 * Formats are chosen by MVS_FORMAT_* or, where AUTO, by the ending of the path, in small or capital
 * letters. Files are written beside their target and then renamed: a target is either the old file
 * or the complete new one. The target of a symbolic link is written, also where it does not exist
 * yet; the link stays. */
#ifndef MVS_FILE_H
#define MVS_FILE_H

#include "base.h"
#include "sim.h"
#include "snapshot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* File formats. */
enum mvs_format_e {
  MVS_FORMAT_AUTO = 0,
  MVS_FORMAT_OBJ = 1, /* extended OBJ (formats/FORMAT.md), read and write, exact round
                         trip of valve and state without tools and history. A state that
                         the file says is at rest, but whose largest out-of-balance force is
                         above twice its tolerance, is not at rest: MVS_LOG_WARNING */
  MVS_FORMAT_VTP = 2, /* VTK XML PolyData, write only: for ParaView and Slicer */
  MVS_FORMAT_H5 = 3,  /* HDF5, read and write, with the history for undo and redo; ParaView and h5py
                         can open it. MVS_E_UNSUPPORTED in a build without HDF5 */
  MVS_FORMAT_INP = 4, /* Abaqus input, read only: shells, trusses, materials, prescribed nodes and
                         pressure. Ignored keywords and assumptions are logged, MVS_LOG_WARNING. The
                         valve is at rest; its load is that of the file */
  MVS_FORMAT_FEB = 5, /* FEBio 4.0 model, write only: the valve at rest with the load of the
                         snapshot. MVS_E_UNSUPPORTED where FEBio lacks the law */
  MVS_FORMAT_VTM = 6 /* VTK XML multiblock dataset, write only, to a path: an index and the files of
                        its blocks in a folder of the same name: valve, orifice if there is one,
                        coaptation_line if leaflets touch */
};
typedef uint32_t mvs_format;

/* Replaces valve and state of a simulator by those of a file, and its history by that of an HDF5
 * file; other formats give an empty history. The sentence of a failure begins with "path: ", or
 * "path:line: " for MVS_E_FORMAT and for a faulty part of an OBJ file, MVS_E_OP. */
MVS_API mvs_result mvs_load_file(mvs_sim *sim, const char *path, mvs_format format);

/* Loads from `size` bytes of memory; AUTO is MVS_FORMAT_OBJ. */
MVS_API mvs_result mvs_load_memory(mvs_sim *sim, const void *data, uint64_t size,
                                   mvs_format format);

/* Writes a snapshot to a file, which is replaced if it exists. MVS_E_IO, with the remedy, if it
 * cannot be written or replaced: the old file stays, and no other remains. */
MVS_API mvs_result mvs_save_file(const mvs_snapshot *snapshot, const char *path, mvs_format format);

/* Writes a snapshot to memory: at most `capacity` bytes; stores the number of bytes of the whole
 * file in *size. AUTO is MVS_FORMAT_OBJ. `data` is nullable if `capacity` is 0. */
MVS_API mvs_result mvs_save_memory(const mvs_snapshot *snapshot, mvs_format format, void *data,
                                   uint64_t capacity, uint64_t *size);

#ifdef __cplusplus
}
#endif
#endif
