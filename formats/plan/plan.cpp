// Plans and journal records as JSON: writer and strict reader.
#include "formats/plan/plan.h"

#include <mvs/base.h>

#include <algorithm>
#include <ctime>

#include "base/error.h"
#include "formats/plan/tool.h"
#include "formats/text/checksum.h"
#include "history/event_limits.h"
#include "model/text.h"

namespace mvs::core {
namespace {

constexpr const char *format_name = "mvs-plan";
constexpr size_t most_bytes = size_t{512} << 20;  // hours of a hand at 1 kHz

const char *solver_word(SolverKind solver) {
  switch (solver) {
    case SolverKind::newton:
      return "newton";
    case SolverKind::implicit_euler:
      return "implicit";
    case SolverKind::explicit_euler:
      return "explicit";
    case SolverKind::unset:
      break;
  }
  return "";
}

// "2026-11-21T14:05:09.123Z"
std::string time_text(int64_t ms) {
  const std::time_t seconds = ms / 1000;
  std::tm utc = {};
  gmtime_r(&seconds, &utc);
  return format("%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", utc.tm_year + 1900, utc.tm_mon + 1,
                utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec, static_cast<int>(ms % 1000));
}

void put_unless_zero(Json &json, const char *key, double value) {
  if (value != 0) json.set(key, value);
}

double number_at(const Json &json, const char *key) {
  if (!json.has(key)) return 0;
  MVS_MUST(json[key].is_number(), MVS_E_FORMAT, "plan", "%s has to be a number", key);
  return json[key].number();
}

uint64_t whole_at(const Json &json, const char *key, uint64_t fallback, uint64_t most) {
  if (!json.has(key)) return fallback;
  MVS_MUST(json[key].is_whole() && json[key].whole() <= most, MVS_E_FORMAT, "plan",
           "%s has to be a whole number of at most %llu", key,
           static_cast<unsigned long long>(most));
  return json[key].whole();
}

SolverKind solver_at(const Json &json) {
  if (!json.has("solver")) return SolverKind::unset;
  const std::string word = json["solver"].is_text() ? json["solver"].text() : "";
  for (const SolverKind solver :
       {SolverKind::newton, SolverKind::implicit_euler, SolverKind::explicit_euler}) {
    if (word == solver_word(solver)) return solver;
  }
  fail(MVS_E_FORMAT, "plan", "solver has to be newton, implicit or explicit");
}

void read_step_options(const Json &json, RecordedEvent &event) {
  event.solver = solver_at(json);
  event.dt = number_at(json, "dt_s");
  event.damping = number_at(json, "damping_1/s");
  event.budget = static_cast<uint32_t>(whole_at(json, "budget", 0, UINT32_MAX));
}

std::optional<RecordedEvent> unchecked_event(const Json &json) {
  const std::string word = json["do"].text();
  RecordedEvent event;
  if (word == "load") {
    check_keys(json, {"pressure_Pa", "boundary_fraction"});
    event.pressure = number_at(json, "pressure_Pa");
    event.boundary_fraction = number_at(json, "boundary_fraction");
    return event;
  }
  if (word == "tool_trajectory") {
    check_keys(json, {"count", "tools", "points_m", "steps_per_row", "solver", "dt_s",
                      "damping_1/s", "budget"});
    event = read_trajectory(json);
    read_step_options(json, event);
    return event;
  }
  if (word != "settle" && word != "step") return read_tool_step(json);
  check_keys(json,
             {"count", "solver", "max_iterations", "residual_N", "dt_s", "damping_1/s", "budget"});
  event.kind = word == "settle" ? RecordedEvent::settle : RecordedEvent::step;
  const bool is_step = event.kind == RecordedEvent::step;
  MVS_MUST(is_step || !json.has("count"), MVS_E_FORMAT, "plan",
           "settle has no field \"count\": a second settle changes nothing");
  MVS_MUST(is_step || !json.has("budget"), MVS_E_FORMAT, "plan",
           "settle has no field \"budget\": it iterates until the valve is at rest");
  event.count = whole_at(json, "count", 1, RecordedEvent::most_count);
  event.max_iterations = static_cast<uint32_t>(whole_at(json, "max_iterations", 0, UINT32_MAX));
  event.residual = number_at(json, "residual_N");
  read_step_options(json, event);
  return event;
}

std::optional<RecordedEvent> read_event(const Json &json) {
  std::optional<RecordedEvent> event = unchecked_event(json);
  if (!event) return event;
  const std::string fault = fault_of(*event);
  MVS_MUST(fault.empty(), MVS_E_FORMAT, "plan", "%s: %s", json["do"].text().c_str(), fault.c_str());
  return event;
}

std::string version_text() {
  return format("%d.%d.%d", MVS_VERSION_MAJOR, MVS_VERSION_MINOR, MVS_VERSION_PATCH);
}

bool is_group_name(const std::string &name) {
  return name.size() <= name_limit && is_plain_text(name);
}

// The values that a reader of the plan shows to people.
void check_remarks(const Json &json, std::initializer_list<const char *> texts) {
  for (const char *key : texts) {
    MVS_MUST(!json.has(key) || json[key].is_text(), MVS_E_FORMAT, "plan", "%s has to be a text",
             key);
  }
}

PlanStep read_step(const Json &json) {
  MVS_MUST(json.is_object() && json.has("do") && json["do"].is_text(), MVS_E_FORMAT, "plan",
           "a step has to be an object with a \"do\"");
  check_remarks(json, {"title"});
  PlanStep step;
  step.event = read_event(json);
  if (step.event) {
    if (json.has("place")) step.place = json["place"];
    return step;
  }
  step.op = json;
  if (!json.has("group")) return step;
  MVS_MUST(json["group"].is_text() && is_group_name(json["group"].text()), MVS_E_FORMAT, "plan",
           "group has to be a name of at most %zu bytes without control characters", name_limit);
  step.group = json["group"].text();
  step.group_id = whole_at(json, "group_id", 0, UINT64_MAX);
  return step;
}

Json parse(std::string_view text) {
  MVS_MUST(text.size() <= most_bytes, MVS_E_FORMAT, "plan", "the plan has %zu bytes, at most %zu",
           text.size(), most_bytes);
  return Json::parse(text, true);
}

void check_format(const Json &json) {
  MVS_MUST(json.is_object() && json.has("format") && json["format"].text() == format_name,
           MVS_E_FORMAT, "plan", "this is not a plan: it lacks \"format\": \"%s\"", format_name);
}

void check_plan_keys(const Json &json) {
  static constexpr std::string_view known[] = {"format", "version", "libmvs", "units", "valve",
                                               "author", "notes",   "steps",  "result"};
  for (const auto &[key, value] : json.members()) {
    MVS_MUST(std::find(std::begin(known), std::end(known), key) != std::end(known), MVS_E_FORMAT,
             "plan", "a plan has no field \"%.60s\"", key.c_str());
  }
}

void check_valve(const Json &json) {
  if (!json.has("valve")) return;
  MVS_MUST(json["valve"].is_object(), MVS_E_FORMAT, "plan", "valve has to be an object");
  check_remarks(json["valve"], {"name", "hash"});
}

std::string hash_at(const Json &json, const char *part) {
  if (!json.has(part) || !json[part].is_object() || !json[part].has("hash")) return "";
  const Json &hash = json[part]["hash"];
  return hash.is_text() ? hash.text() : "";
}

}  // namespace

std::string hash_text(const ModelState &current) {
  return hash_digits(hash_of(*current.model, current.state));
}

Json valve_json(const ModelState &start) {
  return Json::object({{"name", start.model->valve.name}, {"hash", hash_text(start)}});
}

Json event_json(const RecordedEvent &event, const Model *model) {
  Json json;
  if (event.kind == RecordedEvent::load) {
    json.set("do", "load");
    json.set("pressure_Pa", event.pressure);
    json.set("boundary_fraction", event.boundary_fraction);
    return json;
  }
  const bool is_trajectory = event.kind == RecordedEvent::tool_trajectory;
  if (!event.tools.empty() && !is_trajectory) return tool_json(event, model);
  if (is_trajectory) {
    json = trajectory_json(event);
  } else {
    json.set("do", event.kind == RecordedEvent::settle ? "settle" : "step");
    if (event.count != 1) json.set("count", event.count);
  }
  if (event.solver != SolverKind::unset) json.set("solver", solver_word(event.solver));
  if (event.max_iterations != 0) json.set("max_iterations", event.max_iterations);
  put_unless_zero(json, "residual_N", event.residual);
  put_unless_zero(json, "dt_s", event.dt);
  put_unless_zero(json, "damping_1/s", event.damping);
  if (event.budget != 0) json.set("budget", event.budget);
  return json;
}

Json entry_json(const HistoryEntry &entry) {
  Json json = op_json(entry.op, *entry.before.model);
  json.set("title", entry.title);
  if (entry.time_ms != 0) json.set("time", time_text(entry.time_ms));
  if (entry.group == 0) return json;
  json.set("group", entry.group_name);
  json.set("group_id", entry.group);
  return json;
}

void add_events(Json &steps, const RecordedEvents &events, const Model *model) {
  for (const RecordedEvent *event : events.items()) steps.add(event_json(*event, model));
}

Json plan_steps(const Snapshot &snapshot, const Measure &measure) {
  Json steps = Json::array();
  const auto entries = snapshot.history.past.items();
  for (size_t k = 0; k < entries.size(); ++k) {
    const HistoryEntry &entry = **entries[k];
    add_events(steps, entry.events, entry.before.model.get());
    Json json = entry_json(entry);
    if (measure) {
      json.set("before", measure(entry.before));
      // measured just before the next operation, when the valve has settled
      json.set("after",
               measure(k + 1 < entries.size() ? (*entries[k + 1])->before : snapshot.current));
    }
    steps.add(std::move(json));
  }
  add_events(steps, snapshot.history.events, snapshot.current.model.get());
  return steps;
}

std::string write_plan(const Snapshot &snapshot, const PlanText &text, const Measure &measure) {
  Json json;
  json.set("format", format_name);
  json.set("version", plan_version);
  json.set("libmvs", version_text());
  json.set("units", "SI: m, N, Pa, s");
  json.set("valve", valve_json(*start_of(snapshot)));
  if (!text.author.empty()) json.set("author", text.author);
  if (!text.notes.empty()) json.set("notes", text.notes);
  json.set("steps", plan_steps(snapshot, measure));
  json.set("result", Json::object({{"hash", hash_text(snapshot.current)}}));
  return json.page() + "\n";
}

void check_plan_version(const Json &json, const char *what) {
  MVS_MUST(json.has("version"), MVS_E_FORMAT, what, "the %s has no version", what);
  const uint64_t version = whole_at(json, "version", 0, UINT64_MAX);
  MVS_MUST(version == plan_version, MVS_E_VERSION, what,
           "the %s has version %llu, this libmvs reads version %u", what,
           static_cast<unsigned long long>(version), plan_version);
}

std::vector<PlanStep> read_steps(const Json &steps) {
  MVS_MUST(steps.is_array(), MVS_E_FORMAT, "plan", "\"steps\" has to be a list");
  std::vector<PlanStep> out;
  for (size_t k = 0; k < steps.items().size(); ++k) {
    try {
      out.push_back(read_step(steps.items()[k]));
    } catch (const Error &error) {
      fail(error.code, format("step %zu", k + 1), "step %zu: %s", k + 1, error.what());
    }
  }
  return out;
}

Plan read_plan(std::string_view text) {
  const Json json = parse(text);
  check_format(json);
  check_plan_version(json, "plan");
  check_plan_keys(json);
  check_remarks(json, {"author", "notes"});
  check_valve(json);
  MVS_MUST(json.has("steps"), MVS_E_FORMAT, "plan", "the plan has no \"steps\"");
  return {hash_at(json, "valve"), hash_at(json, "result"), read_steps(json["steps"])};
}

}  // namespace mvs::core
