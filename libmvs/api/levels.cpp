// Mesh levels of a valve: coarsens, refines, and returns to the original mesh.
#include <mvs/levels.h>

#include "anatomy/coarsen.h"
#include "anatomy/refine.h"
#include "api/sim_call.h"
#include "session/simulator.h"

using namespace mvs::core;

namespace {

// m. Shorter or longer edges indicate wrong units: the diameter of a valve is about 0.04 m.
constexpr double shortest_edge = 1e-5, longest_edge = 0.1;

size_t wanted_vertices(const mvs_coarsen_options &options, const Model &model) {
  MVS_MUST((options.vertices == 0) != (options.edge == 0), MVS_E_ARGUMENT, "options",
           "coarsen: give either vertices or edge, and leave the other one 0");
  if (options.vertices > 0) return options.vertices;
  must_be_in(options.edge, shortest_edge, longest_edge, "options.edge");
  return vertices_for_edge(model, options.edge);
}

mvs_coarsening public_report(const CoarseningReport &report) {
  mvs_coarsening made = {};
  made.struct_size = sizeof made;
  made.vertices_before = static_cast<uint32_t>(report.vertices_before);
  made.vertices = static_cast<uint32_t>(report.vertices);
  made.chords_moved = report.chords_moved;
  made.chords_merged = report.chords_merged;
  made.chord_move = report.chord_move;
  made.surface_max = report.surface_max;
  made.surface_rms = report.surface_rms;
  made.worst_quality = report.worst_quality;
  return made;
}

}  // namespace

extern "C" {

mvs_result mvs_refine_valve(mvs_sim *sim) {
  return call_at_boundary(sim, [](mvs_sim &s) {
    const SnapshotPtr before = s.present();
    ModelPtr fine = make_model(refine(*before->model), before->model.get());
    State state = transferred(*before->model, before->state, *fine);
    replace_valve(s, {{std::move(fine), std::move(state)}, {}});
  });
}

mvs_result mvs_coarsen_valve(mvs_sim *sim, const mvs_coarsen_options *options,
                             mvs_coarsening *made) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    const mvs_coarsen_options how = read_struct(options, "options");
    if (made) checked_struct_size(made, "made");
    const SnapshotPtr before = s.present();
    Coarsened coarse = coarsen(*before->model, wanted_vertices(how, *before->model));
    State state = to_coarse(coarse.map, before->state);
    replace_valve(s, {{std::move(coarse.model), std::move(state)}, {}});
    s.log(MVS_LOG_INFO, "coarsened: %u chordae moved by at most %.2f mm, %u made part of others",
          coarse.report.chords_moved, 1e3 * coarse.report.chord_move, coarse.report.chords_merged);
    if (made) write_struct(made, public_report(coarse.report), "made");
  });
}

mvs_result mvs_transfer_state(mvs_sim *sim, const mvs_snapshot *from) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(from, "from");
    const SnapshotPtr before = s.present();
    State state = transferred(*from->model, from->state, *before->model);
    replace_valve(s, {{before->model, std::move(state)}, {}});
  });
}

}  // extern "C"
