// A hash that tells contents of files apart; not for security.
#pragma once

#include <string>
#include <string_view>

namespace cli {

// FNV-1a of the bytes, 64 bits, as 16 hexadecimal digits.
std::string content_hash(std::string_view bytes);

}  // namespace cli
