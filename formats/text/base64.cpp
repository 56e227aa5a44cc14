// Base64 codec: three bytes per four digits.
#include "formats/text/base64.h"

#include <mvs/base.h>

#include <algorithm>
#include <cstdint>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr std::string_view digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

void append_base64(std::string &out, std::string_view bytes) {
  for (size_t at = 0; at < bytes.size(); at += 3) {
    const size_t here = std::min<size_t>(3, bytes.size() - at);
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[at + k]) : 0u);
    }
    for (size_t k = 0; k < 4; ++k) out += k <= here ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
}

std::string base64_bytes(std::string_view text, const char *part) {
  const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  bool is_good = text.size() % 4 == 0;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t group = 0;
  for (size_t k = 0; k < text.size() && is_good; ++k) {
    const bool is_padding = k + padding >= text.size();
    const size_t digit = is_padding ? 0 : digits.find(text[k]);
    is_good = digit != std::string_view::npos;
    group = group << 6 | static_cast<uint32_t>(digit & 63);
    if (k % 4 != 3) continue;
    for (int shift = 16; shift >= 0; shift -= 8) bytes += static_cast<char>(group >> shift & 255);
  }
  MVS_MUST(is_good, MVS_E_FORMAT, part, "%s is not base64", part);
  bytes.resize(bytes.size() - padding);
  return bytes;
}

}  // namespace mvs::core
