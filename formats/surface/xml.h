// Elements of an XML text with attributes and content, as far as VTK files use XML: comments and
// the XML declaration are skipped, document types and CDATA are refused.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mvs::core {

struct XmlElement {
  std::string_view name;
  std::vector<std::pair<std::string_view, std::string>> attributes;
  std::string_view content;      // the first text in it that is not blank
  std::vector<uint32_t> inside;  // indices of the elements in it, in order
  int32_t line = 0;

  // The value of an attribute; `otherwise` if the element does not have it.
  std::string_view attribute(std::string_view key, std::string_view otherwise = {}) const;
};

// The elements in the order of their starts, the outermost one first. Reading stops at an element
// `stop`, whose content may be binary: its content is the rest of the text. MVS_E_FORMAT with the
// line.
std::vector<XmlElement> read_xml(std::string_view text, std::string_view stop);

// Returns the first element of this name in another one, or null.
const XmlElement *find_inside(const std::vector<XmlElement> &all, const XmlElement &in,
                              std::string_view name);

}  // namespace mvs::core
