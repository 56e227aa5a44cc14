// Lines of extended OBJ: statements, `#mvs` records, and keys with values.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/types.h"
#include "formats/obj/words.h"
#include "model/law.h"

namespace mvs::core::obj {

// Appends words to a text and counts its groups and records. A line is begun by group(), record()
// or statement(), and ended by end_line() or vector().
class LineWriter {
 public:
  // `valve` is the part that errors name.
  explicit LineWriter(std::string valve) : valve_(std::move(valve)) {}

  void reserve(size_t bytes) { text_.reserve(bytes); }
  void comment(std::string_view words) { text_.append("# ").append(words).append(1, '\n'); }
  void statement(char letter) { text_ += letter; }
  void group();
  void record(std::string_view word);
  // A record with name and id of a part.
  template <typename Part>
  void part(std::string_view word, const Part &part) {
    record(word);
    key_text("name", part.name);
    key_whole("id", part.id);
  }

  void word(std::string_view word) { text_.append(1, ' ').append(word); }
  // A name, in the form of formats/text/line.h.
  void name(std::string_view name);
  void number(double value, int shift = 0);
  // Numbers of nodes, from 1.
  void vertices(std::initializer_list<uint32_t> nodes);

  void key_text(std::string_view key, std::string_view text);
  void key_number(std::string_view key, double value, int shift = 0);
  void key_whole(std::string_view key, uint64_t value);
  void key_choice(std::string_view key, std::span<const std::string_view> words, uint32_t index);
  template <typename Values>
  void key_constants(std::span<const Constant> constants, const Values &values) {
    for (size_t k = 0; k < constants.size(); ++k) key_number(constants[k].key, values[k]);
  }

  void end_line() { text_ += '\n'; }
  // The end of a line with three numbers, and a record of three numbers.
  void vector(const Vec3 &values, int shift = mm);
  void vector_record(std::string_view word, const Vec3 &values, int shift = mm);

  uint64_t groups() const { return groups_; }
  uint64_t records() const { return records_; }
  std::string take() { return std::move(text_); }

 private:
  void key(std::string_view name) { text_.append(1, ' ').append(name).append(1, '='); }
  void decimal(double value, int shift);

  std::string valve_, text_;
  uint64_t groups_ = 0, records_ = 0;
};

}  // namespace mvs::core::obj
