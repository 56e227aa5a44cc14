// Text in attributes of XML.
#pragma once

#include <string>
#include <string_view>

namespace mvs::core {

inline std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"') {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace mvs::core
