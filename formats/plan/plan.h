// Plans as JSON: the operations on a valve and the events between them, written and read strictly.
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

// One step of a plan: an event, or the JSON of an operation.
struct PlanStep {
  std::optional<RecordedEvent> event;
  Json op;                // null for an event
  Json place;             // of a grasp, for another valve (formats/plan/grasp.h); null without one
  std::string group;      // "" without a group
  uint64_t group_id = 0;  // distinguishes groups of the same name
};

struct Plan {
  std::string valve_hash, result_hash;  // 32 hexadecimal digits; "" if absent
  std::vector<PlanStep> steps;
};

// The hash of model and state as 32 hexadecimal digits.
std::string hash_text(const ModelState &current);

// The steps from the start of a history to its present. `measure` computes the measures of a model
// state for the step; an empty one omits them.
using Measure = std::function<Json(const ModelState &)>;
Json plan_steps(const Snapshot &snapshot, const Measure &measure);

// A whole plan.
struct PlanText {
  std::string author, notes;
};
std::string write_plan(const Snapshot &snapshot, const PlanText &text, const Measure &measure);

// Throws MVS_E_FORMAT or MVS_E_VERSION with the number of the wrong step.
Plan read_plan(std::string_view text);

// Throws MVS_E_FORMAT if a plan or the first record of a journal has no version, MVS_E_VERSION if
// it has another one.
void check_plan_version(const Json &json, const char *what);

// The steps of a plan or of a record of a journal; throws MVS_E_FORMAT with the step that is wrong.
std::vector<PlanStep> read_steps(const Json &record);

// The name and hash of the valve that a plan or journal starts from.
Json valve_json(const ModelState &start);

// With the model that it changes, a grasp has its place, for other valves.
Json event_json(const RecordedEvent &event, const Model *model = nullptr);
void add_events(Json &steps, const RecordedEvents &events, const Model *model = nullptr);

// An applied operation with its title, time and group.
Json entry_json(const HistoryEntry &entry);

// An operation with its parts by name in this model, and back. With `exact`, a site is the recorded
// node or triangle, otherwise its anatomical place.
Json op_json(const Operation &op, const Model &model);
Operation read_op(const Json &json, const Model &model, bool exact);

// Throws for keys, types and choices of an operation that read_op would refuse on any valve.
void check_op(const Json &json);

}  // namespace mvs::core
