// *DISTRIBUTION and *ORIENTATION: the first local direction is the fibre direction.
#include <Eigen/Geometry>
#include <numbers>

#include "base/math.h"
#include "formats/abaqus/properties.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

Vec3 read_direction(InpRow &row) {
  Vec3 direction;
  for (double &c : direction) c = row.number("a component of a direction");
  return direction;
}

struct Distribution {
  std::array<Vec3, 2> otherwise;
  std::map<uint32_t, std::array<Vec3, 2>> of;
};

std::array<Vec3, 2> read_pair(InpRow &row) {
  const Vec3 x = read_direction(row), y = read_direction(row);
  if (!(x.cross(y).norm() > 1e-9 * x.norm() * y.norm())) {
    inp_fail(row.line(), "the two directions are parallel: they have to define a plane");
  }
  return {x, y};
}

Distribution read_distribution(InpCard &card, const InpMesh &mesh) {
  card.used = true;
  card.take("TABLE");
  if (inp_label(card.take("LOCATION").value_or("")) != "ELEMENT") {
    inp_fail(card.line, "*DISTRIBUTION is read with LOCATION=ELEMENT");
  }
  Distribution made{{Vec3::UnitX(), Vec3::UnitY()}, {}};
  for (size_t k = 0; k < card.data.size(); ++k) {
    InpRow row = card.row(k);
    const std::string_view where = row.word();
    const std::array<Vec3, 2> directions = read_pair(row);
    if (where.empty()) {
      made.otherwise = directions;
      continue;
    }
    for (const uint32_t element : mesh.named_elements(where, row.line())) {
      made.of[element] = directions;
    }
  }
  return made;
}

// Data lines: a distribution or the points a and b; an axis and an angle; directions of fibres.
InpOrientation read_orientation(InpCard &card, const std::map<std::string, Distribution> &known,
                                InpNotes &notes) {
  const std::string system = inp_label(card.take("SYSTEM").value_or("RECTANGULAR"));
  const std::string definition = inp_label(card.take("DEFINITION").value_or("COORDINATES"));
  if (system != "RECTANGULAR" || definition != "COORDINATES") {
    inp_fail(card.line, "*ORIENTATION is read as SYSTEM=RECTANGULAR by COORDINATES");
  }
  card.take("LOCAL DIRECTIONS");
  if (card.data.empty()) inp_fail(card.line, "*ORIENTATION has no data line");
  InpOrientation made;
  made.line = card.line;
  InpRow row = card.row(0);
  InpRow first = row;
  const auto distribution = known.find(inp_label(first.word()));
  if (distribution != known.end()) {
    made.otherwise = distribution->second.otherwise;
    made.of = distribution->second.of;
  } else {
    made.otherwise = read_pair(row);
  }
  if (card.data.size() > 1) {
    InpRow turn = card.row(1);
    if (turn.number("an axis", 0, 3.0) != 3) {
      inp_fail(turn.line(), "*ORIENTATION is read with axis 3, the normal of the shell");
    }
    made.angle = turn.number("an angle", 0, 0.0) * std::numbers::pi / 180;
  }
  if (card.data.size() > 2) {
    InpRow fibre = card.row(2);
    made.direction = read_direction(fibre);
    if (!(made.direction.norm() > 0)) inp_fail(fibre.line(), "the direction has no length");
  }
  for (size_t k = 3; k < card.data.size(); ++k) {
    notes.left_out(card.data[k].line,
                   "a second local direction of *ORIENTATION is left out: a "
                   "leaflet has one family of fibres");
  }
  return made;
}

}  // namespace

Vec3 InpOrientation::fibre(uint32_t element) const {
  const auto own = of.find(element);
  const std::array<Vec3, 2> &axes = own == of.end() ? otherwise : own->second;
  const Vec3 e1 = axes[0].normalized(), e3 = axes[0].cross(axes[1]).normalized();
  const Vec3 e2 = e3.cross(e1);
  const double c = math::cos(angle), s = math::sin(angle);
  const Vec3 f1 = c * e1 + s * e2, f2 = c * e2 - s * e1;
  return (direction[0] * f1 + direction[1] * f2 + direction[2] * e3).normalized();
}

void read_inp_orientations(std::vector<InpCard> &cards, const InpMesh &mesh, InpProperties &into,
                           InpNotes &notes) {
  std::map<std::string, Distribution> known;
  for (InpCard &card : cards) {
    // its columns are checked when they are read
    if (card.is("DISTRIBUTION TABLE")) {
      card.used = true;
      card.take("NAME");
    }
    if (card.is("DISTRIBUTION")) known[card.need("NAME")] = read_distribution(card, mesh);
  }
  for (InpCard &card : cards) {
    if (!card.is("ORIENTATION")) continue;
    card.used = true;
    const std::string name = card.need("NAME");
    into.orientations[name] = read_orientation(card, known, notes);
  }
}

}  // namespace mvs::core
