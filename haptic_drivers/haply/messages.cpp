// Parsing and building of messages with nlohmann::json.
#include "messages.h"

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

namespace haply {
namespace {

using nlohmann::json;

// Buttons in the order of their bits. Wireless grips have a b c; later ones more, or four
// directions.
constexpr const char *kButtons[] = {"a", "b", "c", "d", "e", "f", "up", "down", "left", "right"};

// A grip may be in two lists; the first list has a b c (README of the crate haply).
constexpr const char *kGripLists[] = {"custom_verse_grip", "wireless_verse_grip", "verse_grip"};

int32_t nonsense(Fault &fault, const char *what) {
  return fault.set(MVS_DRIVER_E_FAULT,
                   "the Haply Inverse Service sent %s: is its version 3.1 or later? (mvs haptics "
                   "doctor)",
                   what);
}

// Returns the value of `key` in an object, or null.
const json &at(const json &object, const char *key) {
  static const json nothing;
  const auto found = object.find(key);  // end() if not an object
  return found == object.end() ? nothing : *found;
}

std::string text_at(const json &object, const char *key) {
  const json &value = at(object, key);
  return value.is_string() ? value.get<std::string>() : std::string();
}

bool flag_at(const json &object, const char *key, bool otherwise) {
  const json &value = at(object, key);
  return value.is_boolean() ? value.get<bool>() : otherwise;
}

// Reads finite numbers; returns false if `object` lacks one of them.
template <size_t count>
bool numbers_at(const json &object, const char *const (&keys)[count], double *out) {
  double found[count];
  for (size_t i = 0; i < count; ++i) {
    const json &value = at(object, keys[i]);
    if (!value.is_number()) return false;
    found[i] = value.get<double>();
    if (!std::isfinite(found[i])) return false;
  }
  std::copy_n(found, count, out);
  return true;
}

constexpr const char *kXyz[] = {"x", "y", "z"};
constexpr const char *kWxyz[] = {"w", "x", "y", "z"};

int32_t parse(const std::string &frame, json &out, Fault &fault) {
  out = json::parse(frame, nullptr, false);
  if (out.is_discarded()) return nonsense(fault, "what is not JSON");
  if (!out.is_object()) return nonsense(fault, "JSON that is not an object");
  return MVS_DRIVER_OK;
}

// Returns the entry of a list with this id, or null.
const json &entry(const json &frame, const std::string &list, const std::string &id) {
  static const json nothing;
  const json &entries = at(frame, list.c_str());
  if (!entries.is_array()) return nothing;
  for (const json &one : entries)
    if (text_at(one, "device_id") == id) return one;
  return nothing;
}

unsigned button_count(const json &state) {
  const json &buttons = at(state, "buttons");
  unsigned count = at(state, "button").is_boolean() ? 1 : 0;
  for (unsigned i = 0; i < std::size(kButtons); ++i)
    if (at(buttons, kButtons[i]).is_boolean()) count = i + 1;
  return count;
}

uint32_t button_mask(const json &state) {
  const json &buttons = at(state, "buttons");
  uint32_t mask = flag_at(state, "button", false) ? 1 : 0;  // of a grip on a cable
  for (unsigned i = 0; i < std::size(kButtons); ++i)
    if (flag_at(buttons, kButtons[i], false)) mask |= 1u << i;
  return mask;
}

Inverse read_inverse(const json &one) {
  const json &config = at(one, "config"), &status = at(one, "status");
  const json &basis = at(config, config.contains("basis") ? "basis" : "coordinate_system");
  Inverse inverse;
  inverse.id = text_at(one, "device_id");
  inverse.type = text_at(config, "type");
  inverse.serial = text_at(config, "extended_device_id");
  inverse.firmware = text_at(config, "extended_firmware_version");
  inverse.basis = text_at(basis, "permutation");
  inverse.calibrated = flag_at(status, "calibrated", true);
  inverse.powered = flag_at(status, "power_supply", true);
  inverse.in_use = flag_at(status, "in_use", false);
  return inverse;
}

// A disconnected or sleeping grip has no buttons pressed, so that no tool stays grasped.
void read_grip(const json &one, Hand &hand) {
  const json &state = at(one, "state");
  hand.buttons = flag_at(at(one, "status"), "connected", true) ? button_mask(state) : 0;
  double q[4];
  if (!numbers_at(at(state, "orientation"), kWxyz, q)) return;
  const double norm = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
  if (!(norm > 0.5 && norm < 2)) return;  // no orientation yet
  for (int i = 0; i < 4; ++i) hand.orientation[i] = q[i] / norm;
}

}  // namespace

bool parse_version(const std::string &text, Version &version) {
  const char *begin = text.c_str(), *end = begin + text.size();
  if (*begin == 'v') ++begin;
  const auto major = std::from_chars(begin, end, version.major);
  if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.') return false;
  return std::from_chars(major.ptr + 1, end, version.minor).ec == std::errc();
}

int32_t read_version(const std::string &answer, Version &version, Fault &fault) {
  json message;
  const int32_t result = parse(answer, message, fault);
  if (result != MVS_DRIVER_OK) return result;
  const json &inner = at(message, "data").is_object() ? at(message, "data") : message;
  if (parse_version(text_at(inner, "project_version"), version) ||
      parse_version(text_at(inner, "git_tag"), version))
    return MVS_DRIVER_OK;
  return nonsense(fault, "no readable version (set it by the option version)");
}

int32_t read_inventory(const std::string &frame, Inventory &inventory, Fault &fault) {
  json message;
  const int32_t result = parse(frame, message, fault);
  if (result != MVS_DRIVER_OK) return result;
  const json &inverses = at(message, "inverse3");
  if (!inverses.is_null() && !inverses.is_array())
    return nonsense(fault, "a frame whose inverse3 is not a list");
  for (const json &one : inverses)
    if (!text_at(one, "device_id").empty()) inventory.inverses.push_back(read_inverse(one));
  for (const char *list : kGripLists) {
    const json &grips = at(message, list);
    if (!grips.is_array()) continue;
    for (const json &one : grips) {
      const std::string id = text_at(one, "device_id");
      const bool connected = flag_at(at(one, "status"), "connected", true);
      if (!id.empty())
        inventory.grips.push_back({list, id, connected, button_count(at(one, "state"))});
    }
  }
  return MVS_DRIVER_OK;
}

int32_t read_state(const std::string &frame, const std::string &device, const Grip &grip,
                   Hand &hand, Fault &fault) {
  json message;
  const int32_t result = parse(frame, message, fault);
  if (result != MVS_DRIVER_OK) return result;
  const json &one = entry(message, "inverse3", device);
  if (one.is_null()) return 0;
  const json &state = at(one, "state"), &status = at(one, "status");
  if (!numbers_at(at(state, "cursor_position"), kXyz, hand.position))
    return nonsense(fault, "a state without a cursor_position of three numbers");
  const json &velocity = at(state, "cursor_velocity");
  hand.has_velocity = numbers_at(velocity, kXyz, hand.velocity);
  if (!velocity.is_null() && !hand.has_velocity)
    return nonsense(fault, "a cursor_velocity that is not three numbers");
  hand.calibrated = flag_at(status, "calibrated", hand.calibrated);
  hand.powered = flag_at(status, "power_supply", hand.powered);
  if (!grip.id.empty()) read_grip(entry(message, grip.kind, grip.id), hand);
  return 1;
}

// "values" until 3.4, "vector" and "execute" since 3.5 (README of the crate haply 1.0).
Commands::Commands(const Version &version, const std::string &device)
    : version_(version), device_(json(device).dump()) {
  const char *field = version.at_least(3, 5) ? "vector" : "values";
  text_ = R"({"inverse3":[{"device_id":)" + device_ + R"(,"commands":{"set_cursor_force":{")" +
          field + "\":{";
  numbers_ = text_.size();
  text_.reserve(numbers_ + 128);
}

std::string Commands::hello(const std::string &preset) const {
  const json zero = {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}};
  json device = {{"device_id", json::parse(device_)}};
  json message = json::object();
  if (version_.at_least(3, 5)) {
    message["session"]["configure"]["profile"]["name"] = "libmvs";
    device["commands"]["set_cursor_force"] = {{"vector", zero}, {"execute", true}};
    if (!preset.empty()) device["configure"]["preset"]["preset"] = preset;
  } else {
    device["commands"]["set_cursor_force"]["values"] = zero;
  }
  message["inverse3"] = json::array({device});
  return message.dump();
}

const std::string &Commands::force(const double newton[3]) {
  text_.resize(numbers_);
  for (int i = 0; i < 3; ++i) {
    char number[32];
    // not printf, which may write a decimal comma; six digits are enough for a force
    const auto end =
        std::to_chars(number, number + sizeof number, newton[i], std::chars_format::general, 6);
    text_ += i ? ",\"" : "\"";
    text_ += kXyz[i];
    text_ += "\":";
    text_.append(number, end.ptr);
  }
  text_ += version_.at_least(3, 5) ? R"(},"execute":true}}}]})" : "}}}}]}";
  return text_;
}

}  // namespace haply
