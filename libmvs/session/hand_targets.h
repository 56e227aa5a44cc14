// Where hands want their tools to be, handed over from any thread to the next settle or step.
#pragma once

#include <mutex>
#include <vector>

#include "history/history.h"
#include "model/model.h"

namespace mvs::core {

class HandTargets {
 public:
  // Replaces what the hand of this tool wanted before; without an axis that one stays.
  void post(const Tool &hand, bool has_axis);

  // Moves the tools of a state to their hands; the moves that this takes. Hands whose tool the
  // state lacks are left out.
  std::vector<RecordedEvent> take(State &state) const;
  // Forgets the hands that a state has followed, unless they have moved on meanwhile, and those
  // whose tool it lacks.
  void done(const State &state);
  void forget();

 private:
  mutable std::mutex mutex_;
  std::vector<Tool> posted_;  // at most one a tool
};

}  // namespace mvs::core
