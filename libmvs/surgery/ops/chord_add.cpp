// Operations chord_add and neochord: natural and artificial chordae.
#include <numbers>

#include "base/error.h"
#include "surgery/leaflet/site.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

struct NewChord {
  Id head;
  mvs_site site;
  double length, young, area;
  ChordKind kind;
  const char *name;
};

// Adds a chord and returns its index; `made` becomes its id.
uint32_t tie(Surgery &s, const NewChord &given) {
  const uint32_t head = head_of(s, given.head), node = node_at(s, given.site);
  must_not_be_tied(s, s.valve.heads.get()[head].node, node);
  Chord chord;
  chord.id = s.made = new_id(s);
  chord.name = given.name && *given.name ? given.name : free_chord_name(s, node);
  chord.a = s.valve.heads.get()[head].node;
  chord.b = node;
  chord.kind = given.kind;
  chord.rest_length = given.length;
  if (given.length == 0) chord.rest_length = length_like_neighbours(s, head, node);
  if (given.young != 0) chord.young = given.young;
  if (given.area != 0) chord.area = given.area;
  s.title = format("chord %s from %s, %.1f mm", chord.name.c_str(),
                   s.valve.heads.get()[head].name.c_str(), 1e3 * chord.rest_length);
  s.valve.chords.push_back(std::move(chord));
  return static_cast<uint32_t>(s.valve.chords.size() - 1);
}

}  // namespace

void operate(Surgery &s, const mvs_op_chord_add &op) {
  MVS_MUST(op.reserved == 0, MVS_E_ARGUMENT, "chord_add", "chord_add.reserved has to be 0");
  tie(s,
      {op.head, op.site, op.length, op.young, op.area, static_cast<ChordKind>(op.type), op.name});
  s.title = "Add " + s.title;
}

// Expanded PTFE; OPERATIONS.md has the source of its modulus.
void operate(Surgery &s, const mvs_op_neochord &op) {
  MVS_MUST(op.reserved == 0, MVS_E_ARGUMENT, "neochord", "neochord.reserved has to be 0");
  constexpr double ptfe_young = 0.4e9, strand = 0.3e-3;
  const double diameter = op.diameter != 0 ? op.diameter : strand;
  const uint32_t strands = op.strands != 0 ? op.strands : 2;
  const double area = strands * std::numbers::pi / 4 * diameter * diameter;
  tie(s, {op.head, op.site, op.length, op.young != 0 ? op.young : ptfe_young, area,
          ChordKind::marginal, op.name});
  s.title = "Add neochord, " + s.title;
}

}  // namespace mvs::core
