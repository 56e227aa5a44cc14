// The line of an OBJ file that a fault of its valve is about: the checks of a valve name a part, a
// person with the file in an editor needs its line.
#pragma once

#include "base/error.h"

namespace mvs::core {

// Returns the error of a valve that was read from `text` with the line of its part: the statement
// of a node, triangle, edge, chord or head, or the `#mvs` line of a part with a name. The error is
// returned unchanged if its part has no line of its own ("nodes", "sheet"). Scans the text, which
// the reader has accepted, so that reading a valid file does not have to keep lines.
Error with_line_of_part(const Error &error, std::string_view text);

}  // namespace mvs::core
