// The tissue of the leaflets, as an option of commands.
#pragma once

#include <CLI/CLI.hpp>
#include <mvs/mvs.hpp>
#include <string>

namespace cli {

void add_tissue_option(CLI::App &command, std::string &choice);

// Gives the leaflets what the option says: "file" leaves them, "membrane" turns springs into the
// membrane of the same curve and leaves membranes, any other word is a law with its defaults.
void set_tissue(mvs::Sim &sim, const std::string &choice);

// The laws of the leaflets, in their order, each once: "spring", "fung".
std::string laws_of(const mvs::Snapshot &valve);

}  // namespace cli
