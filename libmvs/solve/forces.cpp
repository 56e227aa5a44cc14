// The forces on all nodes of a valve as it stands, those of tools included.
#include "energy/forces.h"

#include "energy/total_energy.h"
#include "solve/tools/tool_points.h"

namespace mvs::core {

Forces evaluate_forces(const Model &valve, const State &valve_state) {
  ToolPoints points;
  const Model &model = points.extend(valve, tool_points(valve_state.tools));
  const State state = ToolPoints::extended(valve_state);
  TotalEnergy total_energy(model);
  Profile profile;
  total_energy.use_verlet_list(false);
  total_energy.set_pressure(state.load.pressure);
  total_energy.set_tools(state.tools);
  total_energy.prepare(state.x, state.x, 0, profile);
  Forces forces;
  forces.energy = total_energy.gradient(state.x, forces.total, profile);
  forces.energy += SpringTerm(model, Elements::prescribed).gradient(state.x, forces.total);
  forces.energy += MembraneTerm(model, Elements::prescribed).gradient(state.x, forces.total);
  forces.energy += BendingTerm(model, Elements::prescribed).gradient(state.x, forces.total);
  forces.contact.assign(state.x.size(), Vec3::Zero());
  total_energy.contact().gradient(forces.contact);
  for (Vec3 &f : forces.total) f = -f;
  for (Vec3 &f : forces.contact) f = -f;
  forces.total.resize(valve_state.x.size());
  forces.contact.resize(valve_state.x.size());
  return forces;
}

}  // namespace mvs::core
