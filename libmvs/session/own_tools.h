// The tools that one hand has made, among those of hosts, other hands and other simulators.
#pragma once

#include <memory>
#include <vector>

#include "session/simulator.h"

namespace mvs::core {

class OwnTools {
 public:
  // Id of the held tool, also while the simulator lacks it; 0: none.
  Id held() const { return held_; }
  // Null unless the simulator has the held tool itself.
  const Tool *held_in(const mvs_sim &sim) const;
  // Whether the hand made this tool of the simulator. It may have returned with an undo, a snapshot
  // or a file.
  bool made(const mvs_sim &sim, const Tool &tool) const;

  // Holds the newest tool of the simulator, which the hand has made now.
  void add_newest(const mvs_sim &sim);
  // Holds a tool that has returned.
  void hold(Id tool) { held_ = tool; }
  void drop() { held_ = 0; }

 private:
  // A tool as it was added, and the history that it was added in.
  struct Made {
    Tool tool;
    std::weak_ptr<const ModelState> start;
  };
  std::vector<Made> made_;
  Id held_ = 0;
};

}  // namespace mvs::core
