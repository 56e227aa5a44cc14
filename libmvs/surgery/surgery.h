// An operation at work: the valve and state it edits, and what operations share.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "surgery/operation.h"

namespace mvs::core {

// One operation under way. Everything edited here is a copy; only perform() makes it count.
struct Surgery {
  const Model &before;
  Valve valve;
  State state;
  const char *op_name;  // begins the sentence of a failure
  Id made = 0;
  std::string title = {};

  // Adds a node of the sheet, a mean of nodes that are there; its places follow theirs.
  uint32_t add_node(const std::vector<uint32_t> &nodes, const std::vector<double> &weights);
  Id new_id() { return valve.next_id++; }
};

// The index of a part of the valve by its id; throws MVS_E_ID with what the id names instead.
uint32_t chord_of(const Surgery &s, Id id);
uint32_t head_of(const Surgery &s, Id id);
uint32_t scallop_of(const Surgery &s, Id id);

// The scallop that is meant: the one with this id, or the one of this name where the id is 0.
uint32_t scallop_or(const Surgery &s, Id id, const char *name);

// Takes nodes out of the valve; nothing may refer to them any more.
void remove_nodes(Surgery &s, const std::vector<uint8_t> &gone);

// Removes chords that lead to no leaflet or to no papillary head, and their branch points.
void prune_chords(Surgery &s);

// Throws if a chord joins these nodes already.
void must_not_be_tied(const Surgery &s, uint32_t a, uint32_t b);

// The rest length at which a chord from a head to a node of the sheet is as taut as its neighbours.
double length_like_neighbours(const Surgery &s, uint32_t head, uint32_t node);

// A chord's scallop and number, free for a new one: "P2/9".
std::string free_chord_name(const Surgery &s, uint32_t node);

// One function an operation, in the file of its name.
#define OPERATION(NUMBER, op_name, help) void operate(Surgery &s, const mvs_op_##op_name &op);
#define FIELD(...)
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD

}  // namespace mvs::core
