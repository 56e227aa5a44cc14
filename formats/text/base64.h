// Base64 (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace mvs::core {

void append_base64(std::string &out, std::string_view bytes);

// Throws MVS_E_FORMAT with the name of the part if the text is not base64.
std::string base64_bytes(std::string_view text, const char *part);

}  // namespace mvs::core
