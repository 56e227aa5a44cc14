// Moves and merges chordae when a vertex of the sheet is collapsed into another.
#include "anatomy/coarse_chordae.h"

#include <algorithm>
#include <numeric>

namespace mvs::core {
namespace {

// Least rest length after a move, as a share of the old rest length or of the new distance.
constexpr double shortest = 0.5;
// m: a chord between nodes nearer than this has no direction.
constexpr double no_length = 1e-6;

// Returns whether two chordae differ only in size and place.
bool same_tissue(const Chord &a, const Chord &b) {
  Chord other = b;
  other.id = a.id;
  other.name = a.name;
  other.a = a.a;
  other.b = a.b;
  other.rest_length = a.rest_length;
  other.area = a.area;
  return other == a;
}

}  // namespace

CoarseChordae::CoarseChordae(const Model &model)
    : model_(model),
      chords_(model.valve.chords),
      part_of_(chords_.size()),
      at_(model.node_count()) {
  std::iota(part_of_.begin(), part_of_.end(), 0u);
  for (uint32_t c = 0; c < chords_.size(); ++c) {
    for (const uint32_t node : {chords_[c].a, chords_[c].b}) {
      if (!model.topology.node_triangles[node].empty()) at_[node].push_back(c);
    }
  }
}

bool CoarseChordae::sewn(uint32_t vertex) const {
  return std::any_of(at_[vertex].begin(), at_[vertex].end(),
                     [&](uint32_t c) { return chords_[c].kind == ChordKind::suture; });
}

// Returns the end that is not on the sheet, which stays.
uint32_t CoarseChordae::far_end(const Chord &chord) const {
  return model_.topology.node_triangles[chord.b].empty() ? chord.b : chord.a;
}

// Returns the rest length of a chord whose leaflet end moves to another vertex.
double CoarseChordae::moved_length(const Chord &chord, uint32_t to) const {
  const std::vector<Vec3> &x = model_.valve.rest;
  const uint32_t stays = far_end(chord), moves = chord.other_end(stays);
  return chord.rest_length + (x[to] - x[stays]).norm() - (x[moves] - x[stays]).norm();
}

// Returns the chord at `to` with the same far end as this chord, or `none`.
uint32_t CoarseChordae::same_ends(uint32_t chord, uint32_t to) const {
  for (const uint32_t c : at_[to]) {
    if (far_end(chords_[c]) == far_end(chords_[chord])) return c;
  }
  return none;
}

bool CoarseChordae::may_move(uint32_t from, uint32_t to) {
  const bool can = can_move(from, to);
  steps_.push_back({from, to, can ? ChordStep::allowed : ChordStep::refused});
  return can;
}

bool CoarseChordae::repeat(const std::vector<ChordStep> &steps) {
  for (const ChordStep &step : steps) {
    if (step.kind == ChordStep::moved) {
      move(step.from, step.to);
    } else if (can_move(step.from, step.to) != (step.kind == ChordStep::allowed)) {
      return false;
    }
  }
  return true;
}

bool CoarseChordae::can_move(uint32_t from, uint32_t to) const {
  if (sewn(from) || sewn(to)) return at_[from].empty();
  for (const uint32_t c : at_[from]) {
    const Chord &chord = chords_[c];
    const uint32_t stays = far_end(chord);
    const double distance = (model_.valve.rest[stays] - model_.valve.rest[to]).norm();
    const double length = moved_length(chord, to);
    if (distance < no_length || length < shortest * std::min(chord.rest_length, distance)) {
      return false;
    }
    const uint32_t other = same_ends(c, to);
    if (other == none) continue;
    const bool same_direction = (stays == chord.a ? chords_[other].a : chords_[other].b) == stays;
    if (!same_direction || !same_tissue(chord, chords_[other])) return false;
  }
  return true;
}

void CoarseChordae::move(uint32_t from, uint32_t to) {
  if (at_[from].empty()) return;
  steps_.push_back({from, to, ChordStep::moved});
  for (const uint32_t c : at_[from]) {
    Chord &chord = chords_[c];
    chord.rest_length = moved_length(chord, to);
    const uint32_t other = same_ends(c, to);
    (chord.a == from ? chord.a : chord.b) = to;
    if (other == none) {
      at_[to].push_back(c);
      continue;
    }
    const uint32_t first = std::min(c, other), second = std::max(c, other);
    Chord &both = chords_[first];
    const Chord &part = chords_[second];
    const double stiffness = both.area / both.rest_length + part.area / part.rest_length;
    both.area += part.area;
    both.rest_length = both.area / stiffness;
    part_of_[second] = first;
    std::replace(at_[to].begin(), at_[to].end(), other, first);
  }
  at_[from].clear();
  std::sort(at_[to].begin(), at_[to].end());
}

std::vector<Chord> CoarseChordae::left() const {
  std::vector<Chord> chords;
  for (uint32_t c = 0; c < chords_.size(); ++c) {
    if (part_of_[c] == c) chords.push_back(chords_[c]);
  }
  return chords;
}

const Chord &CoarseChordae::whole(uint32_t chord) const {
  while (part_of_[chord] != chord) chord = part_of_[chord];
  return chords_[chord];
}

uint32_t CoarseChordae::merged() const {
  return static_cast<uint32_t>(chords_.size() - left().size());
}

uint32_t CoarseChordae::moved() const {
  uint32_t count = 0;
  for (uint32_t c = 0; c < chords_.size(); ++c) {
    const Chord &old = model_.valve.chords[c], &now = whole(c);
    count += now.a != old.a || now.b != old.b;
  }
  return count;
}

double CoarseChordae::largest_move() const {
  const std::vector<Vec3> &x = model_.valve.rest;
  double largest = 0;
  for (uint32_t c = 0; c < chords_.size(); ++c) {
    const Chord &old = model_.valve.chords[c], &now = whole(c);
    largest = std::max({largest, (x[now.a] - x[old.a]).norm(), (x[now.b] - x[old.b]).norm()});
  }
  return largest;
}

}  // namespace mvs::core
