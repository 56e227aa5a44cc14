// `mvs plan show|check|replay`: a surgical plan, looked at, tried, and done again.
#include <cstdio>
#include <memory>

#include "commands.h"
#include "plan_file.h"
#include "readouts.h"

namespace cli {
namespace {

struct Options {
  std::string plan, on, out;
};

// One line a step: what a surgeon reads.
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
  return text("      orifice %s -> %s mm2, coaptation height %s -> %s mm\n",
              number_text(step["before"], orifice, 1e6).c_str(),
              number_text(step["after"], orifice, 1e6).c_str(),
              number_text(step["before"], height, 1e3).c_str(),
              number_text(step["after"], height, 1e3).c_str());
}

void show(const Options &options, const Console &console) {
  const Json plan = Json::parse(plan_text(options.plan));
  std::string lines =
      text("plan for valve \"%s\"", plan.value("valve", Json::object()).value("name", "?").c_str());
  if (plan.contains("author")) lines += " by " + plan.value("author", "");
  if (plan.contains("notes")) lines += "\n" + plan.value("notes", "");
  size_t number = 0;
  for (const Json &step : plan["steps"]) {
    lines += text("\n%4zu  %s", ++number, step_text(step).c_str());
    if (step.contains("group")) lines += " [" + step.value("group", "") + "]";
    const std::string effect = effect_text(step);
    if (!effect.empty()) lines += "\n" + effect.substr(0, effect.size() - 1);
  }
  print(console, plan, lines);
}

void check(const Options &options, const Console &console) {
  mvs::Sim sim = make_sim();
  sim.load_file(options.on);
  const mvs_replay replay = sim.check_plan(plan_text(options.plan));
  print(console,
        {{"plan", options.plan},
         {"file", options.on},
         {"operations", replay.operations},
         {"same_valve", replay.same_valve != 0}},
        text("%s: all %u operations can be done on %s%s", options.plan.c_str(), replay.operations,
             options.on.c_str(),
             replay.same_valve ? ", the valve that it was made on" : ", another valve"));
}

void replay(const Options &options, const Console &console) {
  Progress progress(console);
  mvs::Sim sim = load_sim(options.on, progress);
  const mvs_replay how = sim.replay_plan(plan_text(options.plan));
  const mvs::Snapshot valve = sim.snapshot();
  if (!options.out.empty()) valve.save(options.out);
  print(console,
        {{"plan", options.plan},
         {"file", options.on},
         {"operations", how.operations},
         {"same_valve", how.same_valve != 0},
         {"same_result", how.same_result != 0},
         {"hash", hash_of(valve)}},
        text("%s: %u operations done on %s; %s", options.plan.c_str(), how.operations,
             options.on.c_str(),
             how.same_result ? "bit for bit what the plan led to"
                             : (how.same_valve ? "NOT what the plan led to: another version of "
                                                 "libmvs, or another machine?"
                                               : "another valve than the plan's")));
}

CLI::App *add_part(CLI::App &plan, Console &console, const char *name, const char *what,
                   const std::shared_ptr<Options> &options) {
  CLI::App *part = add_command(plan, console, name, what);
  part->add_option("plan", options->plan, "plan, .json")->required();
  return part;
}

}  // namespace

void add_plan(CLI::App &app, Console &console) {
  auto options = std::make_shared<Options>();
  CLI::App *plan = app.add_subcommand("plan", "show, check or replay a surgical plan");
  plan->require_subcommand(1);
  add_part(*plan, console, "show", "list the steps of a plan", options)->callback([=, &console] {
    show(*options, console);
  });
  CLI::App *checked = add_part(*plan, console, "check", "try a plan without doing it", options);
  checked->add_option("--on", options->on, "valve to try it on")->required();
  checked->callback([=, &console] { check(*options, console); });
  CLI::App *replayed = add_part(*plan, console, "replay", "do a plan again, step by step", options);
  replayed->add_option("--on", options->on, "valve to do it on")->required();
  replayed->add_option("-o,--output", options->out, "write the valve it leads to");
  replayed->callback([=, &console] { replay(*options, console); });
}

}  // namespace cli
