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

// A failure of the command in the form of a library error.
mvs::Error error_of(mvs_result code, const std::string &part, const std::string &sentence,
                    int32_t line = 0);

// Throws it. MVS_E_ARGUMENT is wrong usage: a word, option or value of the command line is refused.
[[noreturn]] void fail(mvs_result code, const std::string &part, const std::string &sentence,
                       int32_t line = 0);

// Does work with the contents of files, which are no part of the command line: a value that the
// library refuses as an argument is a wrong file, not wrong usage.
template <typename Work>
auto with_file_contents(Work &&work) {
  try {
    return work();
  } catch (const mvs::Error &error) {
    if (error.code() != MVS_E_ARGUMENT) throw;
    fail(MVS_E_FORMAT, error.part(), error.what(), error.line());
  }
}

// The hash of a snapshot as 32 hexadecimal digits.
std::string hash_of(const mvs::Snapshot &valve);

}  // namespace cli
