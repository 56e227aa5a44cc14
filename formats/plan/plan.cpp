// The plan as a whole, and the moves between its operations.
#include "formats/plan/plan.h"

#include <mvs/base.h>
#include <mvs/sim.h>

#include <ctime>

#include "base/error.h"
#include "formats/plan/tool.h"

namespace mvs::core {
namespace {

constexpr const char *format_name = "mvs-plan";
constexpr size_t most_bytes = size_t{512} << 20;  // hours of a hand at 1 kHz

const char *solver_word(uint32_t solver) {
  switch (solver) {
    case MVS_SOLVER_NEWTON:
      return "newton";
    case MVS_SOLVER_IMPLICIT:
      return "implicit";
    case MVS_SOLVER_EXPLICIT:
      return "explicit";
    default:
      return "";
  }
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

uint32_t solver_at(const Json &json) {
  if (!json.has("solver")) return 0;
  const std::string word = json["solver"].is_text() ? json["solver"].text() : "";
  for (uint32_t solver = MVS_SOLVER_NEWTON; solver <= MVS_SOLVER_EXPLICIT; ++solver) {
    if (word == solver_word(solver)) return solver;
  }
  fail(MVS_E_FORMAT, "plan", "solver has to be newton, implicit or explicit");
}

// Throws unless each key of a move is one that it can have.
void check_keys(const Json &json, std::initializer_list<std::string_view> known) {
  for (const auto &[key, value] : json.members()) {
    const bool is_known = std::find(known.begin(), known.end(), key) != known.end();
    MVS_MUST(is_known, MVS_E_FORMAT, "plan", "%s has no field \"%.60s\"", json["do"].text().c_str(),
             key.c_str());
  }
}

void read_stepping(const Json &json, RecordedEvent &move) {
  move.solver = solver_at(json);
  move.dt = number_at(json, "dt_s");
  move.damping = number_at(json, "damping_1/s");
  move.budget = static_cast<uint32_t>(whole_at(json, "budget", 0, UINT32_MAX));
}

std::optional<RecordedEvent> read_move(const Json &json) {
  const std::string word = json["do"].text();
  RecordedEvent move;
  if (word == "load") {
    check_keys(json, {"do", "pressure_Pa", "boundary_fraction"});
    move.pressure = number_at(json, "pressure_Pa");
    move.boundary_fraction = number_at(json, "boundary_fraction");
    return move;
  }
  if (word == "lead") {
    check_keys(
        json, {"do", "count", "hands", "way_m", "pace", "solver", "dt_s", "damping_1/s", "budget"});
    move = read_lead(json);
    read_stepping(json, move);
    return move;
  }
  if (word != "settle" && word != "step") return read_tool_step(json);
  check_keys(json, {"do", "count", "solver", "max_iterations", "residual_N", "dt_s", "damping_1/s",
                    "budget"});
  move.kind = word == "settle" ? RecordedEvent::settle : RecordedEvent::step;
  MVS_MUST(move.kind == RecordedEvent::step || !json.has("count"), MVS_E_FORMAT, "plan",
           "settle has no field \"count\": settled once is settled");
  move.count = whole_at(json, "count", 1, RecordedEvent::most_count);
  move.max_iterations = static_cast<uint32_t>(whole_at(json, "max_iterations", 0, UINT32_MAX));
  move.residual = number_at(json, "residual_N");
  MVS_MUST(move.kind == RecordedEvent::step || !json.has("budget"), MVS_E_FORMAT, "plan",
           "settle has no field \"budget\": it goes on until the valve is at rest");
  read_stepping(json, move);
  return move;
}

std::string version_text() {
  return format("%d.%d.%d", MVS_VERSION_MAJOR, MVS_VERSION_MINOR, MVS_VERSION_PATCH);
}

PlanStep read_step(const Json &json) {
  MVS_MUST(json.is_object() && json.has("do") && json["do"].is_text(), MVS_E_FORMAT, "plan",
           "a step has to be an object with a \"do\"");
  PlanStep step;
  step.move = read_move(json);
  if (step.move) return step;
  step.op = json;
  if (!json.has("group")) return step;
  MVS_MUST(json["group"].is_text(), MVS_E_FORMAT, "plan", "group has to be a name");
  step.group = json["group"].text();
  step.group_id = whole_at(json, "group_id", 0, UINT64_MAX);
  return step;
}

Json parse(std::string_view text) {
  MVS_MUST(text.size() <= most_bytes, MVS_E_FORMAT, "plan", "the plan has %zu bytes, at most %zu",
           text.size(), most_bytes);
  return Json::parse(text);
}

void check_format(const Json &json) {
  MVS_MUST(json.is_object() && json.has("format") && json["format"].text() == format_name,
           MVS_E_FORMAT, "plan", "this is not a plan: it lacks \"format\": \"%s\"", format_name);
}

std::string hash_at(const Json &json, const char *part) {
  if (!json.has(part) || !json[part].is_object() || !json[part].has("hash")) return "";
  const Json &hash = json[part]["hash"];
  return hash.is_text() ? hash.text() : "";
}

}  // namespace

std::string hash_text(const ModelState &current) {
  const auto hash = hash_of(*current.model, current.state);
  return format("%016llx%016llx", static_cast<unsigned long long>(hash[0]),
                static_cast<unsigned long long>(hash[1]));
}

Json valve_json(const ModelState &start) {
  return Json::object({{"name", start.model->valve.name}, {"hash", hash_text(start)}});
}

Json move_json(const RecordedEvent &move) {
  Json json;
  if (move.kind == RecordedEvent::load) {
    json.set("do", "load");
    json.set("pressure_Pa", move.pressure);
    json.set("boundary_fraction", move.boundary_fraction);
    return json;
  }
  const bool is_led = move.kind == RecordedEvent::lead;
  if (!move.tool.empty() && !is_led) return tool_json(move);
  if (is_led) json = lead_json(move);
  if (!is_led) json.set("do", move.kind == RecordedEvent::settle ? "settle" : "step");
  if (!is_led && move.count != 1) json.set("count", move.count);
  if (move.solver != 0) json.set("solver", solver_word(move.solver));
  if (move.max_iterations != 0) json.set("max_iterations", move.max_iterations);
  put_unless_zero(json, "residual_N", move.residual);
  put_unless_zero(json, "dt_s", move.dt);
  put_unless_zero(json, "damping_1/s", move.damping);
  if (move.budget != 0) json.set("budget", move.budget);
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

void add_moves(Json &steps, const RecordedEvents &moves) {
  for (const RecordedEvent *move : moves.items()) steps.add(move_json(*move));
}

Json plan_steps(const Snapshot &snapshot, const Measure &measure) {
  Json steps = Json::array();
  const auto entries = snapshot.history.past.items();
  for (size_t k = 0; k < entries.size(); ++k) {
    const HistoryEntry &entry = **entries[k];
    add_moves(steps, entry.moves);
    Json json = entry_json(entry);
    if (measure) {
      json.set("before", measure(entry.before));
      // what it led to is seen just before the next operation, when the valve has settled
      json.set("after",
               measure(k + 1 < entries.size() ? (*entries[k + 1])->before : snapshot.current));
    }
    steps.add(std::move(json));
  }
  add_moves(steps, snapshot.history.moves);
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

std::vector<PlanStep> read_steps(const Json &record) {
  const Json &steps = record["steps"];
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
  MVS_MUST(json.has("steps"), MVS_E_FORMAT, "plan", "the plan has no \"steps\"");
  return {hash_at(json, "valve"), hash_at(json, "result"), read_steps(json)};
}

}  // namespace mvs::core
