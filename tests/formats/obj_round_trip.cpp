// OBJ files: written values are read back bit for bit, for any bits.
#include <cstring>

#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

template <typename List>
bool same_bits(const List &a, const List &b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof *a.data()) == 0);
}

bool same_bits(std::initializer_list<double> a, std::initializer_list<double> b) {
  return same_bits(std::vector<double>(a), std::vector<double>(b));
}

template <typename Part, typename Same>
bool same_parts(const CowVector<Part> &a, const CowVector<Part> &b, Same same) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const Part &p, const Part &q) {
    return p.id == q.id && p.name == q.name && same(p, q);
  });
}

void check_same_lists(const Valve &a, const Valve &b) {
  CHECK(same_bits(a.rest, b.rest));
  CHECK(same_bits(a.open, b.open));
  CHECK(same_bits(a.loaded, b.loaded));
  CHECK(same_bits(a.origin, b.origin));
  CHECK(same_bits(a.triangles, b.triangles));
  CHECK(same_bits(a.triangle_leaflet, b.triangle_leaflet));
  CHECK(same_bits(a.triangle_scallop, b.triangle_scallop));
  CHECK(same_bits(a.triangle_thickness, b.triangle_thickness));
  CHECK(same_bits(a.triangle_fibre, b.triangle_fibre));
  CHECK(same_bits(a.annulus, b.annulus));
}

void check_same_parts(const Valve &a, const Valve &b) {
  CHECK(same_parts(a.leaflets, b.leaflets, [](const Leaflet &p, const Leaflet &q) {
    return p.law == q.law && same_bits({p.thickness}, {q.thickness}) &&
           same_bits(p.constants, q.constants);
  }));
  CHECK(same_parts(a.scallops, b.scallops,
                   [](const Scallop &p, const Scallop &q) { return p.leaflet == q.leaflet; }));
  CHECK(
      same_parts(a.heads, b.heads, [](const Head &p, const Head &q) { return p.node == q.node; }));
  CHECK(same_parts(a.chords, b.chords, [](const Chord &p, const Chord &q) {
    return p.a == q.a && p.b == q.b && p.kind == q.kind && p.law == q.law &&
           same_bits(p.constants, q.constants) &&
           same_bits({p.rest_length, p.young, p.area}, {q.rest_length, q.young, q.area});
  }));
}

void check_same(const Valve &a, const State &x, const Valve &b, const State &y) {
  check_same_lists(a, b);
  check_same_parts(a, b);
  CHECK(a.name == b.name);
  CHECK(a.rings == b.rings);
  CHECK(a.curves == b.curves);
  CHECK(a.next_id == b.next_id);
  CHECK(same_bits({a.density, a.contact_thickness, a.contact_stiffness, a.bending_scale},
                  {b.density, b.contact_thickness, b.contact_stiffness, b.bending_scale}));
  CHECK(same_bits(x.x, y.x));
  CHECK(same_bits(x.v, y.v));
  CHECK(x.steps == y.steps);
  CHECK(same_bits({x.time, x.load.pressure, x.load.boundary_fraction},
                  {y.time, y.load.pressure, y.load.boundary_fraction}));
}

}  // namespace

TEST_CASE("any_valve_and_state_are_read_back_bit_for_bit") {
  for (uint64_t seed = 0; seed < 2000; ++seed) {
    CAPTURE(seed);
    const Pair pair = random_pair(seed);
    const std::string text = write_obj(pair.model, pair.state);
    const Loaded back = read_obj(text);
    check_same(pair.model.valve, pair.state, back.valve, back.state);
  }
}

TEST_CASE("a_loaded_valve_has_the_hash_of_the_saved_one") {
  const Pair pair = moving_valve();
  const std::string text = write_obj(pair.model, pair.state);
  const Pair back = complete(read_obj(text));
  CHECK(hash_of(back.model, back.state) == hash_of(pair.model, pair.state));
  CHECK(write_obj(back.model, back.state) == text);
}

TEST_CASE("a_solver_cache_comes_back") {
  Pair pair = moving_valve();
  SolverCache &cache = pair.state.cache;
  cache.version = 3;
  cache.counter = UINT64_MAX;
  for (const size_t size : {1, 6, 7, 100}) {
    while (cache.data.size() < size) cache.data.push_back(-0.1 * static_cast<double>(size));
    const std::string text = write_obj(pair.model, pair.state);
    CHECK(text.find("#mvs 1 units=mm") != std::string::npos);
    const Pair back = complete(read_obj(text));
    CHECK(back.state.cache == cache);
    CHECK(hash_of(back.model, back.state) == hash_of(pair.model, pair.state));
    CHECK(write_obj(back.model, back.state) == text);
    // a line less, or one too many
    const size_t at = text.rfind("#mvs solver_cache_data"), end = text.find('\n', at) + 1;
    std::string twice = text;
    twice.insert(end, text.substr(at, end - at));
    for (const std::string &bad : {text.substr(0, at) + text.substr(end), twice}) {
      CHECK_THROWS_AS(read_obj(bad), Error);
    }
  }
}

TEST_CASE("line_ends_and_blanks_of_other_systems_have_no_effect") {
  const Pair pair = moving_valve();
  const std::string text = write_obj(pair.model, pair.state);
  const auto hash = hash_of(pair.model, pair.state);
  std::string carriage, blanks;
  for (const char c : text) {
    carriage += c == '\n' ? "\r\n" : std::string(1, c);
    blanks += c == '\n' ? " \t\n\n \t" : c == ' ' ? " \t " : std::string(1, c);
  }
  for (const std::string &variant : {carriage, blanks, text.substr(0, text.size() - 1)}) {
    const Pair back = complete(read_obj(variant));
    CHECK(hash_of(back.model, back.state) == hash);
  }
}

TEST_CASE("statements_of_other_programs_have_no_effect") {
  const Pair pair = moving_valve();
  std::string text = write_obj(pair.model, pair.state);
  const size_t first = text.find("\nv ") + 1;
  text.insert(first,
              "mtllib valve.mtl\no Leaflet.001\nvn 0 0 1\nvt 0.5 0.5\n# a comment\nusemtl \xc3\xa4"
              "\ns off\n");
  text += "# one more comment\n\n";
  const Pair back = complete(read_obj(text));
  CHECK(hash_of(back.model, back.state) == hash_of(pair.model, pair.state));
}

TEST_CASE("colours_normals_and_negative_indices_are_read") {
  const std::string head = "#mvs 1 units=mm\n#mvs leaflet name=A\n";
  const std::string tail = "#mvs end v=3 f=4 l=1 g=1 mvs=3\n";
  const Loaded loaded = read_obj(head +
                                 "v 1 2 3 0.5 0.5 1\nv 4 5 6\nv 7 8 9\ng A\nf 1 2 3\n"
                                 "f -3 -2 -1\nf 1/1 2/2/2 3//3\nf -1/4 -2//7 1\nl 1 2 -1\n" +
                                 tail);
  const Valve &valve = loaded.valve;
  CHECK(valve.rest[0] == Vec3(1e-3, 2e-3, 3e-3));
  CHECK(valve.triangles[1] == valve.triangles[0]);
  CHECK(valve.triangles[2] == valve.triangles[0]);
  CHECK(valve.triangles[3] == Tri{2, 1, 0});
  REQUIRE(valve.chords.size() == 2);
  CHECK(valve.chords[1].a == 1);
  CHECK(valve.chords[1].b == 2);
}

TEST_CASE("the_writer_refuses_infinity_and_nan") {
  Pair pair = moving_valve();
  pair.state.x[3][1] = std::nan("");
  try {
    write_obj(pair.model, pair.state);
    CHECK(false);
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_DIVERGED);
  }
}

TEST_CASE("the_worked_example_of_the_document_is_a_valve") {
  const Pair pair = complete(read_obj(example_text()));
  CHECK(pair.model.valve.leaflets.size() == 2);
  CHECK(pair.model.valve.chords.size() == 4);
  const Pair again = complete(read_obj(write_obj(pair.model, pair.state)));
  CHECK(hash_of(again.model, again.state) == hash_of(pair.model, pair.state));
}

TEST_CASE("a_state_with_tools_is_not_at_rest_without_them") {
  Pair pair = moving_valve();
  pair.state.rest_tolerance = 1e-5;
  CHECK(read_obj(write_obj(pair.model, pair.state)).state.is_at_rest());
  pair.state.tools = {Tool{}};
  CHECK_FALSE(read_obj(write_obj(pair.model, pair.state)).state.is_at_rest());
}
