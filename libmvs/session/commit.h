// Commit of a transaction: writes the journal record to the disk, then replaces the present
// snapshot.
#pragma once

#include "formats/plan/plan.h"
#include "session/simulator.h"

namespace mvs::core {

// Milliseconds since 1970 UTC.
int64_t now_ms();

// Makes `after` the present snapshot. If a journal is open, its record is built and written first;
// a failure leaves the simulator unchanged. Prepares the next time step, unless a group is open.
using Record = std::function<Json(const Snapshot &after)>;
void commit(mvs_sim &sim, Snapshot after, const Record &record);

// Writes a restart record into an open journal. A snapshot of another valve closes the journal.
void restart_journal(mvs_sim &sim, const Snapshot &restored);

// Journal records.
Json begun_record(const Snapshot &snapshot);  // its first
Json steps_record(const Snapshot &before,
                  const Snapshot &after);  // operations applied since `before`
Json word_record(const char *word);        // undo, redo
Json named_record(const char *word, const std::string &name, const RecordedEvents &events);

}  // namespace mvs::core
