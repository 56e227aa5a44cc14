// Simulators: create, set a valve, take and restore snapshots, destroy.
#include "api/sim_call.h"
#include "session/simulator.h"

#include "anatomy/parametric.h"
#include "api/valve_desc.h"
#include "model/checks/check.h"
#include "session/commit.h"
#include "session/mesh_warnings.h"

using namespace mvs::core;

namespace {

void check_workers(const mvs_sim_desc &how) {
  MVS_MUST(how.workers <= MVS_MAX_WORKERS, MVS_E_ARGUMENT, "desc.workers",
           "desc.workers is %u: it has to be at most %d; more than the processor has cores gain "
           "nothing",
           how.workers, MVS_MAX_WORKERS);
  must_be_zero(how.reserved, "desc.reserved");
  MVS_MUST((how.pool_width == nullptr) == (how.run_tasks == nullptr), MVS_E_ARGUMENT,
           how.run_tasks ? "desc.pool_width" : "desc.run_tasks",
           "a pool of the host needs both desc.pool_width and desc.run_tasks: give both or none");
  MVS_MUST(how.workers == 0 || how.run_tasks == nullptr, MVS_E_ARGUMENT, "desc.workers",
           "desc.workers is %u beside a pool of the host: leave it 0, or give no pool",
           how.workers);
}

}  // namespace

extern "C" {

mvs_result mvs_create(const mvs_sim_desc *desc, mvs_sim **sim) {
  return at_boundary([&] {
    must_point(sim, "sim");
    const mvs_sim_desc how = read_struct_or_default(desc, "desc");
    must_be_backend(how.backend, "desc.backend");
    check_workers(how);
    *sim = new mvs_sim(how);
  });
}

void mvs_destroy(mvs_sim *sim) {
  delete sim;
}

mvs_result mvs_set_valve(mvs_sim *sim, const mvs_valve_desc *valve) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    Described described = read_valve_desc(valve);
    ModelPtr model = make_model(std::move(described.valve), s.model());
    State state = described_state(*model, described.now);
    replace_valve(s, {{std::move(model), std::move(state)}, {}});
  });
}

mvs_result mvs_check_valve(const mvs_valve_desc *valve, mvs_fault_fn fault, void *user) {
  bool reported = false;
  const auto report = [&](const char *part, const char *sentence) {
    reported = true;
    if (fault) fault(user, part, sentence);
  };
  const mvs_result result = at_boundary([&] {
    Described described = read_valve_desc(valve);
    for (const Fault &f : find_faults(described.valve)) report(f.part.c_str(), f.sentence.c_str());
    const ModelPtr model = make_model(std::move(described.valve));
    const State state = described_state(*model, described.now);
    for (const Fault &f : mesh_warnings(*model, state.x)) {
      report(f.part.c_str(), f.sentence.c_str());
    }
  });
  // an error of reading the description is a fault as well
  if (result != MVS_OK && !reported) report(mvs_last_error()->part, mvs_last_error()->message);
  return result;
}

mvs_result mvs_generate_valve(mvs_sim *sim, const mvs_parametric_desc *desc) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    ModelPtr model = make_model(make_parametric_valve(read_struct_or_default(desc, "desc")));
    State state = initial_state(*model);
    replace_valve(s, {{std::move(model), std::move(state)}, {}});
  });
}

mvs_result mvs_get_snapshot(mvs_sim *sim, const mvs_snapshot **snapshot) {
  return at_boundary([&] {
    must_point(sim, "sim");
    must_point(snapshot, "snapshot");
    *snapshot = sim->present().release();
  });
}

mvs_result mvs_restore(mvs_sim *sim, const mvs_snapshot *snapshot) {
  return call_at_boundary(sim, [&](mvs_sim &s) {
    must_point(snapshot, "snapshot");
    must_be_no_group(s, "restore");
    restart_journal(s, snapshot->value);
    mvs_snapshot_retain(snapshot);
    s.replace(SnapshotPtr(snapshot));
    s.hands.forget();
  });
}

}  // extern "C"
