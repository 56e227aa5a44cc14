// Context of an operation, the valve and state that it edits, and the functions that operations
// share.
#pragma once

#include <string>
#include <vector>

#include "model/model.h"
#include "surgery/operation.h"

namespace mvs::core {

// An operation in progress. It edits copies; perform() publishes the result.
struct Surgery {
  const Model &before;
  Valve valve;
  State state;
  const char *op_name;  // prefix of error sentences
  Id made = 0;
  std::string title = {};
};

// Adds a node of the sheet: its positions are the weighted means of those of `nodes`.
uint32_t add_node(Surgery &s, const std::vector<uint32_t> &nodes,
                  const std::vector<double> &weights);
inline Id new_id(Surgery &s) {
  return s.valve.next_id++;
}

// Return the index of a part by its id; throw MVS_E_ID with the part that has the id instead.
uint32_t chord_of(const Surgery &s, Id id);
uint32_t head_of(const Surgery &s, Id id);
uint32_t scallop_of(const Surgery &s, Id id);

// Returns the scallop with this id, or with this name if the id is 0.
uint32_t scallop_or(const Surgery &s, Id id, const char *name);

// Removes the marked nodes, which no other part may use.
void remove_nodes(Surgery &s, const std::vector<uint8_t> &gone);

// Removes chords that lead to no leaflet or to no papillary head, and their branch points.
void prune_chords(Surgery &s);

// Sets the positions to the open valve: stitches are sewn in an arrested heart, and clips close on
// open leaflets. Joining edges that are pressed on other tissue would fold or pinch it: settling
// took hundreds of iterations and left crossing creases; from the open valve it takes about 26.
void open_the_valve(Surgery &s);

// Adds a suture: a chord that joins two nodes of the sheet. Returns its id.
struct Suture {
  std::string name;
  uint32_t a, b;  // nodes
  double rest_length, young, area;
};
Id add_suture(Surgery &s, Suture suture);

// Whether a chord has this name.
bool has_chord_named(const Surgery &s, const std::string &name);

// Replaces the rings of the valve by one and sets `made`; `name` may be null or empty.
void set_ring(Surgery &s, const char *name, const char *default_name, RingKind kind,
              std::vector<Vec3> curve);

// Throws MVS_E_OP if a ring or band holds the annulus; `remedy` goes on in the sentence.
void must_have_no_ring(const Surgery &s, const char *remedy);

// Throws MVS_E_OP if the annulus would get this perimeter under load, m, and it is outside of 25 to
// 300 % of that at rest; `what` is what to take larger or smaller.
void must_be_a_perimeter(const Surgery &s, double perimeter, const char *what);

// Throws if a chord joins these nodes.
void must_not_be_tied(const Surgery &s, uint32_t a, uint32_t b);

// Returns the rest length at which a chord from a head to a sheet node is as taut as its
// neighbours.
double length_like_neighbours(const Surgery &s, uint32_t head, uint32_t node);

// Returns a chord name of scallop and number, above all numbers in use there: "P2/9".
std::string free_chord_name(const Surgery &s, uint32_t node);

// Each operation is one function, in the file of its name.
#define OPERATION(NUMBER, op_name, help) void operate(Surgery &s, const mvs_op_##op_name &op);
#define FIELD(...)
#include "surgery/ops.def"
#undef OPERATION
#undef FIELD

}  // namespace mvs::core
