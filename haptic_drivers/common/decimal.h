// Numbers in text, with '.' as decimal point whatever the locale is.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace driver {

// The finite number that the whole of `text` is, or nothing.
inline std::optional<double> decimal(std::string_view text) {
  double value = 0;
  const char *const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

// The same of a count that fits 32 bits.
inline std::optional<unsigned> count(std::string_view text) {
  unsigned value = 0;
  const char *const end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

}  // namespace driver
