// XML text of FEBio models: elements, attributes, numbers.
#include "formats/febio/text.h"

#include "base/error.h"
#include "formats/text/decimal.h"

namespace mvs::core {

void FebText::open(std::string_view name, std::string_view attributes) {
  text_.append(2 * depth_++, ' ').append("<").append(name);
  if (!attributes.empty()) text_.append(" ").append(attributes);
  text_ += ">\n";
}

void FebText::close(std::string_view name) {
  text_.append(2 * --depth_, ' ').append("</").append(name).append(">\n");
}

void FebText::leaf(std::string_view name, std::string_view value, std::string_view attributes) {
  text_.append(2 * depth_, ' ').append("<").append(name);
  if (!attributes.empty()) text_.append(" ").append(attributes);
  if (value.empty()) {
    text_ += "/>\n";
  } else {
    text_.append(">").append(value).append("</").append(name).append(">\n");
  }
}

void FebText::leaf(std::string_view name, double value, std::string_view attributes) {
  leaf(name, feb_number(value), attributes);
}

std::string feb_number(double value, int shift) {
  std::string text;
  append_decimal(text, value, shift);
  return text;
}

std::string feb_plain(double value) {
  std::string text = format("%.15f", value);
  while (text.ends_with('0')) text.pop_back();
  if (text.ends_with('.')) text.pop_back();
  return text;
}

std::string feb_attribute(std::string_view key, std::string_view text) {
  std::string out(key);
  out += "=\"";
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out + '"';
}

std::string feb_list(std::span<const double> values, int shift) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ',';
    append_decimal(text, value, shift);
  }
  return text;
}

}  // namespace mvs::core
