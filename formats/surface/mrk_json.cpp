// 3D Slicer's markups (.mrk.json): control points of point lists, curves, lines and planes with
// their labels. Points whose position is not defined are left out; orientations are not read.
#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/surface/parts.h"
#include "formats/text/json.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// Frame and unit of one markup: unknown where it does not state them.
struct MarkupSpace {
  PatientFrame frame = PatientFrame::unknown;
  LengthUnit unit = LengthUnit::unknown;
};

MarkupSpace markup_space(const Json &markup) {
  MarkupSpace space;
  const std::string &frame = markup["coordinateSystem"].text();
  space.frame = frame_of_word(frame);
  MVS_MUST(frame.empty() || space.frame != PatientFrame::unknown, MVS_E_FORMAT, "coordinateSystem",
           "coordinateSystem is %s: it has to be LPS or RAS", quoted(frame).c_str());
  // a text, or a code with its scheme and meaning
  const Json &given = markup["coordinateUnits"];
  const Json &code = given.is_array() && !given.items().empty() ? given.items()[0] : given;
  space.unit = unit_of_word(code.text());
  MVS_MUST(given.is_null() || space.unit != LengthUnit::unknown, MVS_E_FORMAT, "coordinateUnits",
           "coordinateUnits is %s: it has to be m, mm or cm", quoted(code.text()).c_str());
  return space;
}

void add_control_point(SurfaceParts &parts, const Json &point, size_t number) {
  const std::string &status = point["positionStatus"].text();
  if (!status.empty() && status != "defined") return;
  const Json &position = point["position"];
  const std::string part = format("control point %zu", number);
  MVS_MUST(position.is_array() && position.items().size() == 3, MVS_E_FORMAT, part,
           "control point %zu (the first is 0) has no position of three numbers", number);
  std::vector<double> coordinates;
  for (const Json &coordinate : position.items()) {
    MVS_MUST(coordinate.is_number(), MVS_E_FORMAT, part,
             "control point %zu (the first is 0) has a coordinate that is not a number", number);
    coordinates.push_back(coordinate.number());
  }
  add_points(parts, coordinates);
  parts.point_names.push_back(as_utf8(point["label"].text()));
}

}  // namespace

SurfaceParts read_mrk_json(std::string_view bytes) {
  const Json file = Json::parse(bytes);
  const Json &markups = file["markups"];
  MVS_MUST(markups.is_array() && !markups.items().empty(), MVS_E_FORMAT, "markups",
           "the file has no list `markups`: it is not a markups file of 3D Slicer");
  SurfaceParts parts;
  parts.format = "markups";
  const MarkupSpace first = markup_space(markups.items()[0]);
  parts.frame = first.frame;
  parts.unit = first.unit;
  size_t number = 0;
  for (const Json &markup : markups.items()) {
    const MarkupSpace space = markup_space(markup);
    MVS_MUST(space.frame == first.frame && space.unit == first.unit, MVS_E_UNSUPPORTED, "markups",
             "the markups of the file have different frames or units: save each in a file");
    const Json &points = markup["controlPoints"];
    MVS_MUST(points.is_array() || points.is_null(), MVS_E_FORMAT, "controlPoints",
             "controlPoints is not a list");
    for (const Json &point : points.items()) add_control_point(parts, point, number++);
  }
  return parts;
}

}  // namespace mvs::core
