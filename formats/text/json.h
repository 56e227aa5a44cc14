// JSON values, parsed and printed by nlohmann::json.
//
// nlohmann's own values are not used: their destructor allocates (to flatten nested values), so
// that a lack of memory during destruction would end the host's process. The destructor here does
// not allocate, and the nesting depth is limited.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mvs::core {

class Json {
 public:
  enum class Type : uint8_t { null, boolean, whole, number, text, array, object };
  using Member = std::pair<std::string, Json>;

  Json() = default;
  Json(double value) : type_(Type::number), number_(value) {}
  Json(uint64_t value) : type_(Type::whole), whole_(value) {}
  Json(uint32_t value) : Json(uint64_t{value}) {}
  Json(std::string value) : type_(Type::text), text_(std::move(value)) {}
  Json(const char *value) : Json(std::string(value)) {}
  explicit Json(bool value) : type_(Type::boolean), whole_(value) {}
  static Json array() { return Json(Type::array); }
  static Json object(std::initializer_list<Member> members = {});
  static Json numbers(std::initializer_list<double> values);

  // Throws MVS_E_FORMAT with the byte offset of the error. Of a key that is repeated in an object,
  // the first place and the last value count; with `unique`, it is refused.
  static Json parse(std::string_view text, bool unique = false);
  // Prints on one line, or indented by two blanks per level. Doubles have the shortest digits that
  // read back exactly; bytes that are not UTF-8 are replaced.
  std::string line() const;
  std::string page() const;

  bool is_null() const { return type_ == Type::null; }
  bool is_text() const { return type_ == Type::text; }
  bool is_array() const { return type_ == Type::array; }
  bool is_object() const { return type_ == Type::object; }
  bool is_whole() const { return type_ == Type::whole; }
  bool is_number() const { return type_ == Type::number || type_ == Type::whole; }

  // The value; zero or an empty text for another type.
  double number() const { return is_whole() ? static_cast<double>(whole_) : number_; }
  uint64_t whole() const { return whole_; }
  const std::string &text() const { return text_; }

  // The members of an object, in order; the items of an array.
  const std::vector<Member> &members() const { return members_; }
  const std::vector<Json> &items() const { return items_; }
  // Returns the member with this key, or null.
  const Json *find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  // The member with this key; a null value if it does not exist.
  const Json &operator[](std::string_view key) const;

  // Makes this an object with the member, or an array with one more item.
  void set(std::string_view key, Json value);
  void add(Json value);

 private:
  friend class JsonBuilder;
  explicit Json(Type type) : type_(type) {}
  // While an object is parsed: the member at its end, though its key may be there already.
  void append(std::string key, Json value) {
    members_.emplace_back(std::move(key), std::move(value));
  }
  // Keeps the first place and the last value of each key; returns one that was repeated.
  std::optional<std::string> drop_repeated();
  void write(std::string &out, int indent) const;

  Type type_ = Type::null;
  double number_ = 0;
  uint64_t whole_ = 0;
  std::string text_;
  std::vector<Json> items_;
  std::vector<Member> members_;
};

}  // namespace mvs::core
