// Leaflet and chord laws: derivatives against differences, also beyond the cut-off of the
// exponents.
#include <doctest/doctest.h>
#include <cmath>

#include "model/chord_law.h"
#include "model/law.h"
#include "tests/about.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

// Relative to the compared value: h^2 of central differences at h = 1e-5 of numbers of the order of
// 1 whose third derivative may be 1e3 times the first, and rounding 1e-16 / h.
bool close(double a, double b, double size) {
  return std::abs(a - b) <= 1e-6 * size;
}

void check_response(const LeafletLaw &law, const Constants &c, double i1, double i4) {
  const double h = 1e-5;
  const Response at = law.response(c, i1, i4);
  const Response up = law.response(c, i1 + h, i4), down = law.response(c, i1 - h, i4);
  const Response over = law.response(c, i1, i4 + h), under = law.response(c, i1, i4 - h);
  const double slope = std::abs(at.w1) + std::abs(at.w4);
  const double curve = slope + std::abs(at.w11) + std::abs(at.w14) + std::abs(at.w44);
  CHECK(close((up.w - down.w) / (2 * h), at.w1, curve));
  CHECK(close((over.w - under.w) / (2 * h), at.w4, curve));
  CHECK(close((up.w1 - down.w1) / (2 * h), at.w11, 100 * curve));
  CHECK(close((over.w1 - under.w1) / (2 * h), at.w14, 100 * curve));
  CHECK(close((over.w4 - under.w4) / (2 * h), at.w44, 100 * curve));
}

}  // namespace

TEST_CASE("every_law_has_the_derivatives_of_its_energy") {
  for (const LeafletLaw &law : leaflet_laws()) {
    if (!law.response) continue;
    CAPTURE(law.word);
    const Constants c = default_constants(law.constants);
    for (const double i1 : {3.001, 3.1611, 3.3, 4.0}) {
      for (const double i4 : {0.7, 1.001, 1.2}) check_response(law, c, i1, i4);
    }
  }
}

TEST_CASE("laws_are_zero_at_rest_and_finite_when_a_triangle_is_crushed") {
  for (const LeafletLaw &law : leaflet_laws()) {
    if (!law.response) continue;
    CAPTURE(law.word);
    const Constants c = default_constants(law.constants);
    CHECK(law.response(c, 3, 1).w == 0);
    double last = 0;
    for (const double i1 : {4.0, 10.0, 1e3, 1e6}) {
      const Response r = law.response(c, i1, 4);
      CHECK(std::isfinite(r.w11));
      CHECK(r.w > last);  // and the energy increases further
      last = r.w;
    }
  }
}

namespace {

// Stretched along the fibre, equally narrower across and through the sheet: l, 1 / sqrt(l), 1 /
// sqrt(l).
Response stretched(const LeafletLaw &law, const Constants &c, double l) {
  return law.response(c, l * l + 2 / l, l * l);
}
double cauchy(const Response &r, double l) {
  return 2 * r.w1 * (l * l - 1 / l) + 2 * r.w4 * l * l;
}

}  // namespace

TEST_CASE("exponentials_continue_past_the_range_of_leaflets_and_end_without_a_jump") {
  struct Tissue {
    LeafletLawId law;
    Constants constants;
    double (*published)(double l);  // W, J/m3
  };
  const Tissue tissues[] = {{LeafletLawId::fung,
                             {1e3, 124, 4.568202},
                             [](double l) {
                               const double x = l * l + 2 / l - 3;
                               return 500 * x + 62 * (std::exp(4.568202 * x * x) - 1);
                             }},
                            {LeafletLawId::may_newman_yin,
                             {399, 4.325, 1446.5},
                             [](double l) {
                               const double x = l * l + 2 / l - 3;
                               return 399 *
                                      (std::exp(4.325 * x * x + 1446.5 * std::pow(l - 1, 4)) - 1);
                             }},
                            {LeafletLawId::prot, {171, 5.28, 6.46}, [](double l) {
                               const double x = l * l + 2 / l - 3, y = l * l - 1;
                               return 171 * (std::exp(5.28 * x * x + 6.46 * y * y) - 1);
                             }}};
  for (const Tissue &t : tissues) {
    const LeafletLaw &law = *find_leaflet_law(t.law);
    CAPTURE(law.word);
    constexpr double h = 1e-6;
    int k = 0;
    const auto stretch = [&] { return 1 + h * k; };
    // rounding in the exponent, and of I1 - 3 times a modulus of 100 kPa near rest
    for (; t.published(stretch()) < 99e3; k += 1000) {
      const double l = stretch();
      const double w = t.published(l);
      CHECK(std::abs(stretched(law, t.constants, l).w - w) < 1e-11 * (1 + w));
    }
    while (t.published(stretch()) > 99e3) --k;
    double last = cauchy(stretched(law, t.constants, stretch()), stretch());
    CHECK(last > 5e6);
    // to where W is twice as large: the stress increases further, without a jump
    bool rises = true, jumps = false;
    for (; t.published(stretch()) < 200e3; ++k) {
      const double stress = cauchy(stretched(law, t.constants, stretch()), stretch());
      rises = rises && stress >= last;
      jumps = jumps || stress > (1 + 1e-3) * last;  // exp(q) along h: less than 2e-4
      last = stress;
    }
    CHECK(rises);
    CHECK(!jumps);
  }
}

TEST_CASE("a_neo_hookean_sheet_bends_with_the_lesser_of_its_two_moduli") {
  const LeafletLaw &law = *find_leaflet_law(LeafletLawId::neo_hookean);
  CHECK(bending_modulus(law, {2e5, 112e3}) == 112e3);
  CHECK(bending_modulus(law, {1e4, 112e3}) == 3e4);
  CHECK(bending_modulus(law, {2e5, 0}) == 6e5);  // 0: no limit
  const LeafletLaw &membrane = *find_leaflet_law(LeafletLawId::bilinear);
  const double at_rest = bending_modulus(membrane, default_constants(membrane.constants));
  const double limit = default_constants(law.constants)[1];
  CHECK(std::abs(limit - at_rest) < 0.5e3);  // the default is that modulus in whole kPa
}

TEST_CASE("chord_laws_have_the_derivatives_of_their_energy") {
  Valve valve;
  valve.curves = {{0, "measured", {{0.02, 0}, {0.08, 1e6}, {0.11, 4e6}}}};
  Chord chord;
  const double h = 1e-6;
  for (const ChordLaw &law : chord_laws()) {
    CAPTURE(law.word);
    chord.law = law.id;
    if (law.id == ChordLawId::bilinear) chord.constants = {0.05, 100e6};
    if (law.id == ChordLawId::ogden) chord.constants = {4.24e6, 55.9, 2.72e6, 1e-4, 37, 70.7};
    if (law.id == ChordLawId::table) chord.constants = {0};
    for (const double e : {0.01, 0.03, 0.07, 0.1, 0.2}) {
      CAPTURE(e);
      const Axial at = chord_response(valve, chord, e);
      const Axial up = chord_response(valve, chord, e + h),
                  down = chord_response(valve, chord, e - h);
      CHECK(close((up.energy - down.energy) / (2 * h), at.stress, at.stress + 1e3));
      CHECK(close((up.stress - down.stress) / (2 * h), at.slope, at.slope + 1e3));
    }
    CHECK(chord_response(valve, chord, -0.1).stress == 0);
  }
}

TEST_CASE("an_ogden_chord_continues_along_its_tangent_past_its_rupture_strain") {
  Valve valve;
  Chord chord;
  chord.law = ChordLawId::ogden;
  chord.constants = {18.9e6, 98.25, 22.7e6, 98.25, 19.5e6, 98.25};  // Texas TriValve, anterior
  double edge = 0;
  while (chord_response(valve, chord, edge).stress <= 100e6) edge += 1e-5;
  const Axial before = chord_response(valve, chord, edge - 1e-5);
  const Axial far = chord_response(valve, chord, 2), farther = chord_response(valve, chord, 3);
  CHECK(far.slope == farther.slope);
  CHECK(farther.stress - far.stress == about(far.slope, 1e-12));  // rounding
  // the slope grows by a factor exp(98 x 1e-5) a step
  CHECK(far.slope == about(before.slope, 2e-3));
}

TEST_CASE("a_table_passes_through_its_points_and_continues_with_the_last_slope") {
  Valve valve;
  valve.curves = {{0, "measured", {{0.02, 0}, {0.08, 1e6}, {0.11, 4e6}}}};
  Chord chord;
  chord.law = ChordLawId::table;
  // rounding of a strain over a slope of 17 MPa
  CHECK(std::abs(chord_response(valve, chord, 0.02).stress) < 1e-8);
  CHECK(chord_response(valve, chord, 0.08).stress == about(1e6, 1e-12));
  CHECK(chord_response(valve, chord, 0.11).stress == about(4e6, 1e-12));
  CHECK(chord_response(valve, chord, 0.12).stress == about(5e6, 1e-12));
  CHECK(chord_response(valve, chord, 0.12).energy ==
        about(0.5 * 0.06 * 1e6 + 0.5 * 0.03 * 5e6 + 0.5 * 0.01 * 9e6, 1e-12));
}
