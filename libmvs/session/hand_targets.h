// Hand positions posted from any thread, for the next settle or step.
#pragma once

#include <mutex>
#include <vector>

#include "history/history.h"
#include "model/model.h"

namespace mvs::core {

class HandTargets {
 public:
  // Replaces the posted position of this tool; keeps the posted axis unless `has_axis`.
  void post(const Tool &hand, bool has_axis);

  // Moves the tools of a state to their posted hands and returns the events. Skips hands whose tool
  // the state lacks.
  std::vector<RecordedEvent> take(State &state) const;
  // Removes the hands that the state has reached, unless they moved meanwhile, and hands whose tool
  // the state lacks.
  void done(const State &state);
  void forget();

 private:
  mutable std::mutex mutex_;
  std::vector<Tool> posted_;  // at most one per tool
};

}  // namespace mvs::core
