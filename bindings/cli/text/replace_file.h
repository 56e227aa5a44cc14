// Writes a file whole.
#pragma once

#include <string>

namespace cli {

// Writes the bytes to a new file beside `path`, then renames it, so that `path` is the former file
// or the whole new one. Keeps the mode of the former file; of a link, its target is replaced. No
// new file is left by a failure. Throws mvs::Error with this part.
void replace_file(const std::string &path, const std::string &bytes, const std::string &part);

}  // namespace cli
