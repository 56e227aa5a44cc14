// Writes a file whole.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cli {

// Writes all bytes to a file or pipe. Returns errno, 0 if all is written.
int write_bytes(int file, std::string_view bytes);

// Creates a file with a name that no file has, `.mvs-PID-NUMBER.tmp` in this folder. Returns its
// descriptor; -1, with errno, if that fails.
int open_new(const std::string &folder, std::string &name);

// Writes the bytes to a new file beside `path`, then renames it, so that `path` is the former file
// or the whole new one. Keeps the mode of the former file; of a link, its target is replaced. No
// new file is left by a failure. `before_rename` gets the descriptor of the new file. Throws
// mvs::Error with this part.
void replace_file(const std::string &path, const std::string &bytes, const std::string &part,
                  const std::function<void(int)> &before_rename = {});

}  // namespace cli
