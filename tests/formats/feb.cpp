// FEBio models: the exported file contains the valve, and its formulas are the valve's laws.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "base/error.h"
#include "model/chord_law.h"
#include "tests/about.h"
#include "tests/formats/inp_text.h"

using namespace mvs::core;
using mvs::core::test::about;

namespace {

// Evaluates the formulas of FEBio: + - * / ^, exp, ln, sqrt, and variables.
class Formula {
 public:
  Formula(std::string text, std::map<std::string, double> variables)
      : text_(std::move(text)), variables_(std::move(variables)) {}
  double value() {
    at_ = 0;
    const double result = sum();
    REQUIRE(at_ == text_.size());
    return result;
  }

 private:
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  double sum() {
    double result = product();
    for (;;) {
      if (take('+')) {
        result += product();
      } else if (take('-')) {
        result -= product();
      } else {
        return result;
      }
    }
  }
  double product() {
    double result = power();
    for (;;) {
      if (take('*')) {
        result *= power();
      } else if (take('/')) {
        result /= power();
      } else {
        return result;
      }
    }
  }
  double power() {
    if (take('-')) return -power();
    const double base = atom();
    return take('^') ? std::pow(base, power()) : base;
  }
  double atom() {
    if (take('(')) {
      const double inside = sum();
      REQUIRE(take(')'));
      return inside;
    }
    const size_t start = at_;
    if (std::isalpha(static_cast<unsigned char>(text_[at_]))) {
      while (at_ < text_.size() && std::isalnum(static_cast<unsigned char>(text_[at_]))) ++at_;
      const std::string name = text_.substr(start, at_ - start);
      if (name == "exp") return std::exp(atom());
      if (name == "ln") return std::log(atom());
      if (name == "sqrt") return std::sqrt(atom());
      REQUIRE(variables_.contains(name));
      return variables_[name];
    }
    while (at_ < text_.size() &&
           (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.')) {
      ++at_;
    }
    REQUIRE(at_ > start);
    return std::stod(text_.substr(start, at_ - start));
  }

  std::string text_;
  std::map<std::string, double> variables_;
  size_t at_ = 0;
};

// The text of the first <name ...>...</name> from `from` on.
std::string inside(const std::string &text, const std::string &name, size_t from = 0) {
  const size_t open = text.find("<" + name, from);
  REQUIRE(open != std::string::npos);
  const size_t start = text.find('>', open) + 1;
  return text.substr(start, text.find("</" + name + ">", start) - start);
}

size_t count_of(const std::string &text, const std::string &piece) {
  size_t count = 0;
  for (size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) {
    ++count;
  }
  return count;
}

std::string feb_of(const Valve &valve) {
  const ModelPtr model = make_model(valve);
  return write_feb(*model, initial_state(*model));
}

Valve toy_of(LeafletLawId law) {
  Valve valve = read_inp(toy_inp()).loaded.valve;
  for (Leaflet &leaflet : valve.leaflets) {
    leaflet.law = law;
    leaflet.constants = default_constants(find_leaflet_law(law)->constants);
  }
  return valve;
}

// The points of a spring: elongation in mm, force in mN.
std::vector<std::array<double, 2>> points_of(const std::string &feb, const std::string &name) {
  const size_t from = feb.find("name=\"" + name + "\" type=\"nonlinear spring\"");
  REQUIRE(from != std::string::npos);
  std::string text = inside(feb, "points", from);
  std::vector<std::array<double, 2>> points;
  for (size_t at = text.find("<pt>"); at != std::string::npos; at = text.find("<pt>", at + 1)) {
    const size_t comma = text.find(',', at);
    points.push_back({std::stod(text.substr(at + 4)), std::stod(text.substr(comma + 1))});
  }
  return points;
}

double interpolated(const std::vector<std::array<double, 2>> &points, double x) {
  size_t k = 1;
  while (k + 1 < points.size() && points[k][0] < x) ++k;
  const auto &[x0, y0] = points[k - 1];
  const auto &[x1, y1] = points[k];
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

}  // namespace

TEST_CASE("feb_counts_are_those_of_the_valve") {
  const Imported imported = read_inp(toy_inp());
  const ModelPtr model = make_model(imported.loaded.valve);
  const std::string feb = write_feb(*model, imported.loaded.state);
  const std::string mesh = inside(feb, "Mesh");
  CHECK(count_of(mesh, "<node ") == 42);
  CHECK(count_of(mesh, "<elem ") == 48);
  CHECK(count_of(mesh, "<tri3 ") == 48);
  CHECK(count_of(mesh, "<delem>") == 12);
  CHECK(count_of(feb, "<discrete ") == 12);
  CHECK(count_of(feb, "<ShellDomain ") == 3);
  CHECK(count_of(inside(feb, "MeshData"), "<node ") == 3 * (12 + 3));
  // 3 kPa in the file, with FEBio's sign
  CHECK(feb.find("<pressure lc=\"1\">-3</pressure>") != std::string::npos);
  CHECK(inside(feb, "shell_thickness") == "0.65");
}

TEST_CASE("feb_held_nodes_go_where_the_load_of_the_state_holds_them") {
  const Imported imported = read_inp(toy_inp());
  Valve moved = make_model(imported.loaded.valve)->valve;
  for (const uint32_t node : moved.annulus) {
    moved.loaded[node] = moved.open[node] + Vec3(2e-3, 0, 0);
  }
  const ModelPtr model = make_model(moved);
  State state = imported.loaded.state;
  const uint32_t first = *std::min_element(moved.annulus.begin(), moved.annulus.end());
  for (const Load &load : {Load{3000, 1}, Load{3000, 0.25}, Load{0, 0}}) {
    state.load = load;
    const double fraction = load.pressure > 0 ? load.boundary_fraction : 1;  // 0: systole
    const std::string data = inside(write_feb(*model, state), "MeshData");
    const double open = (moved.open[first] - moved.rest[first]).x() * 1e3;
    CHECK(std::stod(inside(data, "node")) == about(open + 2 * fraction, 1e-9));
  }
}

TEST_CASE("feb_energies_are_those_of_the_laws") {
  for (const LeafletLawId law :
       {LeafletLawId::bilinear, LeafletLawId::fung, LeafletLawId::may_newman_yin,
        LeafletLawId::prot, LeafletLawId::neo_hookean}) {
    CAPTURE(law);
    const Valve valve = toy_of(law);
    const std::string w = inside(feb_of(valve), "W");
    const Constants &c = valve.leaflets[0].constants;
    const LeafletLaw *known = find_leaflet_law(law);
    // at J = 1 the energy minus that at rest equals the energy of the law in kPa
    const auto febio = [&](double i1, double i4) {
      return Formula(w, {{"I1", i1}, {"I4", i4}, {"J", 1.0}}).value();
    };
    const auto ours = [&](double i1, double i4) { return known->response(c, i1, i4).w * 1e-3; };
    for (const auto &[i1, i4] : {std::pair(3.0, 1.0), {3.1, 1.2}, {3.2, 0.9}, {3.3, 1.3}}) {
      // accuracy of constants written with 15 decimals
      CHECK(febio(i1, i4) - febio(3, 1) == about(ours(i1, i4) - ours(3, 1), 1e-9));
    }
  }
}

TEST_CASE("feb_springs_are_the_chords_with_their_slack") {
  const Imported imported = read_inp(toy_inp());
  const ModelPtr model = make_model(imported.loaded.valve);
  const Valve &valve = model->valve;
  const std::string feb = write_feb(*model, imported.loaded.state);
  for (const Chord &chord : valve.chords) {
    CAPTURE(chord.name);
    const auto points = points_of(feb, chord.name);
    const double distance = (valve.rest[chord.b] - valve.rest[chord.a]).norm();
    for (const double strain : {-0.2, -0.01, 0.005, 0.02, 0.05}) {
      const double elongation = chord.rest_length * (1 + strain) - distance;
      const double tension = strain <= 0 ? 0 : chord_tension(valve, chord, strain) * 1e3;
      // chords of the curve between 64 points lie above it by under 1 % of a steep exponential
      const double close = chord.law == ChordLawId::linear ? 1e-9 : 2e-2;
      CHECK(std::abs(interpolated(points, elongation * 1e3) - tension) <=
            close * tension + 1e-9 * valve.chords[0].area * 1e12);
    }
  }
}

TEST_CASE("feb_a_leaflet_of_two_thicknesses_becomes_two_domains") {
  Valve valve = read_inp(toy_inp()).loaded.valve;
  for (size_t t = 0; t < valve.triangles.size(); ++t) {
    valve.triangle_thickness.push_back(t == 3 ? 1.2e-3 : 0.65e-3);
  }
  const std::string feb = feb_of(valve);
  CHECK(count_of(feb, "<ShellDomain ") == 4);
  CHECK(feb.find("<ShellDomain name=\"Anterior, 1.2 mm\" mat=\"Anterior, 1.2 mm\"") !=
        std::string::npos);
}

TEST_CASE("feb_names_are_escaped") {
  Valve valve = read_inp(toy_inp()).loaded.valve;
  valve.leaflets[0].name = "A<&\"1\">";
  CHECK(feb_of(valve).find("name=\"A&lt;&amp;&quot;1&quot;&gt;\"") != std::string::npos);
}

TEST_CASE("feb_export_refuses_leaflets_of_springs") {
  const Valve valve = toy_of(LeafletLawId::spring);
  const ModelPtr model = make_model(valve);
  try {
    write_feb(*model, initial_state(*model));
    FAIL("a net of springs was written");
  } catch (const Error &error) {
    CHECK(error.code == MVS_E_UNSUPPORTED);
    CHECK(std::string(error.what()).find("leaflet Anterior is a net of springs") == 0);
  }
}
