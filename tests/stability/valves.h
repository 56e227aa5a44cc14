// The valves that cases are played on.
#pragma once

#include <mvs/experimental.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace stability {

// "S", "M", "L", "XL": the parametric valve with 425, 1,700, 6,800, 27,000 vertices; "S2": with
// branching chordae; "N32": a valve on a real annulus (alexkaiser/heart_valves).
bool is_there(const std::string &name);
void make_valve(mvs::Simulator &sim, const std::string &name);

// The valve at rest under systolic pressure; settled once, then kept.
const mvs::Snapshot &closed_valve(const std::string &name);

// Moves the present shape, the rest shape or both: nodes by number, kind and place in m.
using Displacement =
    std::function<std::array<double, 3>(size_t node, uint8_t kind, std::array<double, 3> at)>;
enum class Places { now, rest };
// A new valve like a snapshot, with a displaced shape; through a file, as no other call sets both.
mvs_result set_displaced(mvs::Simulator &sim, const mvs::Snapshot &from, Places which,
                         const Displacement &displaced);

}  // namespace stability
