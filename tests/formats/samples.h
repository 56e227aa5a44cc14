// Fixtures: valves and states to write and read, one valid and many random ones.
#pragma once

#include <mvs/valve.h>

#include <doctest/doctest.h>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "base/error.h"
#include "formats/formats.h"
#include "model/chord_law.h"
#include "model/model.h"
#include "tests/model/small_valve.h"

namespace mvs::core {

// A model and its state.
struct Pair {
  Model model;
  State state;
};

using Hash128 = std::array<uint64_t, 2>;

inline Hash128 hash_of(const ModelState &current) {
  return hash_of(*current.model, current.state);
}

// The example of FORMAT.md: nine nodes.
inline std::string example_text() {
  std::stringstream document;
  document << std::ifstream(MVS_SOURCE_DIR "/formats/FORMAT.md").rdbuf();
  const std::string text = document.str(), fence = "```obj\n";
  const size_t start = text.find(fence) + fence.size();
  return text.substr(start, text.find("```", start) - start);
}

// Writes a checked-in file anew where the environment has MVS_WRITE_GOLDEN.
template <typename Make>
void write_golden(const std::string &path, Make make) {
  if (std::getenv("MVS_WRITE_GOLDEN")) std::ofstream(path, std::ios::binary) << make();
}

// Model and state of a file's content.
inline Pair complete(const Loaded &loaded) {
  return {*make_model(loaded.valve), loaded.state};
}

// Sets every field that a file can hold to a value that is not its default.
inline Pair in_motion(Valve valve) {
  valve.name = "in motion";
  valve.loaded = valve.rest;
  for (const uint32_t node : valve.annulus) valve.loaded[node] *= 0.95;
  valve.loaded[valve.heads[0].node] += Vec3(1e-3, -2e-3, 3e-3);
  valve.open = valve.rest;
  valve.open[valve.annulus[0]] += Vec3(1e-4, 0, 0);
  valve.origin.resize(valve.rest.size(), 3u);
  valve.origin.back() = none;
  valve.rings.push_back({0, "ring 1", RingKind::rigid, {Vec3(0, 1e-3, 2e-3), Vec3(1e-3, 0, 0)}});
  valve.rings.push_back({0, "band", RingKind::band, {}});
  valve.scallops = {{0, "A2", 0}, {0, "P1", 1}, {0, "P3", 1}};
  valve.triangle_scallop.clear();
  valve.triangle_thickness.clear();
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    const uint32_t leaflet = valve.triangle_leaflet[t];
    valve.triangle_scallop.push_back(leaflet == 0 ? 0 : 1 + static_cast<uint32_t>(t / 2 % 2));
    valve.triangle_thickness.push_back(t % 5 == 0 ? 1.3e-3 : 1e-3);
  }
  valve.leaflets[1].constants = {90e3, 5.5e6, 0.3};
  valve.chords[2].young = 35e6;
  valve.chords[3].area = 5e-7;
  valve.next_id = 1000;
  valve.bending_scale = 0.5;
  Pair pair{*make_model(valve), {}};
  pair.state = initial_state(pair.model);
  for (size_t n = 0; n < pair.state.x.size(); n += 3) {
    pair.state.x[n] += Vec3(1e-4, 2e-4, -3e-4) * std::sin(static_cast<double>(n + 1));
    pair.state.v[n] = Vec3(0.1, -0.2, 0.3) * std::cos(static_cast<double>(n));
  }
  pair.state.time = 0.125;
  pair.state.steps = 125;
  pair.state.load = {15998.64, 0.75};
  return pair;
}

// 68 nodes for inspection, 9 nodes for tests that change every byte.
inline Pair moving_valve() {
  return in_motion(small_valve());
}
inline Pair moving_example() {
  return in_motion(read_obj(example_text()).valve);
}

// Numbers of any bits but infinity and NaN, a quarter of them subnormal.
class RandomBits {
 public:
  explicit RandomBits(uint64_t seed) : engine_(seed) {}
  uint64_t bits() { return engine_(); }
  uint32_t below(uint32_t limit) { return static_cast<uint32_t>(engine_() % limit); }
  double number() {
    for (;;) {
      const uint64_t word = engine_();
      const double value =
          std::bit_cast<double>(word % 4 == 0 ? word & ~(uint64_t{0x7ff} << 52) : word);
      if (std::isfinite(value)) return value;
    }
  }
  Vec3 place() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  // Within 0.5 m, as readers demand of a node and its rest position: large exponents become small.
  Vec3 near() {
    Vec3 place;
    for (int k = 0; k < 3; ++k) {
      const double value = number();
      const uint64_t word = std::bit_cast<uint64_t>(value);
      const uint64_t exponent = uint64_t{0x3c0 + below(60)} << 52;
      place[k] = std::abs(value) < 0.25
                     ? value
                     : std::bit_cast<double>((word & ~(uint64_t{0x7ff} << 52)) | exponent);
    }
    return place;
  }
  std::string name(uint32_t number) {
    std::string text = std::to_string(number) + ":";
    for (uint32_t k = below(12); k > 0; --k) text += character(bits());
    return text;
  }

 private:
  // A character of UTF-8 of one to four bytes.
  static std::string character(uint64_t bits) {
    const auto number = static_cast<uint32_t>(bits >> 8);
    const auto low = [&](uint32_t code, int shift) {
      return static_cast<char>(0x80 | ((code >> shift) & 0x3f));
    };
    if (bits % 4 == 0) return {static_cast<char>(number % 0x80)};
    if (bits % 4 == 1) {
      const uint32_t code = 0x80 + number % 0x780;
      return {static_cast<char>(0xc0 | code >> 6), low(code, 0)};
    }
    if (bits % 4 == 2) {
      const uint32_t code = 0x800 + number % 0xd000;
      return {static_cast<char>(0xe0 | code >> 12), low(code, 6), low(code, 0)};
    }
    const uint32_t code = 0x10000 + number % 0x100000;
    return {static_cast<char>(0xf0 | code >> 18), low(code, 12), low(code, 6), low(code, 0)};
  }

  std::mt19937_64 engine_;
};

template <typename Part>
std::vector<Part> random_parts(RandomBits &random, uint32_t least) {
  std::vector<Part> parts(least + random.below(5));
  for (uint32_t k = 0; k < parts.size(); ++k) {
    parts[k].id = random.bits();
    parts[k].name = random.name(k);
  }
  return parts;
}

inline void draw_curves(RandomBits &random, Valve &valve) {
  for (ChordCurve &curve : valve.curves) {
    for (uint32_t k = random.below(4); k > 0; --k) {
      const double strain = random.number(), stress = random.number();
      curve.points.push_back({strain, stress});
    }
  }
}

inline void draw_nodes(RandomBits &random, uint32_t n, Pair &pair) {
  Valve &valve = pair.model.valve;
  for (uint32_t k = 0; k < n; ++k) {
    pair.state.x.push_back(random.near());
    pair.state.v.push_back(random.below(2) == 0 ? random.near() : Vec3::Zero());
    valve.rest.push_back(random.below(2) == 0 ? random.near() : pair.state.x.back());
    valve.open.push_back(random.below(2) == 0 ? random.place() : valve.rest.back());
    valve.loaded.push_back(random.below(2) == 0 ? random.place() : valve.rest.back());
    valve.origin.push_back(random.below(2) == 0 ? random.below(n) : none);
  }
}

inline void draw_leaflets(RandomBits &random, Valve &valve) {
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.thickness = random.number();
    leaflet.law = leaflet_laws()[random.below(static_cast<uint32_t>(leaflet_laws().size()))].id;
    leaflet.constants = {};
    const size_t known = find_leaflet_law(leaflet.law)->constants.size();
    for (size_t k = 0; k < known; ++k) leaflet.constants[k] = random.number();
  }
  for (Scallop &scallop : valve.scallops) {
    scallop.leaflet = random.below(static_cast<uint32_t>(valve.leaflets.size()));
  }
}

inline void draw_triangles(RandomBits &random, uint32_t n, uint32_t count, Valve &valve) {
  for (uint32_t t = 0; t < count; ++t) {
    valve.triangles.push_back({random.below(n), random.below(n), random.below(n)});
    valve.triangle_leaflet.push_back(random.below(static_cast<uint32_t>(valve.leaflets.size())));
    valve.triangle_scallop.push_back(random.below(static_cast<uint32_t>(valve.scallops.size())));
    valve.triangle_thickness.push_back(random.number());
    valve.triangle_fibre.push_back(random.place());
  }
}

inline void draw_chords(RandomBits &random, uint32_t n, Valve &valve) {
  for (Chord &chord : valve.chords) {
    chord.a = random.below(n);
    chord.b = random.below(n);
    chord.kind = static_cast<ChordKind>(random.below(MVS_CHORD_KIND_SUTURE));
    chord.rest_length = random.number();
    chord.young = random.number();
    chord.area = random.number();
    chord.law = chord_laws()[random.below(static_cast<uint32_t>(chord_laws().size()))].id;
    if (chord.law == ChordLawId::table) {
      chord.constants[0] = random.below(static_cast<uint32_t>(valve.curves.size()));
    } else {
      const size_t known = find_chord_law(chord.law)->constants.size();
      for (size_t k = 0; k < known; ++k) chord.constants[k] = random.number();
    }
  }
}

inline void draw_numbers(RandomBits &random, Pair &pair) {
  Valve &valve = pair.model.valve;
  valve.density = random.number();
  valve.contact_thickness = random.number();
  valve.contact_stiffness = random.number();
  valve.bending_scale = random.number();
  valve.next_id = random.bits();
  pair.state.time = random.number();
  pair.state.steps = random.bits();
  pair.state.load = {4e5 * random.near()[0],
                     std::ldexp(static_cast<double>(random.bits() >> 11), -53)};
}

// Anything that fits the types and has indices in range; not a valid valve.
inline Pair random_pair(uint64_t seed) {
  RandomBits random(seed);
  Pair pair;
  Valve &valve = pair.model.valve;
  valve.name = random.name(0);
  valve.leaflets = random_parts<Leaflet>(random, 1);
  valve.scallops = random_parts<Scallop>(random, 1);
  valve.chords = random_parts<Chord>(random, 0);
  valve.heads = random_parts<Head>(random, 0);
  valve.curves = random_parts<ChordCurve>(random, 1);
  draw_curves(random, valve);
  const uint32_t n = 1 + random.below(20), m = random.below(30);
  draw_nodes(random, n, pair);
  draw_leaflets(random, valve);
  draw_triangles(random, n, m, valve);
  for (uint32_t k = random.below(40); k > 0; --k) valve.annulus.push_back(random.below(n));
  draw_chords(random, n, valve);
  for (Head &head : valve.heads) head.node = random.below(n);
  draw_numbers(random, pair);
  return pair;
}

}  // namespace mvs::core
