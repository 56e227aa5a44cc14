// Simulators and snapshots for the commands, through the public C++ wrappers.
#pragma once

#include <mvs/experimental.hpp>
#include <string>

namespace cli {

// Prints the library's warnings and errors on stderr.
void log_to_stderr(void *, mvs_log_level level, const char *text);

// An empty simulator that logs to stderr. `desc` may set all fields except the log.
mvs::Simulator make_sim(mvs_sim_desc desc = {});

// Reads the valve and the state in a file.
mvs::Snapshot load(const std::string &path);

// Numbers of the parts of a valve.
struct Size {
  size_t vertices = 0;  // of the leaflets, annulus included
  size_t branches = 0;  // branch points of chordae
  size_t faces = 0, chords = 0, heads = 0, annulus = 0;
};
Size size_of(const mvs::Snapshot &valve);

// Throws a failure of the command in the form of a library error.
[[noreturn]] void fail(mvs_result code, const std::string &part, const std::string &sentence,
                       int32_t line = 0);

// The hash of a snapshot as 32 hexadecimal digits.
std::string hash_of(const mvs::Snapshot &valve);

}  // namespace cli
