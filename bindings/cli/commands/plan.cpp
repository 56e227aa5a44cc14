// `mvs plan show|check|replay`: prints a surgical plan, checks it against a valve, or replays it.
#include <cstdio>

#include "commands/commands.h"
#include "text/json_text.h"
#include "text/output_file.h"
#include "text/plan_file.h"
#include "text/readouts.h"

namespace cli {
namespace {

struct PlanOptions {
  std::string plan, on, out;
};

// One line per step.
std::string step_text(const Json &step) {
  std::string word = step.value("do", "?");
  if (step.contains("title")) return step.value("title", "");
  if (word == "load") return text("Load %.0f mmHg", step.value("pressure_Pa", 0.0) / pa_per_mmhg);
  if (word == "settle") return "Settle";
  if (word == "step") return text("Step %llu times", step.value("count", 1ull));
  if (word == "tool_trajectory")
    return text("Step %llu times with moving tools", step.value("count", 1ull));
  return word;
}

std::string number_text(const Json &measures, const char *key, double scale) {
  if (!measures.contains(key) || !measures[key].is_number()) return "-";
  return text("%.1f", scale * measures[key].get<double>());
}

std::string effect_text(const Json &step) {
  if (!step.contains("before") || !step.contains("after")) return "";
  const char *orifice = "regurgitant_orifice_area_m2", *height = "coaptation_height_m";
  return text("\n      orifice %s -> %s mm2, coaptation height %s -> %s mm",
              number_text(step["before"], orifice, 1e6).c_str(),
              number_text(step["after"], orifice, 1e6).c_str(),
              number_text(step["before"], height, 1e3).c_str(),
              number_text(step["after"], height, 1e3).c_str());
}

std::string plan_lines(const Json &plan) {
  const std::string name = plan.value("valve", Json::object()).value("name", "?");
  std::string lines = text("plan for valve \"%s\"", name.c_str());
  if (plan.contains("author")) lines += " by " + plan.value("author", "");
  if (plan.contains("notes")) lines += "\n" + plan.value("notes", "");
  size_t number = 0;
  for (const Json &step : plan["steps"]) {
    lines += text("\n%4zu  %s", ++number, step_text(step).c_str());
    if (step.contains("group")) lines += " [" + step.value("group", "") + "]";
    lines += effect_text(step);
  }
  return lines;
}

void show_plan(const PlanOptions &options, const Console &console) {
  std::string none;  // no fault: plan_text() has refused those
  const Json plan = parse_json(plan_text(options.plan), none);
  print(console, plan, plan_lines(plan));
}

void check_plan(const PlanOptions &options, const Console &console) {
  mvs::Simulator sim = make_sim();
  sim.load_file(options.on);
  const std::string plan = plan_text(options.plan);
  const mvs_replay replay = with_file_contents([&] { return sim.check_plan(plan); });
  print(
      console,
      {{"plan", options.plan},
       {"file", options.on},
       {"operations", replay.operations},
       {"same_valve", replay.same_valve != 0}},
      text("%s: all %u operations can be applied to %s%s", options.plan.c_str(), replay.operations,
           options.on.c_str(), replay.same_valve ? ", the valve of the plan" : ", another valve"));
}

void replay_plan(const PlanOptions &options, const Console &console) {
  demand_writable_valve(options.out);
  Progress progress(console);
  mvs::Simulator sim = load_sim(options.on, progress);
  const std::string plan = plan_text(options.plan);
  const mvs_replay done = with_file_contents([&] { return sim.replay_plan(plan); });
  const mvs::Snapshot valve = sim.snapshot();
  if (!options.out.empty()) valve.save(options.out);
  print(console,
        {{"plan", options.plan},
         {"file", options.on},
         {"operations", done.operations},
         {"same_valve", done.same_valve != 0},
         {"same_result", done.same_result != 0},
         {"hash", hash_of(valve)}},
        text("%s: %u operations applied to %s; %s", options.plan.c_str(), done.operations,
             options.on.c_str(),
             done.same_result  ? "the result of the plan, bit for bit"
             : done.same_valve ? "NOT the result of the plan: another version of libmvs or another "
                                 "machine?"
                               : "not the valve of the plan"));
}

using PlanRun = void (*)(const PlanOptions &, const Console &);

// `on_help`: help of the option --on; null: the subcommand has no such option.
std::pair<CLI::App *, PlanOptions *> add_part(CLI::App &plan, Console &console, const char *name,
                                              const char *help, const char *on_help, PlanRun run) {
  const auto added = add_command<PlanOptions>(plan, console, name, help, run);
  added.first->add_option("plan", added.second->plan, "plan, .json")->required();
  if (on_help) added.first->add_option("--on", added.second->on, on_help)->required();
  return added;
}

}  // namespace

void add_plan(CLI::App &app, Console &console) {
  CLI::App *plan = app.add_subcommand("plan", "show, check or replay a surgical plan");
  plan->require_subcommand(1);
  add_part(*plan, console, "show", "list the steps of a plan", nullptr, show_plan);
  add_part(*plan, console, "check", "check whether a plan can be applied to a valve",
           "valve to check it on", check_plan);
  const auto [replayed, options] =
      add_part(*plan, console, "replay", "apply the steps of a plan to a valve",
               "valve to apply it to", replay_plan);
  replayed->add_option("-o,--output", options->out, "write the resulting valve");
}

}  // namespace cli
