// Options of the application, each checked; an invalid one is a Refusal.
#pragma once

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "common/decimal.h"
#include "common/interface.h"

namespace driver {

using Vector = std::array<double, 3>;

class Options {
 public:
  explicit Options(const mvs_driver_host *host) : host_(host) {}

  std::optional<std::string> text(const char *key) const {
    const std::size_t needed = offsetof(mvs_driver_host, option) + sizeof host_->option;
    if (host_->struct_size < needed || !host_->option) return std::nullopt;
    const char *const value = host_->option(host_->host, key);
    if (!value) return std::nullopt;
    return std::string(value);
  }

  bool given(const char *key) const { return text(key).has_value(); }

  double number(const char *key, double otherwise, double least, double most) const {
    const auto value = text(key);
    if (!value) return otherwise;
    const auto number = decimal(*value);
    if (!number || *number < least || *number > most) refuse_range(key, *value, "", least, most);
    return *number;
  }

  // Reads "x,y,z", each at most `most` in magnitude.
  Vector vector(const char *key, const Vector &otherwise, double most) const {
    const auto value = text(key);
    if (!value) return otherwise;
    Vector out = {};
    std::string_view rest = *value;
    for (int k = 0; k < 3; ++k) {
      const std::size_t comma = k < 2 ? rest.find(',') : rest.size();
      const auto number = comma == rest.npos ? std::nullopt : decimal(rest.substr(0, comma));
      if (!number || std::abs(*number) > most)
        refuse_range(key, *value, "three numbers x,y,z, each ", -most, most);
      out[k] = *number;
      rest.remove_prefix(k < 2 ? comma + 1 : comma);
    }
    return out;
  }

 private:
  [[noreturn]] static void refuse_range(const char *key, const std::string &value, const char *what,
                                        double least, double most) {
    refuse(MVS_DRIVER_E_OPTION, std::string("option ") + key + "=" + value + ": give " + what +
                                    "a number from " + short_text(least) + " to " +
                                    short_text(most));
  }
  static std::string short_text(double number) {
    char buffer[32];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, number).ptr;
    return std::string(buffer, end);
  }

  const mvs_driver_host *host_;
};

}  // namespace driver
