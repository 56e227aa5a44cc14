// Binary numbers of files, of either byte order, as doubles.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace mvs::core {

struct NumberType {
  enum class Kind : uint8_t { whole, whole_signed, floating };
  Kind kind;
  uint8_t size;  // bytes: 1, 2, 4, 8
};

// The type of a name in a file, empty if it is unknown: "float", "Float32", "uchar",
// "unsigned_char", "vtktypeint64".
std::optional<NumberType> number_type(std::string_view name);

// The number at `at`, which has `type.size` bytes.
double number_at(const char *at, NumberType type, bool is_big_endian);

// An index of a file; -1 if the number is no whole one, or negative, or beyond 2^53.
int64_t index_of_number(double number);

// Appends all numbers of a block.
void append_numbers(std::vector<double> &to, std::string_view block, NumberType type,
                    bool is_big_endian);

}  // namespace mvs::core
