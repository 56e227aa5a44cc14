// Switches of chordae and springs, by their lengths.
#include "sensitivity/switches.h"

#include <cmath>

#include "model/chord_law.h"
#include "sensitivity/chord_site.h"

namespace mvs::core {
namespace {

// Strain beside a kink at which its slopes are taken: small for every law.
constexpr double beside = 1e-9;

std::vector<NodeVector> elongation(const Edge &nodes, const std::vector<Vec3> &x) {
  const Vec3 along = (x[nodes[1]] - x[nodes[0]]).normalized();
  return {{nodes[0], -along}, {nodes[1], along}};
}

void add_chord(const Model &model, uint32_t c, double kink, const std::vector<Vec3> &x,
               double slack, std::vector<Switch> &to) {
  const Chord &chord = model.valve.chords[c];
  const double length = (x[chord.b] - x[chord.a]).norm();
  const double over = length - chord.rest_length * (1 + kink);
  if (!(std::abs(over) <= slack) || length == 0) return;
  const double jump = chord.area / chord.rest_length *
                      (chord_response(model.valve, chord, kink + beside).slope -
                       (kink > 0 ? chord_response(model.valve, chord, kink - beside).slope : 0));
  Switch s;
  s.kind = kink > 0 ? SwitchKind::kink : SwitchKind::chord;
  s.index = c;
  s.is_chord = true;
  s.gradient = elongation({chord.a, chord.b}, x);
  s.over = over;
  (over > 0 ? s.down : s.up) = over > 0 ? -jump : jump;
  s.rest_length = chord.rest_length;
  s.kink = kink;
  to.push_back(s);
}

}  // namespace

std::vector<Switch> find_chord_switches(const Model &model, const std::vector<Vec3> &x,
                                        double slack) {
  std::vector<Switch> list;
  for (uint32_t c = 0; c < model.valve.chords.size(); ++c) add_chord(model, c, 0, x, slack, list);
  return list;
}

void find_kinks(const Model &model, const std::vector<Vec3> &x, double slack,
                const SpringTerm &springs, std::vector<Switch> &to) {
  const Valve &valve = model.valve;
  for (uint32_t c = 0; c < valve.chords.size(); ++c) {
    const Chord &chord = valve.chords[c];
    if (chord.law == ChordLawId::bilinear) add_chord(model, c, chord.constants[0], x, slack, to);
  }
  for (const SpringTerm::Kink &at : springs.find_kinks(x, slack)) {
    Switch s;
    s.kind = SwitchKind::kink;
    s.index = at.leaflet;
    s.gradient = elongation(at.nodes, x);
    s.over = at.over;
    // the law has its stiff branch from the kink on
    (at.over >= 0 ? s.down : s.up) = at.over >= 0 ? -at.jump : at.jump;
    s.rest_length = at.rest_length;
    s.kink = valve.leaflets[at.leaflet].constants[2];
    to.push_back(s);
  }
}

NodeField field_of(const Model &model, const Switch &s) {
  NodeField field(model.node_count(), Vec3::Zero());
  for (const NodeVector &v : s.gradient) field[v.node] += v.value;
  return field;
}

double own_rate(const Model &model, const std::vector<Vec3> &x, const Switch &s,
                const Parameter &p) {
  if (s.kind == SwitchKind::contact) return 0;
  if (s.is_chord) {
    if (p.kind == ParameterKind::chord_site && p.index == s.index) {
      const ChordSite site = chord_site(model, p);
      const Vec3 u = (x[site.node] - x[site.other]).normalized();
      return u.dot(site_direction(site, x));
    }
    const bool own = p.kind == ParameterKind::chord_rest_length && p.index == s.index;
    return own ? -(1 + s.kink) : 0;
  }
  if (p.kind == ParameterKind::prestrain) return s.rest_length * (1 + s.kink);
  const bool is_own_kink = p.kind == ParameterKind::leaflet_constant && p.component == 2 &&
                           leaflet_of_parameter(model.valve, p) == s.index;
  return is_own_kink ? -s.rest_length : 0;
}

}  // namespace mvs::core
