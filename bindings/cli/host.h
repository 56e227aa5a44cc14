// What several commands ask the library, through its public C++ handles.
#pragma once

#include <mvs/experimental.hpp>
#include <string>

namespace cli {

// An empty simulator whose warnings go to stderr. `desc` may set all but the log.
mvs::Sim make_sim(mvs_sim_desc desc = {});

// The valve and state of a file.
mvs::Snapshot load(const std::string &path);

// How many things a valve is made of.
struct Size {
  size_t vertices = 0;  // of the leaflets, annulus included
  size_t branches = 0;  // branch points of chordae
  size_t faces = 0, chords = 0, heads = 0, annulus = 0;
};
Size size_of(const mvs::Snapshot &valve);

// Throws a failure of the command itself, in the form of those of the library.
[[noreturn]] void fail(mvs_result code, const std::string &part, const std::string &sentence,
                       int32_t line = 0);

// The hash of a snapshot as 32 hexadecimal digits.
std::string hash_of(const mvs::Snapshot &valve);

}  // namespace cli
