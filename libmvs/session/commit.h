// Making a moment the present one of a simulator: the journal first.
#pragma once

#include "formats/plan/plan.h"
#include "session/simulator.h"

namespace mvs::core {

// Milliseconds since 1970 UTC.
int64_t now_ms();

// Makes `after` the present. Its record goes into the journal, if there is one, before anything
// counts; it is asked for only then.
using Record = std::function<Json(const Snapshot &after)>;
void commit(mvs_sim &sim, Snapshot after, const Record &record);

// Writes into the journal, if there is one, that a snapshot is restored. A snapshot of another
// valve ends it.
void restart_journal(mvs_sim &sim, const Snapshot &restored);

// The records of a journal.
Json begun_record(const Snapshot &snapshot);  // its first
Json steps_record(const Snapshot &before,
                  const Snapshot &after);  // operations applied since `before`
Json word_record(const char *word);        // undo, redo
Json named_record(const char *word, const std::string &name, const RecordedEvents &moves);

}  // namespace mvs::core
