// Words and numbers, each after a space.
#include "formats/obj/line_writer.h"

#include <charconv>
#include <cmath>

#include "base/error.h"
#include "formats/text/decimal.h"
#include "formats/text/line.h"

namespace mvs::core::obj {

void LineWriter::group() {
  text_ += 'g';
  ++groups_;
}

void LineWriter::record(std::string_view word) {
  text_.append("#mvs ").append(word);
  ++records_;
}

void LineWriter::name(std::string_view name) {
  text_ += ' ';
  append_text(text_, name);
}

void LineWriter::number(double value, int shift) {
  text_ += ' ';
  decimal(value, shift);
}

void LineWriter::vertices(std::initializer_list<uint32_t> nodes) {
  for (const uint32_t node : nodes) {
    char digits[16];
    const char *end = std::to_chars(digits, digits + sizeof digits, node + 1).ptr;
    word({digits, static_cast<size_t>(end - digits)});
  }
}

void LineWriter::key_text(std::string_view name, std::string_view text) {
  key(name);
  append_text(text_, text);
}

void LineWriter::key_number(std::string_view name, double value, int shift) {
  key(name);
  decimal(value, shift);
}

void LineWriter::key_whole(std::string_view name, uint64_t value) {
  key(name);
  text_ += std::to_string(value);
}

void LineWriter::key_choice(std::string_view name, std::span<const std::string_view> words,
                            uint32_t index) {
  MVS_MUST(index < words.size(), MVS_E_INTERNAL, std::string(name),
           "the OBJ writer has no word for %.*s %u", static_cast<int>(name.size()), name.data(),
           index);
  key(name);
  text_ += words[index];
}

void LineWriter::vector(const Vec3 &values, int shift) {
  for (int k = 0; k < 3; ++k) number(values[k], shift);
  end_line();
}

void LineWriter::vector_record(std::string_view word, const Vec3 &values, int shift) {
  record(word);
  vector(values, shift);
}

void LineWriter::decimal(double value, int shift) {
  MVS_MUST(std::isfinite(value), MVS_E_DIVERGED, valve_,
           "a number of the valve or its state is not finite: go back to an earlier state and save "
           "that");
  append_decimal(text_, value, shift);
}

}  // namespace mvs::core::obj
