// Tool events of plans: JSON writer and strict reader.
#include "formats/plan/tool.h"

#include <Eigen/Geometry>
#include <cmath>

#include "base/bit_cast.h"
#include "base/error.h"
#include "formats/plan/grasp.h"
#include "formats/text/base64.h"
#include "history/tool_trajectory.h"

namespace mvs::core {
namespace {

constexpr const char *kinds[] = {"grasp", "ball", "rod", "convex"};
constexpr const char *body_kinds[] = {"hull", "ball", "capsule", "box", "cylinder", "cone"};

const char *word_of(ToolKind kind) {
  return kinds[static_cast<uint32_t>(kind) - 1];
}

Json vector_json(const Vec3 &v) {
  return Json::numbers({v.x(), v.y(), v.z()});
}

double positive_at(const Json &json, const char *key) {
  const double value = json[key].number();
  MVS_MUST(value > 0 && std::isfinite(value), MVS_E_FORMAT, "plan", "%s has to be a number above 0",
           key);
  return value;
}

uint64_t whole_at(const Json &json, const char *key) {
  MVS_MUST(json[key].is_whole(), MVS_E_FORMAT, "plan", "%s has to be a whole number", key);
  return json[key].whole();
}

Vec3 vector_at(const Json &json, const char *key) {
  const std::vector<Json> &items = json[key].items();
  Vec3 v = Vec3::Constant(NAN);
  if (items.size() == 3) v = {items[0].number(), items[1].number(), items[2].number()};
  MVS_MUST(v.allFinite(), MVS_E_FORMAT, "plan", "%s has to be three numbers", key);
  return v;
}

ToolKind kind_at(const Json &json) {
  for (uint32_t k = 0; k < std::size(kinds); ++k) {
    if (json["kind"].text() == kinds[k]) return static_cast<ToolKind>(k + 1);
  }
  fail(MVS_E_FORMAT, "plan", "kind has to be grasp, ball, rod or convex");
}

// Numbers as base64 of their little-endian bytes: exact, in a third of the length of decimals.
template <typename Word>
std::string packed(const std::vector<Word> &words) {
  std::string bytes, text;
  for (const Word word : words) {
    for (size_t k = 0; k < sizeof word; ++k) bytes += static_cast<char>(word >> 8 * k & 255);
  }
  append_base64(text, bytes);
  return text;
}

template <typename Word>
std::vector<Word> unpacked(const Json &json, const char *key) {
  const std::string bytes = base64_bytes(json[key].text(), key);
  std::vector<Word> words(bytes.size() / sizeof(Word));
  for (size_t k = 0; k < words.size() * sizeof(Word); ++k) {
    const Word byte = static_cast<unsigned char>(bytes[k]);
    words[k / sizeof(Word)] |= byte << 8 * (k % sizeof(Word));
  }
  return words;
}

std::vector<Tool> read_trajectory_tools(const Json &json) {
  std::vector<Tool> tools;
  for (const Json &item : json["tools"].items()) {
    Tool tool;
    tool.id = whole_at(item, "tool");
    tool.kind = kind_at(item);
    tools.push_back(tool);
  }
  return tools;
}

std::vector<Vec3> read_points(const Json &json, const char *key) {
  const std::vector<uint64_t> words = unpacked<uint64_t>(json, key);
  std::vector<Vec3> points(words.size() / 3);
  for (size_t k = 0; k < 3 * points.size(); ++k) {
    points[k / 3][k % 3] = bit_cast<double>(words[k]);
  }
  return points;
}

std::string packed_points(const std::vector<Vec3> &points) {
  std::vector<uint64_t> words;
  for (const Vec3 &point : points) {
    for (int k = 0; k < 3; ++k) words.push_back(bit_cast<uint64_t>(point[k]));
  }
  return packed(words);
}

Json bodies_json(const ToolShape &shape) {
  Json bodies = Json::array();
  for (const ToolBody &body : shape.bodies()) {
    bodies.add(Json::object({{"kind", body_kinds[static_cast<uint32_t>(body.kind) - 1]},
                             {"radius_m", body.radius},
                             {"vertices_m", packed_points(body.vertices)}}));
  }
  return bodies;
}

ToolBody read_body(const Json &json) {
  ToolBody body;
  body.kind = BodyKind{0};
  for (uint32_t k = 0; k < std::size(body_kinds); ++k) {
    if (json["kind"].text() == body_kinds[k]) body.kind = static_cast<BodyKind>(k + 1);
  }
  body.radius = json["radius_m"].number();
  body.vertices = read_points(json, "vertices_m");
  return body;
}

ToolShapePtr read_shape(const Json &json) {
  std::vector<ToolBody> bodies;
  for (const Json &item : json["bodies"].items()) bodies.push_back(read_body(item));
  MVS_MUST(are_valid(bodies), MVS_E_FORMAT, "plan",
           "bodies has to be 1 to %u bodies with kind, radius_m and vertices_m, within %g m and of "
           "at most %u vertices",
           most_tool_bodies, most_body_extent, most_tool_vertices);
  return ToolShapePtr(std::make_shared<const ToolShape>(std::move(bodies)));
}

// Keeps a recorded unit axis bit for bit and normalises any other axis.
void read_hand(const Json &json, Tool &tool) {
  tool.position = vector_at(json, "position_m");
  if (json.has("rodrigues")) {
    tool.axis = vector_at(json, "rodrigues");
    MVS_MUST(
        tool.axis.norm() <= 1 + 1e-9, MVS_E_FORMAT, "plan",
        "rodrigues is longer than 1: it has to be q_v / (1 + q_w) of a quaternion of length 1");
  }
  if (!json.has("axis")) return;
  tool.axis = vector_at(json, "axis");
  const double length = tool.axis.norm();
  MVS_MUST(length > 0, MVS_E_FORMAT, "plan", "axis has no length");
  if (std::abs(length - 1) > 1e-12) tool.axis /= length;
}

void read_added(const Json &json, Tool &tool) {
  check_keys(json, {"tool", "kind", "position_m", "axis", "radius_m", "length_m", "stiffness_N/m",
                    "max_force_N", "node", "place", "rodrigues", "bodies"});
  tool.kind = kind_at(json);
  read_hand(json, tool);
  tool.stiffness = positive_at(json, "stiffness_N/m");
  tool.max_force = positive_at(json, "max_force_N");
  if (tool.kind == ToolKind::grasp) {
    tool.node = static_cast<uint32_t>(std::min<uint64_t>(whole_at(json, "node"), none - 1));
    if (json.has("place")) check_place(json["place"]);
    return;
  }
  MVS_MUST(!json.has("place"), MVS_E_FORMAT, "plan", "only a grasp has a place");
  if (tool.kind == ToolKind::convex) {
    tool.shape = read_shape(json);
    tool.length = tool.shape->arm();
    return;
  }
  tool.radius = positive_at(json, "radius_m");
  if (tool.kind != ToolKind::rod) return;
  tool.length = positive_at(json, "length_m");
  MVS_MUST(json.has("axis"), MVS_E_FORMAT, "plan", "a rod has to have an axis");
}

}  // namespace

void check_keys(const Json &json, std::initializer_list<std::string_view> known) {
  for (const auto &[key, value] : json.members()) {
    const bool is_known = key == "do" || std::find(known.begin(), known.end(), key) != known.end();
    MVS_MUST(is_known, MVS_E_FORMAT, "plan", "%s has no field \"%.60s\"", json["do"].text().c_str(),
             key.c_str());
  }
}

Json tool_json(const RecordedEvent &event, const Model *model) {
  const Tool &tool = event.tools[0];
  Json json;
  json.set("do", event.kind == RecordedEvent::tool_add    ? "tool_add"
                 : event.kind == RecordedEvent::tool_move ? "tool_move"
                                                          : "tool_remove");
  json.set("tool", tool.id);
  if (event.kind == RecordedEvent::tool_remove) return json;
  if (event.kind == RecordedEvent::tool_add) json.set("kind", word_of(tool.kind));
  json.set("position_m", vector_json(tool.position));
  if (tool.kind == ToolKind::rod) json.set("axis", vector_json(tool.axis));
  if (tool.kind == ToolKind::convex) json.set("rodrigues", vector_json(tool.axis));
  if (event.kind == RecordedEvent::tool_move) return json;
  if (tool.kind == ToolKind::grasp) {
    json.set("node", tool.node);
    Json place = model ? place_json(*model, tool.node) : Json();
    if (!place.is_null()) json.set("place", std::move(place));
  }
  if (tool.kind == ToolKind::ball || tool.kind == ToolKind::rod) {
    json.set("radius_m", tool.radius);
  }
  if (tool.kind == ToolKind::convex) json.set("bodies", bodies_json(*tool.shape));
  if (tool.kind == ToolKind::rod) json.set("length_m", tool.length);
  json.set("stiffness_N/m", tool.stiffness);
  json.set("max_force_N", tool.max_force);
  return json;
}

Json trajectory_json(const RecordedEvent &event) {
  Json json, tools = Json::array();
  for (const Tool &tool : event.tools.get()) {
    tools.add(Json::object({{"tool", tool.id}, {"kind", word_of(tool.kind)}}));
  }
  json.set("do", "tool_trajectory");
  json.set("count", event.count);
  json.set("tools", std::move(tools));
  json.set("points_m", packed_points(event.points));
  if (event.count != event.steps_per_row.size()) {
    json.set("steps_per_row", packed(event.steps_per_row.get()));
  }
  return json;
}

RecordedEvent read_trajectory(const Json &json) {
  RecordedEvent event;
  event.kind = RecordedEvent::tool_trajectory;
  event.tools = read_trajectory_tools(json);
  event.points = read_points(json, "points_m");
  const size_t rows = event.points.size() / std::max<size_t>(1, points_per_row(event));
  event.steps_per_row = std::vector<uint32_t>(rows, 1);
  if (json.has("steps_per_row")) {
    event.steps_per_row = unpacked<uint32_t>(json, "steps_per_row");
  }
  event.count = whole_at(json, "count");
  MVS_MUST(is_consistent(event), MVS_E_FORMAT, "plan",
           "tool_trajectory has to have tools, points_m with the same number of finite points in "
           "each row, and steps_per_row of at least 1 whose sum is count");
  return event;
}

std::optional<RecordedEvent> read_tool_step(const Json &json) {
  const std::string &word = json["do"].text();
  RecordedEvent event;
  Tool tool;
  if (word == "tool_add") {
    event.kind = RecordedEvent::tool_add;
    read_added(json, tool);
  } else if (word == "tool_move") {
    event.kind = RecordedEvent::tool_move;
    check_keys(json, {"tool", "position_m", "axis", "rodrigues"});
    read_hand(json, tool);
  } else if (word == "tool_remove") {
    event.kind = RecordedEvent::tool_remove;
    check_keys(json, {"tool"});
  } else {
    return {};
  }
  tool.id = whole_at(json, "tool");
  event.tools = {tool};
  return event;
}

}  // namespace mvs::core
