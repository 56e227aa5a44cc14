// Reads the JSON text of a file that a user gives.
#pragma once

#include <string>

#include "text/console.h"

namespace cli {

// Parses a text. On failure `fault` is an error sentence without the name of the file, such as
// "line 3 is not JSON", and the value is null; else it is "". Nesting is limited as in the library.
Json parse_json(const std::string &bytes, std::string &fault);

}  // namespace cli
