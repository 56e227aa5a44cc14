// Parsing of numbers with '.' as decimal point, independent of the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace driver {

// Returns the finite number in `text`, or nullopt if `text` is not entirely a number.
inline std::optional<double> decimal(std::string_view text) {
  double value = 0;
  const char *const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// Returns the 32-bit count in `text`, or nullopt.
inline std::optional<unsigned> count(std::string_view text) {
  unsigned value = 0;
  const char *const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

}  // namespace driver
