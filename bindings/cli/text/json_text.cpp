#include "text/json_text.h"

#include <algorithm>

namespace cli {
namespace {

constexpr int deepest = 64;  // of the library, formats/text/json.cpp

struct TooDeep {};

}  // namespace

// Values of nlohmann::json are copied and destroyed by recursion: the stack bounds their depth.
Json parse_json(const std::string &bytes, std::string &fault) {
  const auto keep = [](int depth, Json::parse_event_t event, const Json &) {
    const bool opens =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    if (opens && depth >= deepest) throw TooDeep();
    return true;
  };
  fault.clear();
  try {
    return Json::parse(bytes, keep);
  } catch (const TooDeep &) {
    fault = text("the JSON is nested deeper than %d levels", deepest);
  } catch (const Json::parse_error &error) {
    const size_t end = std::min(error.byte, bytes.size());
    const auto lines = std::count(bytes.begin(), bytes.begin() + static_cast<ptrdiff_t>(end), '\n');
    fault = text("line %td is not JSON", lines + 1);
  } catch (const Json::out_of_range &) {
    fault = "a number is too large for double precision, at most 1.8e308";
  }
  return {};
}

}  // namespace cli
