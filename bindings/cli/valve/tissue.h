// The option --leaflet: the material law of the leaflets.
#pragma once

#include <CLI/CLI.hpp>
#include <mvs/mvs.hpp>
#include <string>

#include "text/console.h"

namespace cli {

void add_tissue_option(CLI::App &command, std::string &choice);

// The option --leaflet of a valve that is made, whose help says the default, and the number of its
// law: 0 for "".
void add_law_option(CLI::App &command, std::string &choice, const std::string &fallback);
mvs_leaflet_law law_of(const std::string &choice);

// The law of the finding "tissue" in a file of findings. Fails for a number that no law has.
mvs_leaflet_law law_of_finding(double number, const std::string &path);

// Sets the law of the leaflets. "file" leaves it, "membrane" turns springs into the membrane of the
// same stress-strain curve and leaves membranes, any other word is a law with its default
// constants.
void set_tissue(mvs::Simulator &sim, const std::string &choice);

// The distinct laws of the leaflets in their order: "spring, fung".
std::string laws_of(const mvs::Snapshot &valve);

// A row for each leaflet: its name, law, constants and thickness; and the same as lines of text.
Json tissue_rows(const mvs::Snapshot &valve);
std::string tissue_text(const Json &rows);

}  // namespace cli
