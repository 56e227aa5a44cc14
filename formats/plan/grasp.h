// The place that a grasp holds, by which a plan finds it on another valve: anatomical coordinates
// of a leaflet vertex, or the chord segment that ends at a branch point.
#pragma once

#include "formats/text/json.h"
#include "model/model.h"

namespace mvs::core {

// Null for a node that is neither in a scallop nor at the end of a chord.
Json place_json(const Model &model, uint32_t node);

// Throws MVS_E_FORMAT unless the JSON has the fields of a place.
void check_place(const Json &place);

// Returns the node of a valve at a checked place; throws MVS_E_ID with the part that it lacks.
uint32_t node_at_place(const Model &model, const Json &place);

}  // namespace mvs::core
