// What is said to the Haply Inverse Service and what it tells, as JSON; the sources are in the
// README. Nothing here talks to anybody.
#pragma once

#include <string>
#include <vector>

#include "common/fault.h"

namespace haply {

using driver::Fault;

struct Version {
  int major = 0, minor = 0;

  bool at_least(int wanted_major, int wanted_minor) const {
    return major != wanted_major ? major > wanted_major : minor >= wanted_minor;
  }
};

// "3.5.0.0", as "project_version" has it.
bool parse_version(const std::string &text, Version &version);
// The answer to GET /version.
int32_t read_version(const std::string &answer, Version &version, Fault &fault);

struct Grip {
  std::string kind, id;  // the kind is the name of its list: "wireless_verse_grip"
  bool connected = true;
  unsigned buttons = 3;
};

struct Inverse {
  std::string id, type, serial, firmware, basis;
  bool calibrated = true, powered = true, in_use = false;
};

// The first frame after connecting: all devices, with what they are.
struct Inventory {
  std::vector<Inverse> inverses;
  std::vector<Grip> grips;
};
int32_t read_inventory(const std::string &frame, Inventory &inventory, Fault &fault);

// What is known of the hand. What a frame leaves out stays as it was.
struct Hand {
  double position[3] = {}, velocity[3] = {}, orientation[4] = {1, 0, 0, 0};
  bool has_velocity = false, calibrated = true, powered = true;
  uint32_t buttons = 0;
};
// 1 when `frame` tells of the device, 0 when it does not, else a code. `grip` may have no id.
int32_t read_state(const std::string &frame, const std::string &device, const Grip &grip,
                   Hand &hand, Fault &fault);

// The frames that are sent, of which a thread at the device's rate fills in three numbers.
class Commands {
 public:
  Commands(const Version &version, const std::string &device);

  // The first message: who we are, and where the origin is (`preset`, from 3.5 on; may be empty).
  std::string hello(const std::string &preset) const;
  // Valid until the next call; allocates nothing after the first.
  const std::string &force(const double newton[3]);

 private:
  Version version_;
  std::string device_, text_;
  size_t numbers_ = 0;
};

}  // namespace haply
