// JSON parser (nlohmann SAX events to values) and writer.
#include "formats/text/json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "base/error.h"

namespace mvs::core {

using Library = nlohmann::json;

// Builds a value from the events of the parser.
class JsonBuilder : public nlohmann::json_sax<Library> {
 public:
  explicit JsonBuilder(bool unique) : unique_(unique) {}
  bool null() override { return put(Json()); }
  bool boolean(bool value) override { return put(Json(value)); }
  bool number_integer(number_integer_t value) override {
    return put(Json(static_cast<double>(value)));
  }
  bool number_unsigned(number_unsigned_t value) override { return put(Json(uint64_t{value})); }
  bool number_float(number_float_t value, const string_t &) override { return put(Json(value)); }
  bool string(string_t &value) override { return put(Json(std::move(value))); }
  bool binary(binary_t &) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool key(string_t &value) override {
    open_.back().second = std::move(value);
    return true;
  }
  bool end_object() override { return close(); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t position, const std::string &,
                   const nlohmann::detail::exception &) override {
    at = position;
    return false;
  }

  static constexpr size_t deepest = 64;
  Json result;
  size_t at = 0;
  bool too_deep = false;
  std::optional<std::string> repeated;  // a key, where they have to be unique

 private:
  bool unique_;
  // Open values, each with the key of its next member.
  std::vector<std::pair<Json, std::string>> open_;

  bool open(Json value) {
    too_deep = open_.size() >= deepest;
    if (too_deep) return false;
    open_.emplace_back(std::move(value), std::string());
    return true;
  }
  bool close() {
    Json done = std::move(open_.back().first);
    open_.pop_back();
    std::optional<std::string> found = done.drop_repeated();
    if (unique_ && found) {
      repeated = std::move(found);
      return false;
    }
    return put(std::move(done));
  }
  bool put(Json value) {
    if (open_.empty()) {
      result = std::move(value);
    } else if (open_.back().first.is_array()) {
      open_.back().first.add(std::move(value));
    } else {
      open_.back().first.append(std::move(open_.back().second), std::move(value));
    }
    return true;
  }
};

namespace {

void new_line(std::string &out, int indent) {
  if (indent < 0) return;
  out += '\n';
  out.append(2 * static_cast<size_t>(indent), ' ');
}

std::string quoted_text(const std::string &text) {
  return Library(text).dump(-1, ' ', false, Library::error_handler_t::replace);
}

}  // namespace

Json Json::object(std::initializer_list<Member> members) {
  Json json(Type::object);
  json.members_ = members;
  return json;
}

Json Json::numbers(std::initializer_list<double> values) {
  Json json(Type::array);
  for (const double value : values) json.add(value);
  return json;
}

Json Json::parse(std::string_view text, bool unique) {
  JsonBuilder builder(unique);
  const bool good = Library::sax_parse(text.begin(), text.end(), &builder);
  MVS_MUST(!builder.too_deep, MVS_E_FORMAT, "json", "the JSON is nested deeper than %zu levels",
           JsonBuilder::deepest);
  MVS_MUST(!builder.repeated, MVS_E_FORMAT, "json", "an object of the JSON has \"%.60s\" twice",
           builder.repeated->c_str());
  MVS_MUST(good, MVS_E_FORMAT, "json",
           "the text is not JSON: error at byte %zu; it may be cut short", builder.at);
  return std::move(builder.result);
}

std::string Json::line() const {
  std::string out;
  write(out, -1000);
  return out;
}

std::string Json::page() const {
  std::string out;
  write(out, 0);
  return out;
}

const Json *Json::find(std::string_view key) const {
  for (const Member &member : members_) {
    if (member.first == key) return &member.second;
  }
  return nullptr;
}

const Json &Json::operator[](std::string_view key) const {
  static const Json nothing;
  const Json *found = find(key);
  return found ? *found : nothing;
}

std::optional<std::string> Json::drop_repeated() {
  if (members_.size() < 2) return {};
  std::vector<size_t> order(members_.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    const int order_of_keys = members_[a].first.compare(members_[b].first);
    return order_of_keys != 0 ? order_of_keys < 0 : a < b;
  });
  std::vector<uint8_t> repeated(members_.size(), 0);
  std::optional<std::string> found;
  for (size_t k = order.size(); k-- > 1;) {
    if (members_[order[k - 1]].first != members_[order[k]].first) continue;
    members_[order[k - 1]].second = std::move(members_[order[k]].second);
    repeated[order[k]] = 1;
    found = members_[order[k - 1]].first;
  }
  size_t kept = 0;
  for (size_t k = 0; k < members_.size(); ++k) {
    if (repeated[k]) continue;
    if (kept != k) members_[kept] = std::move(members_[k]);
    ++kept;
  }
  members_.resize(kept);
  return found;
}

void Json::set(std::string_view key, Json value) {
  type_ = Type::object;
  for (Member &member : members_) {
    if (member.first != key) continue;
    member.second = std::move(value);
    return;
  }
  members_.emplace_back(std::string(key), std::move(value));
}

void Json::add(Json value) {
  type_ = Type::array;
  items_.push_back(std::move(value));
}

void Json::write(std::string &out, int indent) const {
  switch (type_) {
    case Type::null:
      out += "null";
      return;
    case Type::boolean:
      out += whole_ ? "true" : "false";
      return;
    case Type::whole:
      out += std::to_string(whole_);
      return;
    case Type::number:
      out += Library(number_).dump();
      return;
    case Type::text:
      out += quoted_text(text_);
      return;
    default:
      break;
  }
  const bool is_list = is_array();
  // a list of at most three values stays on one line
  const bool flat = is_list && items_.size() <= 3;
  const size_t count = is_list ? items_.size() : members_.size();
  out += is_list ? '[' : '{';
  for (size_t k = 0; k < count; ++k) {
    if (k > 0) out += indent < 0 ? "," : (flat ? ", " : ",");
    if (!flat) new_line(out, indent + 1);
    if (!is_list) out += quoted_text(members_[k].first) + (indent < 0 ? ":" : ": ");
    (is_list ? items_[k] : members_[k].second).write(out, flat ? -1000 : indent + 1);
  }
  if (!flat && count > 0) new_line(out, indent);
  out += is_list ? ']' : '}';
}

}  // namespace mvs::core
