// The chordae of a valve as a table: where each begins and ends, its length, strain and tension.
#pragma once

#include <string>
#include <vector>

#include "valve/host.h"

namespace cli {

// The word of a MVS_CHORD_KIND_*.
const char *chord_kind_name(uint32_t kind);

struct ChordRow {
  std::string name, kind;
  std::string head;  // papillary heads that hold it, joined by '+'; "" without one
  std::string site;  // scallops in which it, or its branches, end, joined by '+'
  double length = 0, rest_length = 0;  // m
  double strain = 0;                   // engineering strain, negative when slack
  double tension = 0;                  // N
  std::vector<std::string> flags;      // over strain, over tension, slack
};

// One row for each chord segment, in the order of the valve.
std::vector<ChordRow> chord_table(const mvs::Snapshot &valve);

// Orders of the table: the largest tension, strain or length first, or names as people count.
std::vector<std::string> chord_orders();

// Sorts by one of them; equal rows keep their order.
void sort_chords(std::vector<ChordRow> &rows, const std::string &order);

}  // namespace cli
