// Chordae of the parametric valve: number, distribution over scallops, names, rest lengths.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>

#include "anatomy/parametric.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

mvs_parametric_desc described(uint32_t vertices, uint32_t chords, uint32_t branching) {
  mvs_parametric_desc desc{};
  desc.shape = MVS_SHAPE_FOUNDING;
  desc.struct_size = sizeof desc;
  desc.vertices = vertices;
  desc.chords = chords;
  desc.branching = branching;
  return desc;
}

std::map<ChordKind, int> count_kinds(const Valve &valve) {
  std::map<ChordKind, int> kinds;
  for (const Chord &chord : valve.chords) ++kinds[chord.kind];
  return kinds;
}

std::string scallop_in(const std::string &name) {
  return name.substr(0, name.find('/'));
}

}  // namespace

TEST_CASE("the_requested_number_of_straight_chordae_end_on_distinct_vertices") {
  for (uint32_t vertices : {200u, 425u, 2000u}) {
    for (uint32_t chords : {20u, 40u, 80u, 120u}) {
      CAPTURE(vertices);
      CAPTURE(chords);
      const Valve valve = make_parametric_valve(described(vertices, chords, 0));
      CHECK(valve.chords.size() == chords);
      std::set<uint32_t> ends;
      for (const Chord &chord : valve.chords) ends.insert(chord.b);
      CHECK(ends.size() == chords);
    }
  }
}

TEST_CASE("branching_chordae_spring_from_trunks_and_reach_the_leaflets") {
  const Valve valve = make_parametric_valve(described(425, 80, 1));
  CHECK(std::abs(static_cast<int>(valve.chords.size()) - 80) <= 8);
  std::map<uint32_t, int> trunks, branches;
  std::set<uint32_t> heads, leaflet;
  for (const Head &head : valve.heads) heads.insert(head.node);
  for (const Tri &triangle : valve.triangles) leaflet.insert(triangle.begin(), triangle.end());
  for (const Chord &chord : valve.chords) {
    if (chord.kind == ChordKind::trunk) {
      CHECK(heads.count(chord.a) == 1);
      ++trunks[chord.b];
    } else {
      CHECK(leaflet.count(chord.b) == 1);
      if (!heads.count(chord.a)) ++branches[chord.a];
    }
  }
  CHECK(trunks.size() >= 16);
  CHECK(trunks.size() == branches.size());
  for (const auto &[node, count] : branches) {
    CHECK(trunks[node] == 1);
    CHECK(count >= 2);
    CHECK(count <= 3);
  }
}

TEST_CASE("every_scallop_has_chordae_and_every_kind_occurs") {
  for (uint32_t branching : {0u, 1u}) {
    const Valve valve = make_parametric_valve(described(425, 80, branching));
    std::set<std::string> scallops, names;
    for (const Chord &chord : valve.chords) {
      scallops.insert(scallop_in(chord.name));
      names.insert(chord.name);
    }
    CHECK(scallops == std::set<std::string>{"A1", "A2", "A3", "P1", "P2", "P3"});
    CHECK(names.size() == valve.chords.size());
    const auto kinds = count_kinds(valve);
    CHECK(kinds.at(ChordKind::strut) == 2);
    for (const ChordKind kind :
         {ChordKind::marginal, ChordKind::rough_zone, ChordKind::basal, ChordKind::commissural}) {
      CHECK(kinds.at(kind) >= 6);
    }
    CHECK(kinds.count(ChordKind::trunk) == branching);
  }
}

TEST_CASE("each_muscle_serves_its_own_half_of_both_leaflets") {
  const Valve valve = make_parametric_valve(described(425, 80, 0));
  std::map<uint32_t, std::string> muscle;
  for (const Head &head : valve.heads) muscle[head.node] = head.name.substr(0, 2);
  std::map<std::string, std::set<char>> served;
  for (const Chord &chord : valve.chords) {
    const std::string &name = muscle.at(chord.a);
    CHECK((valve.rest[chord.b].x() > 0) == (name == "PM"));
    CHECK((valve.rest[chord.a].x() > 0) == (name == "PM"));
    served[name].insert(chord.name[0]);
  }
  CHECK(served["AL"] == std::set<char>{'A', 'P'});
  CHECK(served["PM"] == std::set<char>{'A', 'P'});
}

TEST_CASE("marginal_chordae_end_at_the_free_edge_and_basal_ones_on_the_posterior_leaflet") {
  const Valve valve = make_parametric_valve(described(1700, 80, 0));
  std::map<Edge, int> uses;
  for (const Tri &t : valve.triangles) {
    for (int k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      ++uses[{a, b}];
    }
  }
  std::set<uint32_t> boundary;
  for (const auto &[edge, count] : uses) {
    if (count == 1) boundary.insert(edge.begin(), edge.end());
  }
  for (const Chord &chord : valve.chords) {
    if (chord.kind == ChordKind::marginal) CHECK(boundary.count(chord.b) == 1);
    if (chord.kind == ChordKind::basal) CHECK(chord.name[0] == 'P');
    if (chord.kind == ChordKind::strut) CHECK(chord.name[0] == 'A');
  }
}

TEST_CASE("attachments_and_lengths_stay_where_they_are_under_refinement") {
  const Valve coarse = make_parametric_valve(described(425, 80, 0));
  const Valve fine = make_parametric_valve(described(6800, 80, 0));
  CHECK(count_kinds(coarse) == count_kinds(fine));
  std::vector<Vec3> a, b;
  for (size_t i = 0; i < coarse.chords.size(); ++i) {
    const Chord &p = coarse.chords[i], &q = fine.chords[i];
    CHECK(p.kind == q.kind);
    // each is at most an edge of the coarse mesh, about 2 mm, away from its place; a chord whose
    // vertex is taken by another is at most two edges away
    CHECK((coarse.rest[p.b] - fine.rest[q.b]).norm() < 4e-3);
    CHECK(std::abs(p.rest_length - q.rest_length) < 4e-3);
  }
}

TEST_CASE("slack_multiplies_every_rest_length") {
  mvs_parametric_desc desc = described(425, 80, 1);
  const Valve plain = make_parametric_valve(desc);
  desc.chord_slack = 1.25;
  const Valve slack = make_parametric_valve(desc);
  for (size_t i = 0; i < plain.chords.size(); ++i) {
    CHECK(slack.chords[i].rest_length == about(1.25 * plain.chords[i].rest_length, 1e-14));
  }
}
