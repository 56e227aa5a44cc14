// The plan as JSON: operations and what was done between them, to text and back.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/text/json.h"
#include "history/history.h"

namespace mvs::core {

// The version of plans and journals. A file of another version is refused.
inline constexpr unsigned plan_version = 1;

// One step of a plan: a move, or an operation as it stands in the file.
struct PlanStep {
  std::optional<RecordedEvent> move;
  Json op;                // null for a move
  std::string group;      // "" for none
  uint64_t group_id = 0;  // tells groups of one name apart
};

struct Plan {
  std::string valve_hash, result_hash;  // 32 hexadecimal digits; "" where not told
  std::vector<PlanStep> steps;
};

// "0123456789abcdef0123456789abcdef"
std::string hash_text(const ModelState &current);

// The steps that lead from the start of a history to its moment. `measures` is asked for what each
// picture measures; it may be empty.
using Measure = std::function<Json(const ModelState &)>;
Json plan_steps(const Snapshot &snapshot, const Measure &measure);

// A whole plan.
struct PlanText {
  std::string author, notes;
};
std::string write_plan(const Snapshot &snapshot, const PlanText &text, const Measure &measure);

// Throws MVS_E_FORMAT or MVS_E_VERSION with the step that is wrong.
Plan read_plan(std::string_view text);

// Throws MVS_E_FORMAT if a plan or the first record of a journal has no version, MVS_E_VERSION if
// it has another one.
void check_plan_version(const Json &json, const char *what);

// The steps of a plan or of a record of a journal; throws MVS_E_FORMAT with the step that is wrong.
std::vector<PlanStep> read_steps(const Json &record);

// The valve that a plan or journal belongs to.
Json valve_json(const ModelState &start);

Json move_json(const RecordedEvent &move);
void add_moves(Json &steps, const RecordedEvents &moves);

// An operation that was applied, with its title, time and group.
Json entry_json(const HistoryEntry &entry);

// An operation with the names of its parts in this model, and back. In `exact` replay a site is the
// node or triangle that it was, else its anatomical place.
Json op_json(const Operation &op, const Model &model);
Operation read_op(const Json &json, const Model &model, bool exact);

}  // namespace mvs::core
