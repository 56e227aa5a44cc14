// The scenes of the golden digests: closures, live steps with a hand, every operation, a plan.
#pragma once

#include <mvs/mvs.h>

#include <functional>
#include <string>
#include <vector>

namespace golden {

// Called with the name of a scene and the snapshot at its end, valid during the call.
using Record = std::function<void(const std::string &scene, const mvs_snapshot *snapshot)>;

// Scenes that begin in the same way.
struct Group {
  std::string name;
  std::function<void(const Record &)> run;
};
std::vector<Group> groups();

// Worker threads of the simulators of all scenes made after the call; 0 at first.
void use_workers(uint32_t workers);

// Ends the program with the sentence of the library's last failure unless the call succeeded.
void check(mvs_result result);

}  // namespace golden
