// Reads the text of a plan from its file.
#pragma once

#include <string>

namespace cli {

// Throws mvs::Error with the path if the file cannot be read or is not a plan.
std::string plan_text(const std::string &path);

}  // namespace cli
