// Output files of commands: refused before long work if they could not be written after it, with
// the sentences of mvs_save_file.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace cli {

// The file that a path names. Links are followed, also those to a file that does not exist yet.
struct OutputTarget {
  std::string file, folder;
  std::optional<mode_t> mode;  // of the file that would be replaced
};

// Throws mvs::Error with this part if the path is a folder, a device or a file without the right to
// write, or has links that lead back to themselves.
OutputTarget output_target(const std::string &path, const std::string &part = "");

// Throws mvs::Error if no file can be written to this path: also if its folder does not exist or
// cannot be written to. Not of a full disk. An empty path is no output.
void demand_writable(const std::string &path);

// The same for the file of a valve, whose ending has to name a format that is written.
void demand_writable_valve(const std::string &path);

// An output of a command: its path, and the words for its content, as "the valve".
struct Output {
  std::string path, what;
};

// Throws mvs::Error if two outputs are one file, or an output is an input, under whatever names.
// An empty path is no output and no input.
void demand_apart(const std::vector<Output> &outputs, const std::vector<std::string> &inputs);

// Throws mvs::Error, "PATH: cannot VERB WHAT: the system's reason; the remedy"; `error` is errno.
[[noreturn]] void fail_to_write(const std::string &path, const std::string &part,
                                const std::string &verb, const std::string &what, int error);

}  // namespace cli
