// A case of the stability suite: a script, its valves, and the solver modes that bring it to rest.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/stability/watch.h"

namespace stability {

struct Case {
  std::string name;  // "group/case"
  std::function<void(Watch &)> play;
  std::vector<std::string> valves = {"S"};  // in short runs; `more` as well in long ones
  std::vector<std::string> more = {"M", "N32"};
  std::vector<SolverMode> modes = {SolverMode::newton, SolverMode::implicit, SolverMode::live};
  bool may_refuse = false;  // moves may fail with MVS_E_DIVERGED
  // Lays the valve out; without it the case starts from the closed valve under systolic pressure.
  std::function<void(Watch &, const std::string &valve)> prepare = {};
};

std::vector<Case> boundary_cases();
std::vector<Case> chord_cases(bool every_chord);
std::vector<Case> load_cases();
std::vector<Case> start_cases();
std::vector<Case> mesh_cases();
std::vector<Case> tool_cases();

}  // namespace stability
