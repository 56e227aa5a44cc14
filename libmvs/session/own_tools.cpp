// Ids of tools begin anew with each valve: a tool is known by its history too.
#include "session/own_tools.h"

#include <algorithm>

namespace mvs::core {
namespace {

using Start = std::weak_ptr<const ModelState>;

// Address and owner: a new valve may lie at an old address.
bool is_same(const Start &a, const Start &b) {
  return !a.owner_before(b) && !b.owner_before(a);
}

// A file has the tools of its history, or those of its one state.
bool came_with_a_file(const mvs_sim &sim, const Tool &tool) {
  const auto start = sim.history_start();
  if (!start) return true;
  const auto &files = sim.file_starts;
  const bool of_file = std::any_of(files.begin(), files.end(),
                                   [&](const Start &file) { return is_same(file, start); });
  const std::vector<Tool> &first = start->state.tools;
  return of_file ||
         std::any_of(first.begin(), first.end(), [&](const Tool &t) { return t.id == tool.id; });
}

}  // namespace

const Tool *OwnTools::held_in(const mvs_sim &sim) const {
  if (held_ == 0) return nullptr;
  for (const Tool &t : sim.current().state.tools.get()) {
    if (t.id == held_) return made(sim, t) ? &t : nullptr;
  }
  return nullptr;
}

// Ids return after an undo, so that the sizes are compared too; an operation may renumber a held
// node.
bool OwnTools::made(const mvs_sim &sim, const Tool &tool) const {
  const Start start = sim.history_start();
  return std::any_of(made_.rbegin(), made_.rend(), [&](const Made &own) {
    return own.tool.is_same_as(tool) && own.tool.stiffness == tool.stiffness &&
           own.tool.max_force == tool.max_force &&
           (is_same(own.start, start) || came_with_a_file(sim, tool));
  });
}

void OwnTools::add_newest(const mvs_sim &sim) {
  const Tool &added = sim.current().state.tools.get().back();
  if (!made(sim, added)) made_.push_back({added, sim.history_start()});
  hold(added.id);
}

}  // namespace mvs::core
