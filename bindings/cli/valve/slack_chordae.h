// Chordae that operations attached and that carry no force in the closed valve.
#pragma once

#include <string>
#include <vector>

#include "valve/at_rest.h"

namespace cli {

struct SlackChord {
  std::string name;
  double rest_length, length;  // m
};

// The chordae that the operations of the valve's history attached and that are slack, in the order
// of the operations. Empty unless the valve is at rest under pressure: an open valve hangs on no
// chord. The settle has warned of them.
std::vector<SlackChord> slack_new_chordae(const AtRest &closed);

// Name, rest length and length of each.
Json slack_json(const std::vector<SlackChord> &chordae);

}  // namespace cli
