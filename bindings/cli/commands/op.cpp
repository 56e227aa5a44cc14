// `mvs op`: applies one surgical operation to the valve of a file. The subcommands and their
// options are built from the library's description of its operations (mvs::op_kinds).
#include <algorithm>
#include <map>
#include <optional>

#include "commands/commands.h"
#include "text/command_units.h"
#include "text/op_text.h"
#include "text/output_file.h"
#include "text/readouts.h"
#include "valve/at_rest.h"
#include "valve/pressure.h"
#include "valve/slack_chordae.h"

namespace cli {
namespace {

struct OpRequest {
  mvs::OpKind kind;
  std::string in, out;
  bool settle = false, allow_unsettled = false;
  std::optional<double> settle_mmhg;
  std::map<std::string, std::string> fields;  // the given ones, as text
};

struct Operated {
  mvs::Snapshot valve;
  std::string title;
  mvs_id made;
  std::vector<AtRest> at_rest;    // before and after, with --settle
  double pressure_mmhg;           // of both
  std::vector<SlackChord> slack;  // chordae attached in vain, with --settle
};

// Both closures start from the shape in the file.
Operated operate(const OpRequest &request, const Console &console) {
  Progress progress(console);
  mvs::Simulator sim = load_sim(request.in, progress, with_workers(console));
  const mvs::Snapshot first = sim.snapshot();
  OpText op(request.kind);
  for (const auto &[name, given] : request.fields) op.set(name, given, first);
  const auto check = [&] { with_command_units([&] { sim.check(op.get()); }); };
  op.has_points() ? with_file_contents(check) : check();
  std::vector<AtRest> at_rest;
  const double pressure_mmhg = pressure_mmhg_of(request.settle_mmhg, sim);
  if (request.settle) {
    at_rest.push_back(settle(sim, pressure_mmhg, request.in + " before"));
    sim.restore(first);
  }
  const mvs_id made = with_command_units([&] { return sim.apply(op.get()); });
  const std::string title = sim.snapshot().history().done.back().title;
  std::vector<SlackChord> slack;
  if (request.settle) {
    at_rest.push_back(settle(sim, pressure_mmhg, request.in + " after"));
    slack = slack_new_chordae(at_rest.back());
  }
  return {sim.snapshot(), title, made, at_rest, pressure_mmhg, slack};
}

std::optional<mvs_part> part_of(const mvs::Snapshot &valve, mvs_id id) {
  if (id == 0) return {};
  for (const uint32_t kind : {MVS_PART_CHORD, MVS_PART_RING, MVS_PART_HEAD}) {
    for (const mvs_part &part : valve.parts(kind)) {
      if (part.id == id) return part;
    }
  }
  return {};
}

Json operated_json(const OpRequest &request, const Operated &done) {
  Json object = {{"file", request.in},
                 {"operation", request.kind.info.name},
                 {"title", done.title},
                 {"made", nullptr},
                 {"hash", hash_of(done.valve)}};
  if (const auto part = part_of(done.valve, done.made)) {
    object["made"] = {{"id", part->id}, {"name", part->name}};
  }
  if (!request.out.empty()) object["output"] = request.out;
  if (!done.at_rest.empty()) {
    object["pressure_mmHg"] = done.pressure_mmhg;
    object["before"] = at_rest_json(done.at_rest[0]);
    object["after"] = at_rest_json(done.at_rest[1]);
    object["slack_new_chordae"] = slack_json(done.slack);
  }
  return object;
}

std::string operated_text(const OpRequest &request, const Operated &done) {
  std::string lines = request.in + ": " + done.title;
  if (const auto part = part_of(done.valve, done.made)) lines += text(" (made %s)", part->name);
  if (!request.out.empty()) lines += "\nwritten to " + request.out;
  if (done.at_rest.empty()) return lines;
  const auto word = [](const AtRest &at_rest) {
    return at_rest.stats.converged ? "at rest" : "NOT at rest";
  };
  return lines +
         text("\nbefore (%s) and after (%s), under %g mmHg\n", word(done.at_rest[0]),
              word(done.at_rest[1]), done.pressure_mmhg) +
         measures_text(done.at_rest[0].measures, done.at_rest[1].measures);
}

void run_op(const OpRequest &request, Console &console) {
  if (request.out.empty() && !request.settle) throw CLI::RequiredError("--output or --settle");
  demand_writable_valve(request.out);
  const Operated done = operate(request, console);
  if (!request.out.empty()) done.valve.save(request.out);
  print(console, operated_json(request, done), operated_text(request, done));
  for (const AtRest &closed : done.at_rest) {
    demand_rest(console, closed.stats, request.allow_unsettled);
  }
}

// Option names have dashes in place of underscores.
std::string dashed(std::string name) {
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

void add_field(CLI::App &command, OpRequest &request, const mvs_field_info &field) {
  std::string range;
  if (field.type == MVS_FIELD_NUMBER || field.type == MVS_FIELD_COUNT) {
    range = text("; %g to %g", in_text(field, field.low), in_text(field, field.high));
  }
  const auto keep = [&request, name = std::string(field.name)](const std::string &given) {
    request.fields[name] = given;
  };
  command.add_option_function<std::string>("--" + dashed(field.name), keep, help_of(field) + range)
      ->required(field.required != 0)
      ->type_name(form_of(field))
      ->check([field](const std::string &given) { return complaint(field, given); });
}

void add_kind(CLI::App &op, Console &console, const mvs::OpKind &kind,
              const std::shared_ptr<std::string> &file) {
  auto request = std::make_shared<OpRequest>();
  request->kind = kind;
  CLI::App *command = add_command(op, console, dashed(kind.info.name), kind.info.help);
  if (dashed(kind.info.name) != kind.info.name) command->alias(kind.info.name);  // as in plans
  for (const mvs_field_info &field : kind.fields) add_field(*command, *request, field);
  command->add_option("-o,--output", request->out, "write the valve, .obj, .h5, .vtp or .vtm")
      ->type_name("FILE");
  const CLI::Option *settle =
      add_pressure_option(*command, request->settle_mmhg, "--settle",
                          "close and measure the valve before and after, at this pressure")
          ->expected(0, 1);
  add_unsettled_option(*command, request->allow_unsettled);
  add_workers_option(*command, console);
  add_progress_flag(*command, console);
  command->callback([request, file, settle, &console] {
    request->settle = settle->count() > 0;
    if (file->empty()) throw CLI::RequiredError("file");
    request->in = *file;
    run_op(*request, console);
  });
}

std::vector<std::string> operation_names() {
  std::vector<std::string> names;
  for (const mvs::OpKind &kind : mvs::op_kinds()) names.push_back(dashed(kind.info.name));
  return names;
}

}  // namespace

void add_op(CLI::App &app, Console &console) {
  auto file = std::make_shared<std::string>();
  CLI::App *command =
      add_command(app, console, "op", "operate on a valve: mvs op FILE OPERATION, see --help");
  // not `required`: the parser would then take "ring" for the file in `mvs op ring --help`
  command->add_option("file", *file, "valve to operate on, .obj or .h5");
  // takes the word that is no subcommand, so that its error lists the operations
  command
      ->add_option_function<std::string>(
          "operation", [](const std::string &) {}, "one of the operations below")
      ->check(one_of(operation_names()).description(""));
  command->require_subcommand(0, 1);
  command->callback([command] {
    if (command->get_subcommands().empty()) {
      throw CLI::RequiredError("an operation (mvs op --help lists them)");
    }
  });
  command->footer(
      "Lengths are in mm, areas in mm2, moduli in MPa. A site on a leaflet is P2:0.5:0.9 (share "
      "along the scallop,\nshare from annulus to free edge), node:17, or "
      "triangle:12:0.3:0.3:0.4;\nnodes and triangles count from 0, vertices of an OBJ file from 1. "
      "Points are a text file with one x,y,z per line.\n--settle "
      "operates on the valve as given, `mvs sweep` on the closed one: give a closed valve (mvs "
      "close -o) for the\nsame figures.");
  for (const mvs::OpKind &kind : mvs::op_kinds()) add_kind(*command, console, kind, file);
}

}  // namespace cli
