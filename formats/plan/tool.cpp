// Tools in plans: added, moved, removed.
#include "formats/plan/tool.h"

#include <mvs/tool.h>

#include <Eigen/Geometry>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "formats/text/base64.h"
#include "history/tool_trajectory.h"

namespace mvs::core {
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

// Numbers as their bytes, little-endian: they come back to the bit, in a third of the digits.
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

std::vector<Tool> read_hands(const Json &json) {
  std::vector<Tool> tools;
  for (const Json &hand : json["hands"].items()) {
    Tool tool;
    tool.id = whole_at(hand, "tool");
    tool.kind = kind_at(hand);
    tools.push_back(tool);
  }
  return tools;
}

std::vector<Vec3> read_way(const Json &json) {
  const std::vector<uint64_t> words = unpacked<uint64_t>(json, "way_m");
  std::vector<Vec3> way(words.size() / 3);
  for (size_t k = 0; k < 3 * way.size(); ++k) way[k / 3][k % 3] = std::bit_cast<double>(words[k]);
  return way;
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
  if (tool.kind == MVS_TOOL_KIND_GRASP) {
    tool.node = static_cast<uint32_t>(std::min<uint64_t>(whole_at(json, "node"), none - 1));
    return;
  }
  tool.radius = positive_at(json, "radius_m");
  if (tool.kind != MVS_TOOL_KIND_ROD) return;
  tool.length = positive_at(json, "length_m");
  MVS_MUST(json.has("axis"), MVS_E_FORMAT, "plan", "a rod has to have an axis");
}

}  // namespace

Json tool_json(const RecordedEvent &move) {
  const Tool &tool = move.tool[0];
  Json json;
  json.set("do", move.kind == RecordedEvent::tool_add    ? "tool_add"
                 : move.kind == RecordedEvent::tool_move ? "tool_move"
                                                         : "tool_remove");
  json.set("tool", tool.id);
  if (move.kind == RecordedEvent::tool_remove) return json;
  if (move.kind == RecordedEvent::tool_add) json.set("kind", kinds[tool.kind - 1]);
  json.set("position_m", vector_json(tool.position));
  if (tool.kind == MVS_TOOL_KIND_ROD) json.set("axis", vector_json(tool.axis));
  if (move.kind == RecordedEvent::tool_move) return json;
  if (tool.kind == MVS_TOOL_KIND_GRASP) json.set("node", tool.node);
  if (tool.kind != MVS_TOOL_KIND_GRASP) json.set("radius_m", tool.radius);
  if (tool.kind == MVS_TOOL_KIND_ROD) json.set("length_m", tool.length);
  json.set("stiffness_N/m", tool.stiffness);
  json.set("max_force_N", tool.max_force);
  return json;
}

Json lead_json(const RecordedEvent &move) {
  Json json, hands = Json::array();
  for (const Tool &tool : move.tool.get()) {
    hands.add(Json::object({{"tool", tool.id}, {"kind", kinds[tool.kind - 1]}}));
  }
  std::vector<uint64_t> way;
  for (const Vec3 &place : move.way.get()) {
    for (int k = 0; k < 3; ++k) way.push_back(std::bit_cast<uint64_t>(place[k]));
  }
  json.set("do", "lead");
  json.set("count", move.count);
  json.set("hands", std::move(hands));
  json.set("way_m", packed(way));
  if (move.count != move.pace.size()) json.set("pace", packed(move.pace.get()));
  return json;
}

RecordedEvent read_lead(const Json &json) {
  RecordedEvent move;
  move.kind = RecordedEvent::lead;
  move.tool = read_hands(json);
  move.way = read_way(json);
  const size_t rows = move.way.size() / std::max<size_t>(1, places_in_row(move));
  move.pace = std::vector<uint32_t>(rows, 1);
  if (json.has("pace")) move.pace = unpacked<uint32_t>(json, "pace");
  move.count = whole_at(json, "count");
  MVS_MUST(is_whole(move), MVS_E_FORMAT, "plan",
           "lead has to have hands, a way with a row of numbers for each place of theirs, and a "
           "pace of at least 1 for each row, which make its count");
  return move;
}

std::optional<RecordedEvent> read_tool_step(const Json &json) {
  const std::string &word = json["do"].text();
  RecordedEvent move;
  Tool tool;
  if (word == "tool_add") {
    move.kind = RecordedEvent::tool_add;
    read_added(json, tool);
  } else if (word == "tool_move") {
    move.kind = RecordedEvent::tool_move;
    check_keys(json, {"tool", "position_m", "axis"});
    read_hand(json, tool);
  } else if (word == "tool_remove") {
    move.kind = RecordedEvent::tool_remove;
    check_keys(json, {"tool"});
  } else {
    return {};
  }
  tool.id = whole_at(json, "tool");
  move.tool = {tool};
  return move;
}

}  // namespace mvs::core
