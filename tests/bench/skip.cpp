// Cost of each part of a scene, present and absent.
//
//   bench_skip                       scene S
//   bench_skip --scene M --csv FILE
//   bench_skip --workers 2           as shared by so many threads
//
// Terms: one energy, gradient and Hessian on a valve with the part, and on one without. Contact: of
// the closed valve, and of the open one, where nothing meets. Steps: one that moves, and one at
// rest; callers: cost of a snapshot, measures and levels of undo beside a step. CPU time, the
// fastest of the rounds. Then, for whole closures, the terms that mvs_stats reports as skipped.
//
// With workers a term is computed part by part of the nodes, and steps and closures share all loops
// that can be shared; all parts run on the calling thread, so that the CPU time is that of the work
// and not of waiting.
#include <mvs/sim.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anatomy/parametric.h"
#include "base/workers.h"
#include "energy/total_energy.h"
#include "solve/solver.h"
#include "tests/bench/callers.h"
#include "tests/bench/closing.h"
#include "tests/bench/search.h"
#include "tests/bench/table.h"
#include "tests/bench/term_pass.h"

using namespace mvs::core;

namespace {

struct Options {
  std::string scene = "S", csv;
  int rounds = 20;
  uint32_t workers = 1;
};

using Change = std::function<void(Valve &)>;

void to_membrane(Valve &valve) {
  for (size_t k = 0; k < valve.leaflets.size(); ++k) {
    valve.leaflets[k].law = LeafletLawId::bilinear;
    for (const LeafletLaw &law : leaflet_laws()) {
      if (law.id == LeafletLawId::bilinear)
        valve.leaflets[k].constants = default_constants(law.constants);
    }
  }
}

ModelPtr scene(const Options &options, const Change &change) {
  mvs_parametric_desc desc = {};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = bench::scene_vertices.at(options.scene);
  Valve valve = make_parametric_valve(desc);
  if (change) change(valve);
  return make_model(std::move(valve));
}

std::vector<Vec3> nodes_of(const CowVector<Vec3> &x) {
  return {x.begin(), x.end()};
}

// A system with the pattern of every term of a model at x.
HessianAssembler room_for(const Model &model, const std::vector<Vec3> &x) {
  TotalEnergy total_energy(model);
  Profile profile;
  HessianAssembler system;
  std::vector<Vec3> g;
  total_energy.prepare(x, x, 0, profile);
  total_energy.gradient(x, g, profile);
  total_energy.hessian(x, Curvature::projected, system, profile);
  return system;
}

// The same with the pattern of one term.
template <typename Term>
HessianAssembler room_for(const Model &model, const std::vector<Vec3> &x, const Term &term) {
  HessianAssembler system = room_for(model, x);
  std::vector<Edge> pairs, all;
  term.add_pairs(pairs);
  const BlockMatrix &m = system.matrix;
  for (uint32_t c = 0; c < m.size(); ++c) {
    for (uint32_t k = m.start[c] + 1; k < m.start[c + 1]; ++k) {
      all.push_back({system.node_of[m.row[k]], system.node_of[c]});
    }
  }
  system.set_pattern(model, pairs, all);
  system.begin_term(0);
  return system;
}

template <typename Term>
double term_cost(const Options &options, const Model &model, Term &term,
                 const std::vector<Vec3> &x) {
  HessianAssembler system = room_for(model, x, term);
  std::vector<Vec3> g(x.size(), Vec3::Zero());
  double sum = 0;
  if (options.workers == 1)
    return bench::fastest(options.rounds, [&] { sum += bench::pass(term, x, system, g); });
  NodeParts nodes;
  nodes.divide(model, options.workers);
  std::vector<double> energies(term.size());
  system.boundary_force.resize(system.matrix.size());
  return bench::fastest(options.rounds, [&] {
    for (uint32_t k = 0; k < options.workers; ++k) {
      HessianPart blocks(system, nodes.part(k));
      PartGradient to{g, nodes.part(k), energies.data()};
      bench::pass_of_part(term, x, blocks, to, {k, options.workers});
    }
  });
}

double pressure_cost(const Options &options, const Model &model, double pressure,
                     const std::vector<Vec3> &x) {
  FollowerPressureTerm term(model);
  term.set_pressure(pressure);
  return term_cost(options, model, term, x);
}

// A pool that shares all loops and runs them on the calling thread.
std::unique_ptr<Workers> pool_of(const Options &options) {
  if (options.workers == 1) return nullptr;
  HostPool pool;
  pool.user = const_cast<uint32_t *>(&options.workers);
  pool.width = [](void *user) { return *static_cast<const uint32_t *>(user); };
  pool.run = [](void *, uint32_t count, void (*task)(void *, uint32_t), void *context) {
    for (uint32_t k = 0; k < count; ++k) task(context, k);
  };
  auto workers = std::make_unique<Workers>(pool);
  workers->begin_call();
  return workers;
}

// Pairs, distances, and the contact term.
struct ContactCost {
  double broad, narrow, terms;
};

ContactCost contact_cost(const Options &options, const Model &model, const std::vector<Vec3> &x) {
  const double slack = 0.1 * model.valve.contact_thickness;
  const std::unique_ptr<Workers> workers = pool_of(options);
  BroadPhase pairs(model);
  pairs.use_workers(workers.get());
  ContactTerm contact(model);
  ContactCost cost = {};
  cost.broad = bench::time_of_search(options.rounds, x, slack, pairs);
  cost.narrow = bench::fastest(options.rounds, [&] { contact.collect(x, pairs); });
  HessianAssembler system = room_for(model, x);
  std::vector<Vec3> g(x.size(), Vec3::Zero());
  double sum = 0;
  cost.terms = bench::fastest(options.rounds, [&] {
    sum += contact.energy() + contact.gradient(g);
    contact.hessian(x, Curvature::projected, system);
  });
  return cost;
}

// The scenes, each of which lacks one part.
struct Scenes {
  ModelPtr full, membrane, no_chordae, no_bending;
  explicit Scenes(const Options &options)
      : full(scene(options, {})),
        membrane(scene(options, to_membrane)),
        no_chordae(scene(options, [](Valve &v) { v.chords = CowVector<Chord>(); })),
        no_bending(scene(options, [](Valve &v) { v.bending_scale = 0; })) {}
};

State loaded(const Model &model, double pressure, double fraction) {
  State state = initial_state(model);
  state.load = {pressure, fraction};
  return state;
}

State closed(const Model &model) {
  State state = loaded(model, MVS_SYSTOLE_PA, 1);
  Solver(Backend::fastest).settle(model, state, {}, {});
  return state;
}

void tell(bench::Table &table, const char *part, double on, double off) {
  table.row({part, on * 1e6, off * 1e6, on > 0 ? off / on : 0});
}

void tell_terms(const Options &options, const Scenes &s, bench::Table &table) {
  const std::vector<Vec3> x = nodes_of(closed(*s.full).x);
  const auto cost = [&](const Model &model, const auto &term) {
    return term_cost(options, model, term, x);
  };
  tell(table, "springs", cost(*s.full, SpringTerm(*s.full)),
       cost(*s.membrane, SpringTerm(*s.membrane)));
  tell(table, "membrane", cost(*s.membrane, MembraneTerm(*s.membrane)),
       cost(*s.full, MembraneTerm(*s.full)));
  tell(table, "bending", cost(*s.full, BendingTerm(*s.full)),
       cost(*s.no_bending, BendingTerm(*s.no_bending)));
  tell(table, "chordae", cost(*s.full, CableTerm(*s.full)),
       cost(*s.no_chordae, CableTerm(*s.no_chordae)));
  tell(table, "pressure", pressure_cost(options, *s.full, MVS_SYSTOLE_PA, x),
       pressure_cost(options, *s.full, 0, x));
  const ContactCost on = contact_cost(options, *s.full, x);
  const ContactCost off = contact_cost(options, *s.full, nodes_of(s.full->valve.rest));
  tell(table, "contact: pairs", on.broad, off.broad);
  tell(table, "contact: distances", on.narrow, off.narrow);
  tell(table, "contact: terms", on.terms, off.terms);
}

// The median CPU seconds of an implicit step.
double step_cost(const Options &options, const Model &model, State state, int before) {
  const std::unique_ptr<Workers> workers = pool_of(options);
  Solver solver(Backend::fastest, workers.get());
  const int count = options.rounds;
  SolveOptions how;
  how.solver = SolverKind::implicit_euler;
  for (int k = 0; k < before; ++k) solver.step(model, state, how);
  std::vector<double> cpu_s;
  cpu_s.reserve(static_cast<size_t>(count));
  for (int k = 0; k < count; ++k)
    cpu_s.push_back(bench::timed([&] { solver.step(model, state, how); }).cpu);
  return bench::median(cpu_s);
}

std::string words(uint32_t skipped) {
  const char *names[] = {"springs", "membrane", "bending",  "chordae", "pressure", "contact",
                         "tools",   "broad",    "ordering", "factor",  "step"};
  std::string text;
  for (uint32_t k = 0; k < std::size(names); ++k) {
    if ((skipped >> k & 1) != 0) text += (text.empty() ? "" : " ") + std::string(names[k]);
  }
  return text.empty() ? "nothing" : text;
}

void tell_closure(const Options &options, bench::Table &table, const char *name, const Model &model,
                  double pressure, double fraction) {
  const std::unique_ptr<Workers> workers = pool_of(options);
  State state = loaded(model, pressure, fraction);
  SolveStats stats;
  Solver solver(Backend::fastest, workers.get());
  SolveOptions how;
  how.residual = bench::rest_residual;
  how.max_iterations = 100;
  const double cpu = bench::timed([&] { stats = solver.settle(model, state, how, {}); }).cpu;
  table.row({name, cpu * 1e3, stats.iterations, stats.work.passes, stats.work.broad_phases,
             stats.converged, words(stats.skipped)});
}

void run(const Options &options) {
  const Scenes s(options);
  {
    bench::Table table({"part                ", "on us", "off us", "off / on"}, options.csv);
    tell_terms(options, s, table);
    tell(table, "a step that moves",
         step_cost(options, *s.full, loaded(*s.full, MVS_SYSTOLE_PA, 1), 5),
         step_cost(options, *s.full, closed(*s.full), 20));
    for (const bench::Part &part :
         bench::caller_parts(bench::scene_vertices.at(options.scene), options.rounds))
      tell(table, part.name.c_str(), part.on, part.off);
  }
  std::printf("\n");
  bench::Table table(
      {"scene               ", "cpu ms", "steps", "passes", "broad", "at rest ", "skipped"});
  tell_closure(options, table, "shipped valve", *s.full, MVS_SYSTOLE_PA, 1);
  tell_closure(options, table, "membrane", *s.membrane, MVS_SYSTOLE_PA, 1);
  tell_closure(options, table, "no bending", *s.no_bending, MVS_SYSTOLE_PA, 1);
  tell_closure(options, table, "no chordae", *s.no_chordae, MVS_SYSTOLE_PA, 1);
  tell_closure(options, table, "no pressure", *s.full, 0, 1);
  tell_closure(options, table, "leaflets pushed open", *s.full, -100, 0);
}

}  // namespace

int main(int argc, char **argv) {
  try {
    Options options;
    CLI::App app("What parts of a scene cost, present and absent.", "bench_skip");
    app.add_option("--scene", options.scene, "S 425, M 1700, L 6800, XL 27000 vertices")
        ->capture_default_str()
        ->check(CLI::IsMember(bench::keys(bench::scene_vertices)));
    app.add_option("--rounds", options.rounds, "of which the fastest counts")
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.csv, "file to write the first table to");
    app.add_option("--workers", options.workers, "threads that share the work")
        ->check(CLI::Range(1u, Workers::most));
    CLI11_PARSE(app, argc, argv);
    // loops of small scenes are shared as well
    if (options.workers > 1) setenv("MVS_WORKERS_LEAST_US", "0", 0);
    run(options);
    return 0;
  } catch (const std::exception &error) {
    std::fprintf(stderr, "bench_skip: %s\n", error.what());
    return 1;
  }
}
