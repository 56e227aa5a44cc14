// `mvs sweep`: applies every combination of values of operations to a closed valve, settles and
// measures it, in several processes, and writes a table with one row for each combination.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "commands/commands.h"
#include "text/op_forms.h"
#include "text/readouts.h"
#include "text/sweep_table.h"
#include "valve/at_rest.h"
#include "valve/cost.h"
#include "valve/pressure.h"
#include "valve/processes.h"

namespace cli {
namespace {

constexpr size_t most_shown = 10;

struct SweepOptions {
  std::string file, csv, sort;
  std::vector<std::string> ops;
  std::optional<double> pressure_mmhg;
  unsigned jobs = core_count();
  bool largest = false, cost = false;
  CostOptions cost_options;
};

// The closed valve to which every combination is applied, and how a row is made of it.
struct Sweep {
  SweepGrid grid;
  mvs::Snapshot closed;
  SweepConditions conditions;
  std::optional<CostMeter> cost;
};

SweepGrid grid_of(const SweepOptions &options) {
  std::vector<SweepOp> ops;
  for (const std::string &given : options.ops) ops.push_back(read_sweep_op(given));
  return SweepGrid(std::move(ops));
}

// Every combination starts from the same bits in a new simulator, whichever process does it.
AtRest close_combination(const Sweep &sweep, size_t combination) {
  mvs_sim_desc desc = {};
  desc.progress = [](void *, double, double) -> int32_t { return InterruptFlag::is_set(); };
  mvs::Simulator sim = make_sim(desc);
  sim.restore(sweep.closed);
  sweep.grid.apply(combination, sim);
  return settle(sim, sweep.conditions.pressure_mmhg,
                "combination " + CLI::detail::join(sweep.grid.values(combination), " "));
}

// A failure of the run, not of the combination: without a row, the next run closes it again.
bool is_of_run(const mvs::Error &failure) {
  return failure.code() == MVS_E_MEMORY || failure.code() == MVS_E_INTERNAL;
}

// A combination that cannot be applied is a row with the reason instead of measures.
CsvRow row_of(const Sweep &sweep, size_t combination) {
  CsvRow row = sweep.grid.values(combination);
  std::string error;
  try {
    const AtRest at_rest = close_combination(sweep, combination);
    row.push_back(cell_of(at_rest.stats.converged != 0));
    row.push_back(cell_of(at_rest.stats.residual));
    row.push_back(cell_of(at_rest.measures.intersections));
    std::optional<mvs_cost> cost;
    if (sweep.cost) cost = sweep.cost->of(at_rest.valve).figures;
    const Json figures = figures_json(at_rest.measures, cost ? &*cost : nullptr);
    for (const auto &[key, value] : figures.items()) row.push_back(cell_of(value));
  } catch (const mvs::Error &failure) {
    if (is_of_run(failure)) throw;
    error = failure.what();
    row.resize(sweep.grid.columns().size() + 1 + measure_keys(sweep.cost.has_value()).size());
  }
  row.push_back(cell_of(sweep.conditions.pressure_mmhg));
  row.push_back(sweep.conditions.valve);
  if (sweep.grid.has_files()) row.push_back(sweep.grid.files(combination));
  if (sweep.cost) row.push_back(sweep.conditions.cost);
  row.push_back(error);
  return row;
}

Json best_json(const SweepTable &table, const CsvRow &row) {
  Json object = Json::object();
  for (size_t k = 0; k < row.size(); ++k) {
    double number = 0;
    const bool is_value =
        !table.is_text(k) && (read_number(row[k], number) || row[k] == "true" || row[k] == "false");
    object[table.columns()[k]] = row[k].empty() ? Json()
                                 : is_value     ? Json::parse(row[k], nullptr, false)
                                                : Json(row[k]);
  }
  return object;
}

std::string best_text(const SweepTable &table, const std::vector<CsvRow> &best,
                      const SweepOptions &options, size_t parameters) {
  std::string lines =
      text("\n%s, %s first", options.sort.c_str(), options.largest ? "largest" : "smallest");
  if (best.empty()) lines += ": no combination is at rest and has it";
  for (const CsvRow &row : best) {
    double value = 0;
    read_number(table.cell(row, options.sort), value);
    lines += text("\n  %12.4g ", value);
    for (size_t k = 0; k < parameters; ++k) lines += " " + table.columns()[k] + "=" + row[k];
  }
  return lines;
}

void close_missing(const Sweep &sweep, SweepTable &table, const std::vector<size_t> &missing,
                   const SweepOptions &options, const Console &console) {
  size_t done = 0;
  run_in_processes(
      missing.size(), options.jobs, [&](size_t k) { return csv_line(row_of(sweep, missing[k])); },
      [&](size_t, const std::string &line) {
        table.append(line);
        ++done;
        if (console.progress)
          std::fprintf(stderr, "%zu of %zu combinations\n", done, missing.size());
      });
}

void report(const Sweep &sweep, const SweepTable &table, const SweepOptions &options,
            size_t closed_now, const Console &console) {
  const std::vector<CsvRow> rows = table.rows();
  const auto failed = std::count_if(rows.begin(), rows.end(), [&](const CsvRow &row) {
    return !table.cell(row, "error").empty();
  });
  const auto at_rest = std::count_if(rows.begin(), rows.end(),
                                     [&](const CsvRow &row) { return table.is_at_rest(row); });
  const auto moving = static_cast<ptrdiff_t>(rows.size()) - failed - at_rest;
  Json best = Json::array();
  std::string lines = text("%s: %zu combinations under %g mmHg, %zu of them closed now, in %s",
                           options.file.c_str(), rows.size(), sweep.conditions.pressure_mmhg,
                           closed_now, options.csv.c_str());
  if (failed > 0) lines += text("\n%td cannot be applied: see the column error", failed);
  if (moving > 0) lines += text("\n%td are not at rest: see the column converged", moving);
  if (!options.sort.empty()) {
    const std::vector<CsvRow> first = table.best(options.sort, options.largest, most_shown);
    for (const CsvRow &row : first) best.push_back(best_json(table, row));
    lines += best_text(table, first, options, sweep.grid.columns().size());
  }
  print(console,
        {{"file", options.file},
         {"csv", options.csv},
         {"pressure_mmHg", sweep.conditions.pressure_mmhg},
         {"combinations", rows.size()},
         {"closed_now", closed_now},
         {"failed", failed},
         {"not_at_rest", moving},
         {"sort", options.sort.empty() ? Json() : Json(options.sort)},
         {"best", best}},
        lines);
}

// A table in which no combination is at rest is a failure, also if its rows are from a run before.
void demand_a_row_at_rest(const SweepTable &table, Console &console) {
  const std::vector<CsvRow> rows = table.rows();
  if (std::any_of(rows.begin(), rows.end(), [&](const CsvRow &r) { return table.is_at_rest(r); })) {
    return;
  }
  const bool applied = std::any_of(rows.begin(), rows.end(), [&](const CsvRow &row) {
    return table.cell(row, "error").empty();
  });
  if (applied) {
    std::fprintf(stderr, "mvs: no combination is at rest\n");
  } else {
    std::fprintf(stderr, "mvs: no combination can be applied: %s\n",
                 table.cell(rows[0], "error").c_str());
  }
  console.exit_code = 1;
}

void demand_measured_sort(const SweepOptions &options) {
  const std::vector<std::string> keys = measure_keys(options.cost);
  if (options.sort.empty() || std::find(keys.begin(), keys.end(), options.sort) != keys.end()) {
    return;
  }
  throw CLI::ValidationError("--sort", options.sort + " is measured with --cost only");
}

void run_sweep(const SweepOptions &options, Console &console) {
  demand_measured_sort(options);
  SweepGrid grid = grid_of(options);
  Progress progress(console);
  mvs::Simulator sim = load_sim(options.file, progress);
  const double pressure_mmhg = pressure_mmhg_of(options.pressure_mmhg, sim);
  Sweep sweep = {std::move(grid), sim.snapshot(), {hash_of(sim.snapshot()), pressure_mmhg, ""}, {}};
  if (options.cost) {
    sweep.conditions.cost = sweep.cost.emplace(options.cost_options).words();
  }
  SweepTable table(sweep.grid, options.csv, sweep.conditions);
  const std::vector<size_t> missing = table.missing();
  if (!missing.empty()) {
    sweep.closed = settle(sim, pressure_mmhg, options.file).valve;
    close_missing(sweep, table, missing, options, console);
  }
  table.sort();
  if (InterruptFlag::is_set()) {
    fail(MVS_E_CANCELLED, "sweep", "stopped by Ctrl-C: run the same command again to continue");
  }
  report(sweep, table, options, missing.size(), console);
  demand_a_row_at_rest(table, console);
}

// An error sentence for one --op, else "".
std::string wrong_op(const std::string &given) {
  try {
    read_sweep_op(given);
    return "";
  } catch (const std::invalid_argument &error) {
    return error.what();
  }
}

}  // namespace

void add_sweep(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<SweepOptions>(
      app, console, "sweep",
      "close a valve after every combination of operations, and tabulate the measures",
      [](const SweepOptions &given, Console &output) {
        try {
          run_sweep(given, output);
        } catch (const std::invalid_argument &error) {
          throw CLI::ValidationError("--op", error.what());
        }
      });
  command->add_option("file", options->file, "valve to close, .obj, .h5 or .inp")->required();
  command
      ->add_option("--op", options->ops,
                   "operation and values of its fields: \"ring size=28:36:2\" (first, last, step) "
                   "or \"chord-length chord=A2/7 factor=0.7,0.8\"; points are separated by "
                   "semicolons; applied in the given order")
      ->type_name("TEXT")
      ->required()
      ->allow_extra_args(false)
      ->check(wrong_op, "");
  command
      ->add_option("--csv", options->csv,
                   "table to write; combinations that it already has are not closed again")
      ->required();
  add_pressure_option(*command, options->pressure_mmhg);
  command->add_option("--jobs", options->jobs, "processes at a time; the table is the same for any")
      ->capture_default_str()
      ->check(CLI::Range(1u, 1024u));
  CLI::Option *sort = command
                          ->add_option("--sort", options->sort,
                                       "measure by which the best ten combinations are printed, "
                                       "smallest first: a column of the table")
                          ->check(one_of(measure_keys(true)).description(""));
  sort->type_name("MEASURE");
  CLI::Option *cost = command->add_flag("--cost", options->cost,
                                        "measure the cost of each repair, as `mvs cost` does");
  for (CLI::Option *given : add_cost_options(*command, options->cost_options)) given->needs(cost);
  command->add_flag("--largest", options->largest, "print the largest first")->needs(sort);
  add_progress_flag(*command, console);
  command->footer(
      "The valve is closed first, and every combination starts from that closed valve; `mvs op "
      "--settle` and Python's\nmvs.sweep operate on the valve as given: give them a closed one "
      "(mvs close -o) for the same figures.\n"
      "Exit code 0: a combination at least is at rest; single ones that are not (column "
      "converged), "
      "or cannot be applied\n(column error), are rows of the table and counted in the output. 1: "
      "none is at rest.");
}

}  // namespace cli
