// Known failures with their reasons. Every line here is also a line of README.md; a row that passes
// although it is listed here is printed as BETTER, so that both lines can be removed.
#pragma once

#include <array>

namespace stability {

struct Known {
  const char *name, *mode;  // mode "": any
  const char *reason;
};

inline constexpr std::array<Known, 0> known_failures{};

}  // namespace stability
