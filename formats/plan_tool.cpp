// Tools in plans: added, moved, removed.
#include "formats/plan_tool.h"

#include <mvs/tool.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/error.h"

namespace mvs {
namespace {

constexpr const char *kinds[] = {"grasp", "ball", "rod"};

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

uint32_t kind_at(const Json &json) {
  for (uint32_t k = 0; k < std::size(kinds); ++k) {
    if (json["kind"].text() == kinds[k]) return k + 1;
  }
  fail(MVS_E_FORMAT, "plan", "kind has to be grasp, ball or rod");
}

// Each step has all of its keys and no others.
void check_keys(const Json &json, std::initializer_list<std::string_view> known) {
  for (const auto &[key, value] : json.members()) {
    const bool is_known = key == "do" || std::find(known.begin(), known.end(), key) != known.end();
    MVS_MUST(is_known, MVS_E_FORMAT, "plan", "%s has no field \"%.60s\"", json["do"].text().c_str(),
             key.c_str());
  }
}

// A rod's axis comes back as it was to the last bit; what is written by hand is made a unit vector.
void read_hand(const Json &json, Tool &tool) {
  tool.position = vector_at(json, "position_m");
  if (!json.has("axis")) return;
  tool.axis = vector_at(json, "axis");
  const double length = tool.axis.norm();
  MVS_MUST(length > 0, MVS_E_FORMAT, "plan", "axis has no length");
  if (std::abs(length - 1) > 1e-12) tool.axis /= length;
}

void read_added(const Json &json, Tool &tool) {
  check_keys(json, {"tool", "kind", "position_m", "axis", "radius_m", "length_m", "stiffness_N/m",
                    "max_force_N", "node"});
  tool.kind = kind_at(json);
  read_hand(json, tool);
  tool.stiffness = positive_at(json, "stiffness_N/m");
  tool.max_force = positive_at(json, "max_force_N");
  if (tool.kind == MVS_TOOL_GRASP) {
    tool.node = static_cast<uint32_t>(std::min<uint64_t>(whole_at(json, "node"), none - 1));
    return;
  }
  tool.radius = positive_at(json, "radius_m");
  if (tool.kind != MVS_TOOL_ROD) return;
  tool.length = positive_at(json, "length_m");
  MVS_MUST(json.has("axis"), MVS_E_FORMAT, "plan", "a rod has to have an axis");
}

}  // namespace

Json tool_json(const Move &move) {
  const Tool &tool = move.tool[0];
  Json json;
  json.set("do", move.kind == Move::tool_add    ? "tool_add"
                 : move.kind == Move::tool_move ? "tool_move"
                                                : "tool_remove");
  json.set("tool", tool.id);
  if (move.kind == Move::tool_remove) return json;
  if (move.kind == Move::tool_add) json.set("kind", kinds[tool.kind - 1]);
  json.set("position_m", vector_json(tool.position));
  if (tool.kind == MVS_TOOL_ROD) json.set("axis", vector_json(tool.axis));
  if (move.kind == Move::tool_move) return json;
  if (tool.kind == MVS_TOOL_GRASP) json.set("node", tool.node);
  if (tool.kind != MVS_TOOL_GRASP) json.set("radius_m", tool.radius);
  if (tool.kind == MVS_TOOL_ROD) json.set("length_m", tool.length);
  json.set("stiffness_N/m", tool.stiffness);
  json.set("max_force_N", tool.max_force);
  return json;
}

std::optional<Move> read_tool_step(const Json &json) {
  const std::string &word = json["do"].text();
  Move move;
  Tool tool;
  if (word == "tool_add") {
    move.kind = Move::tool_add;
    read_added(json, tool);
  } else if (word == "tool_move") {
    move.kind = Move::tool_move;
    check_keys(json, {"tool", "position_m", "axis"});
    read_hand(json, tool);
  } else if (word == "tool_remove") {
    move.kind = Move::tool_remove;
    check_keys(json, {"tool"});
  } else {
    return {};
  }
  tool.id = whole_at(json, "tool");
  move.tool = {tool};
  return move;
}

}  // namespace mvs
