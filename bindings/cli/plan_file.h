// The text of a plan's file.
#pragma once

#include <string>

namespace cli {

// Throws mvs::Error with the path where the file cannot be read or is no plan.
std::string plan_text(const std::string &path);

}  // namespace cli
