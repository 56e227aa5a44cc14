// Decoding of the blocks of VTK XML files. A block is a length in bytes and the bytes themselves;
// every byte of the file is used by one array only, so that no file can ask for more memory than a
// multiple of its size.
#include "formats/surface/vtp_data.h"

#include <algorithm>
#include <cstdarg>
#include <optional>

#include "base/error.h"
#include "formats/surface/cursor.h"
#include "formats/text/base64.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

[[noreturn, gnu::format(printf, 2, 3)]] void fail_at(const XmlElement &array, const char *pattern,
                                                     ...) {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string sentence = vformat(pattern, arguments);
  va_end(arguments);
  throw Error(MVS_E_FORMAT, as_utf8(array.attribute("Name")), sentence, array.line);
}

std::string quoted_name(const XmlElement &array) {
  return quoted(array.attribute("Name", array.name));
}

// The number of base64 digits of a number of bytes.
uint64_t base64_length(uint64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

}  // namespace

VtpData::VtpData(const XmlElement &root, const XmlElement *appended, size_t file_bytes)
    : unused_(file_bytes) {
  is_big_endian_ = root.attribute("byte_order", "LittleEndian") == "BigEndian";
  header_size_ = root.attribute("header_type", "UInt32") == "UInt64" ? 8 : 4;
  is_compressed_ = !root.attribute("compressor").empty();
  if (!appended) return;
  is_raw_ = appended->attribute("encoding", "base64") == "raw";
  const size_t start = appended->content.find('_');
  if (start != std::string_view::npos) appended_ = appended->content.substr(start + 1);
}

void VtpData::use(uint64_t bytes, const XmlElement &array) {
  if (bytes > unused_) fail_at(array, "the arrays overlap: %s", quoted_name(array).c_str());
  unused_ -= bytes;
}

uint64_t VtpData::length_at(std::string_view header, const XmlElement &array) const {
  if (header.size() < header_size_) {
    fail_at(array, "the file ends within the array %s: it is cut short",
            quoted_name(array).c_str());
  }
  const NumberType type = {NumberType::Kind::whole, static_cast<uint8_t>(header_size_)};
  const double length = number_at(header.data(), type, is_big_endian_);
  if (!(length <= static_cast<double>(unused_))) {
    fail_at(array, "the array %s states %g bytes, which the file does not have: it is cut short",
            quoted_name(array).c_str(), length);
  }
  return static_cast<uint64_t>(length);
}

// The bytes of a block at the start of base64 digits, which may continue behind it.
std::string VtpData::base64_block(std::string_view text, const XmlElement &array) {
  const std::string part = as_utf8(array.attribute("Name", array.name));
  const std::string_view start = text.substr(0, base64_length(header_size_));
  const std::string header = base64_bytes(start, part.c_str());
  const uint64_t length = length_at(header, array);
  // some writers end the digits of the length with '=' and begin anew
  const bool is_apart = start.ends_with('=') && length > 0;
  const uint64_t digits = base64_length(is_apart ? length : header_size_ + length);
  const std::string_view rest = text.substr(is_apart ? start.size() : 0);
  if (rest.size() < digits) {
    fail_at(array,
            "the array %s states %llu bytes, but its text ends before: the file is cut short",
            quoted_name(array).c_str(), static_cast<unsigned long long>(length));
  }
  use(digits, array);
  const std::string bytes = base64_bytes(rest.substr(0, digits), part.c_str());
  const size_t skipped = is_apart ? 0 : header_size_;
  if (bytes.size() < skipped + length) {
    fail_at(array, "the array %s has fewer bytes than it states", quoted_name(array).c_str());
  }
  return bytes.substr(skipped, length);
}

// The number of blocks, which begins the header of a compressed array.
uint64_t VtpData::block_count(std::string_view header, const XmlElement &array) const {
  const uint64_t count = length_at(header, array);
  if (count > unused_ / header_size_) {
    fail_at(array, "the array %s states %llu blocks, which the file does not have: it is cut short",
            quoted_name(array).c_str(), static_cast<unsigned long long>(count));
  }
  return count;
}

VtpBlocks VtpData::blocks_at(std::string_view header, const XmlElement &array) const {
  const NumberType type = {NumberType::Kind::whole, static_cast<uint8_t>(header_size_)};
  const auto size_at = [&](size_t word) {
    // sizes of whole blocks are checked against the stored ones when they are inflated
    const double size = number_at(header.data() + word * header_size_, type, is_big_endian_);
    constexpr double exact = 9e15;  // below 2^53
    if (size > exact)
      fail_at(array, "the array %s states %g bytes", quoted_name(array).c_str(), size);
    return static_cast<uint64_t>(size);
  };
  VtpBlocks blocks{size_at(1), size_at(2), {}};
  const uint64_t count = block_count(header, array);
  uint64_t sum = 0;
  for (size_t k = 0; k < count; ++k) {
    blocks.stored.push_back(length_at(header.substr((3 + k) * header_size_), array));
    sum += blocks.stored.back();
    if (sum > unused_) {
      fail_at(array, "the blocks of the array %s are longer than the file: it is cut short",
              quoted_name(array).c_str());
    }
  }
  return blocks;
}

std::string VtpData::inflated(const VtpBlocks &blocks, std::string_view stored,
                              const XmlElement &array) {
  try {
    return inflate_blocks(blocks, stored);
  } catch (const Error &error) {
    throw Error(error.code, as_utf8(array.attribute("Name")), error.what(), array.line);
  }
}

std::string VtpData::compressed_raw(std::string_view rest, const XmlElement &array) {
  const auto must_hold = [&](uint64_t bytes) {
    if (rest.size() >= bytes) return;
    fail_at(array, "the file ends within the array %s: it is cut short",
            quoted_name(array).c_str());
  };
  must_hold(3 * header_size_);
  const uint64_t header = (3 + block_count(rest, array)) * header_size_;
  must_hold(header);
  const VtpBlocks blocks = blocks_at(rest.substr(0, header), array);
  const uint64_t length = blocks.stored_size();
  must_hold(header + length);
  use(header + length, array);
  return inflated(blocks, rest.substr(header, length), array);
}

// Header and blocks are base64 texts of their own, one behind the other.
std::string VtpData::compressed_base64(std::string_view text, const XmlElement &array) {
  const std::string part = as_utf8(array.attribute("Name", array.name));
  const auto digits = [&](uint64_t from, uint64_t bytes) {
    const uint64_t count = base64_length(bytes);
    if (text.size() < from || text.size() - from < count) {
      fail_at(array, "the text of the array %s ends before its data: the file is cut short",
              quoted_name(array).c_str());
    }
    return text.substr(from, count);
  };
  // three words are a multiple of three bytes, so that their digits end with them
  const std::string start = base64_bytes(digits(0, 3 * header_size_), part.c_str());
  const uint64_t header_bytes = (3 + block_count(start, array)) * header_size_;
  const std::string header = base64_bytes(digits(0, header_bytes), part.c_str());
  if (header.size() < header_bytes) {
    fail_at(array, "the array %s has fewer bytes than it states", quoted_name(array).c_str());
  }
  const VtpBlocks blocks = blocks_at(header, array);
  const uint64_t header_digits = base64_length(header_bytes);
  const std::string_view data = digits(header_digits, blocks.stored_size());
  use(header_digits + data.size(), array);
  return inflated(blocks, base64_bytes(data, part.c_str()), array);
}

std::string VtpData::appended_block(const XmlElement &array) {
  uint64_t offset = 0;
  if (!parse_whole(array.attribute("offset"), offset) || offset > appended_.size()) {
    fail_at(array, "the array %s has no valid offset into the appended data",
            quoted_name(array).c_str());
  }
  const std::string_view rest = appended_.substr(offset);
  if (!is_raw_) {
    // blanks do not stand within base64 digits of VTK
    const size_t end = rest.find_first_of(" \t\r\n<");
    const std::string_view text = rest.substr(0, end);
    return is_compressed_ ? compressed_base64(text, array) : base64_block(text, array);
  }
  if (is_compressed_) return compressed_raw(rest, array);
  const uint64_t length = length_at(rest, array);
  if (rest.size() - header_size_ < length) {
    fail_at(array, "the file ends within the array %s: it is cut short",
            quoted_name(array).c_str());
  }
  use(length, array);
  return std::string(rest.substr(header_size_, length));
}

std::string VtpData::block(const XmlElement &array) {
  if (array.attribute("format") == "appended") return appended_block(array);
  std::string digits;
  for (const char c : array.content) {
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n') digits += c;
  }
  if (digits.empty()) return digits;
  return is_compressed_ ? compressed_base64(digits, array) : base64_block(digits, array);
}

std::vector<double> VtpData::numbers(const XmlElement &array, uint64_t count) {
  const std::optional<NumberType> type = number_type(array.attribute("type"));
  if (!type) {
    fail_at(array, "%s is not a type of numbers that is read",
            quoted(array.attribute("type")).c_str());
  }
  std::vector<double> found;
  if (array.attribute("format", "ascii") == "ascii") {
    Cursor cursor(array.content, array.line);
    cursor.must_hold(count, 2, "the number of values");
    use(array.content.size(), array);
    while (!cursor.at_end()) found.push_back(cursor.number_or_nan("a number"));
  } else {
    append_numbers(found, block(array), *type, is_big_endian_);
  }
  if (found.size() != count) {
    fail_at(array, "the array %s has %zu values, but %llu are needed", quoted_name(array).c_str(),
            found.size(), static_cast<unsigned long long>(count));
  }
  return found;
}

std::vector<std::string> VtpData::texts(const XmlElement &array) {
  std::string bytes;
  if (array.attribute("format", "ascii") == "ascii") {
    Cursor cursor(array.content, array.line);
    use(array.content.size(), array);
    while (!cursor.at_end()) bytes += static_cast<char>(cursor.whole("a byte") & 255);
  } else {
    bytes = block(array);
  }
  std::vector<std::string> found;
  for (size_t at = 0; at < bytes.size();) {
    const size_t end = std::min(bytes.find('\0', at), bytes.size());
    found.push_back(as_utf8(std::string_view(bytes).substr(at, end - at)));
    at = end + 1;
  }
  return found;
}

}  // namespace mvs::core
