// The script of a stand-in from an environment variable: "unplug_at=700,period_ns=200000".
#pragma once

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

// Sets the named numbers; prints a line about each unknown word.
inline void take_environment(const char *variable,
                             const std::map<std::string, std::atomic<long> *> &keys) {
  const char *const given = std::getenv(variable);
  std::string rest = given ? given : "";
  while (!rest.empty()) {
    const std::string one = rest.substr(0, rest.find(','));
    rest.erase(0, one.size() + 1);
    const size_t equals = one.find('=');
    const auto key = keys.find(one.substr(0, equals));
    if (equals == std::string::npos || key == keys.end())
      std::fprintf(stderr, "%s: what is '%s'?\n", variable, one.c_str());
    else
      *key->second = std::strtol(one.c_str() + equals + 1, nullptr, 0);
  }
}
