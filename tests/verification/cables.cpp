// Cables and chordae: catenaries, tension-only pairs, chains that act as one cable.
#include <algorithm>
#include <cmath>

#include "tests/verification/balance.h"
#include "tests/verification/study.h"

namespace mvs::core::verification {
namespace {

Study study_of(const std::string &name, const std::string &title, const std::string &source) {
  Study s;
  s.name = name;
  s.title = title;
  s.source = source;
  return s;
}

// A chain of equal chordae between its two ends.
struct Chain {
  Model model;
  Positions load;
  Vec3 far_end;
};

Chain chain_of(uint32_t parts, double length, double ea, double weight, const Vec3 &far_end) {
  Valve valve;
  for (uint32_t k = 0; k <= parts; ++k) {
    valve.rest.push_back(static_cast<double>(k) / parts * far_end);
  }
  for (uint32_t k = 0; k < parts; ++k) {
    Chord chord;
    chord.a = k;
    chord.b = k + 1;
    chord.rest_length = length / parts;
    chord.young = ea / chord.area;
    valve.chords.push_back(chord);
  }
  Chain chain{test::model_of_sheet(valve, {0, parts}), {}, far_end};
  chain.load.assign(parts + 1, Vec3(0, 0, -weight / parts));
  return chain;
}

// From a parabola whose length is about that of the cable, so that all of it is taut.
Positions hung(const Chain &chain, double length, double tolerance) {
  const size_t parts = chain.load.size() - 1;
  const double span = chain.far_end.norm();
  const double sag = std::sqrt(std::max(0.375 * (length / span - 1), 4e-4)) * span;
  Positions start;
  for (size_t k = 0; k <= parts; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(parts);
    start.push_back(t * chain.far_end - Vec3(0, 0, 4.2 * sag * t * (1 - t)));
  }
  const Balance balance(chain.model, {0, static_cast<uint32_t>(parts)});
  return balance.rest(start, chain.load, tolerance);
}

double lowest(const Positions &x) {
  // the vertex of the parabola through the lowest node and its neighbours
  size_t at = 1;
  for (size_t k = 1; k + 1 < x.size(); ++k) {
    if (x[k].z() < x[at].z()) at = k;
  }
  const double a = x[at - 1].z(), b = x[at].z(), c = x[at + 1].z();
  return b - (c - a) * (c - a) / (8 * (a - 2 * b + c));
}

double pull(const Chain &chain, const Positions &x) {
  Positions g(x.size(), Vec3::Zero());
  CableTerm(chain.model).gradient(x, g);
  return std::abs(g[0].x());
}

// Nearly inextensible: strains of 1e-6. Rounding of positions, 1e-17 m, is 3e-9 N then.
Study catenary() {
  Study s = study_of("catenary", "A chain of stiff chordae under its weight",
                     "shared/data/verification/c_catenary.csv");
  s.quantity = "lowest point, m; pull at the ends over weight per length, m";
  s.x = "length of the cable, mm";
  s.level = "edge, m";
  s.expects = "2: a polygon for a curve";
  s.tolerance = 0.01;
  s.order_low = 1.8;
  s.order_high = 2.2;
  for (const test::Cells &row : test::reference_table("c_catenary.csv")) {
    const double span = 1e-3 * std::stod(row[0]), length = 1e-3 * std::stod(row[1]);
    const double weight = 0.1;
    const Vec3 end(span, 0, 1e-3 * std::stod(row[2]));
    for (const uint32_t parts : {5u, 10u, 20u, 40u}) {
      const Chain chain = chain_of(parts, length, 3e6 * weight, weight, end);
      const Positions x = hung(chain, length, 3e-8);
      const double edge = length / parts, mm = std::stod(row[1]);
      s.rows.push_back({"lowest point", mm, edge, lowest(x), 1e-3 * std::stod(row[5])});
      s.rows.push_back(
          {"pull", mm, edge, pull(chain, x) * length / weight, 1e-3 * std::stod(row[6])});
    }
  }
  return s;
}

Study elastic_catenary() {
  Study s = catenary();
  s.rows.clear();
  s.name = "elastic_catenary";
  s.title = "A chain of chordae under its weight";
  s.quantity = "sag, m; horizontal pull, N";
  s.x = "weight, N, plus slack, mm";
  s.source = "shared/data/verification/c_elastic_catenary.csv";
  for (const test::Cells &row : test::reference_table("c_elastic_catenary.csv")) {
    const double span = 1e-3 * std::stod(row[0]), length = 1e-3 * std::stod(row[1]);
    const double weight = std::stod(row[2]), ea = std::stod(row[3]);
    const double at = weight + 1e3 * (length - span);
    for (const uint32_t parts : {10u, 20u, 40u, 80u}) {
      const Chain chain = chain_of(parts, length, ea, weight, Vec3(span, 0, 0));
      const Positions x = hung(chain, length, 1e-11);
      s.rows.push_back({"sag", at, length / parts, -lowest(x), 1e-3 * std::stod(row[5])});
      s.rows.push_back({"pull", at, length / parts, pull(chain, x), std::stod(row[4])});
    }
  }
  return s;
}

Study tension_only() {
  Study s = study_of("tension_only", "Chordae that only pull",
                     "shared/data/verification/c_tension_only_chords.csv");
  s.quantity = "depth of the loaded node, m; tension, N";
  s.x = "load, N";
  s.expects = "exact: chordae are straight; the table has ten digits";
  s.tolerance = 1e-7;
  for (const test::Cells &row : test::reference_table("c_tension_only_chords.csv")) {
    const bool pair = row[0] == "V two chords";
    const double load = std::stod(row[1]), length = 25e-3, half = pair ? 10e-3 : 0;
    Valve valve;
    // and a chord that is slack under any load, from below
    valve.rest = {Vec3(-half, 0, 0), Vec3(half, 0, 0), Vec3(0, 0, -20e-3), Vec3(1e-3, 0, -40e-3)};
    for (const uint32_t a : {0u, 1u, 3u}) {
      if (a == 1 && !pair) continue;
      Chord chord;
      chord.a = a;
      chord.b = 2;
      chord.rest_length = length;
      valve.chords.push_back(chord);
    }
    const Model model = test::model_of_sheet(valve, {0, 1, 3});
    Positions loads(4, Vec3::Zero()), start = model.valve.rest, g = loads;
    loads[2].z() = -load;
    start[2].z() = -1.02 * std::sqrt(length * length - half * half);
    const Balance balance(model, {0, 1, 3});
    const Positions x = balance.rest(start, loads, 1e-11);
    balance.gradient(x, g);
    s.rows.push_back({row[0] + ", depth", load, 0, -x[2].z(), 1e-3 * std::stod(row[2])});
    s.rows.push_back({row[0] + ", tension", load, 0, g[0].norm(), std::stod(row[3])});
    s.rows.push_back({row[0] + ", slack chord", load, 0, g[3].norm(), 0, load});
  }
  return s;
}

// W = sum of 2 mu / alpha^2 (l^alpha + 2 l^(-alpha / 2) - 3), differentiated in extended precision.
double ogden_stress(const Chord::Constants &c, double stretch) {
  const auto energy = [&](long double l) {
    long double w = 0;
    for (size_t k = 0; k < c.size(); k += 2) {
      const long double mu = c[k], alpha = c[k + 1];
      if (mu == 0) continue;
      w += 2 * mu / (alpha * alpha) * (std::pow(l, alpha) + 2 * std::pow(l, -alpha / 2) - 3);
    }
    return w;
  };
  const long double h = 1e-4L, l = stretch;
  constexpr long double weight[] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};
  long double slope = 0;
  for (int k = 1; k <= 4; ++k) slope += weight[k - 1] * (energy(l + k * h) - energy(l - k * h));
  return static_cast<double>(slope / h);
}

// Unequal pieces of one cable, pulled by the force of the law at a stretch.
double stretch_of_chain(const Chord &law, const std::vector<double> &pieces, double force) {
  Valve valve;
  valve.curves = {{0, "measured", {{0.02, 0}, {0.08, 1e6}, {0.11, 4e6}}}};
  double at = 0;
  valve.rest.push_back(Vec3::Zero());
  for (const double piece : pieces) {
    at += piece;
    valve.rest.push_back(Vec3(0, 0, -at));
    Chord chord = law;
    chord.a = static_cast<uint32_t>(valve.rest.size()) - 2;
    chord.b = chord.a + 1;
    chord.rest_length = piece;
    valve.chords.push_back(chord);
  }
  const Model model = test::model_of_sheet(valve, {0});
  Positions load(model.node_count(), Vec3::Zero()), start = model.valve.rest;
  load.back().z() = -force;
  for (Vec3 &p : start) p *= 1.05;
  const Positions x = Balance(model, {0}).rest(start, load, 1e-10 * force);
  return -x.back().z() / at;
}

Study chain_of_cables() {
  Study s = study_of("chain_of_cables", "A chain of unequal chordae is one cable",
                     "Ogden's W, differentiated; the curves of the other laws by hand");
  s.quantity = "strain of the chain";
  s.x = "strain of the cable";
  s.expects = "exact: every piece has the same strain";
  s.tolerance = 1e-8;
  const std::vector<double> pieces = {2e-3, 5e-3, 1e-3, 7e-3, 4e-3, 6e-3};
  Chord ogden, bilinear, table;
  ogden.law = ChordLawId::ogden;
  ogden.constants = {4.24e6, 55.9, 2.72e6, 55.9, 37, 70.7};  // Texas TriValve, posterior
  bilinear.law = ChordLawId::bilinear;
  bilinear.constants = {0.05, 100e6};
  table.law = ChordLawId::table;
  table.constants = {0};
  for (const double e : {0.03, 0.06, 0.09}) {
    const auto add = [&](const char *name, const Chord &law, double stress) {
      s.rows.push_back({name, e, 0, stretch_of_chain(law, pieces, law.area * stress) - 1, e});
    };
    add("Ogden, N = 3", ogden, ogden_stress(ogden.constants, 1 + e));
    add("linear", Chord(), 40e6 * e);
    add("bilinear", bilinear, 40e6 * std::min(e, 0.05) + 100e6 * std::max(e - 0.05, 0.0));
    add("table", table, e < 0.08 ? (e - 0.02) / 0.06 * 1e6 : 1e6 + (e - 0.08) / 0.03 * 3e6);
  }
  return s;
}

}  // namespace

std::vector<Study> cable_studies() {
  return {catenary(), elastic_catenary(), tension_only(), chain_of_cables()};
}

}  // namespace mvs::core::verification
