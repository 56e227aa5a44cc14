// A reader of XML elements without a stack of calls: open elements are a list.
#include "formats/surface/xml.h"

#include <algorithm>
#include <cstdint>

#include "formats/surface/cursor.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// so that elements take no more memory than the file may have
constexpr size_t deepest_element = 32, most_elements = size_t{1} << 20, most_attributes = 32;

struct XmlEntity {
  std::string_view coded;
  char plain;
};
constexpr XmlEntity xml_entities[] = {
    {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&quot;", '"'}, {"&apos;", '\''}};

std::string xml_unescaped(std::string_view text) {
  std::string plain;
  while (!text.empty()) {
    const auto entity =
        std::find_if(std::begin(xml_entities), std::end(xml_entities),
                     [&](const XmlEntity &known) { return text.starts_with(known.coded); });
    const bool is_known = entity != std::end(xml_entities);
    plain += is_known ? entity->plain : text[0];
    text.remove_prefix(is_known ? entity->coded.size() : 1);
  }
  return plain;
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
         c == '-' || c == ':' || c == '.';
}

class XmlReader {
 public:
  XmlReader(std::string_view text, std::string_view stop) : text_(text), stop_(stop) {}

  std::vector<XmlElement> read();

 private:
  [[noreturn]] void fail(const char *sentence) const { Cursor(text_, line_).fail("%s", sentence); }
  void advance(size_t to);
  void skip_past(std::string_view end, const char *sentence);
  std::string_view name();
  void end_text(size_t end);
  void read_start();
  void read_attributes(XmlElement &element);
  void read_end();

  std::string_view text_, stop_;
  size_t at_ = 0;
  int32_t line_ = 1;
  bool is_stopped_ = false;
  std::vector<XmlElement> elements_;
  std::vector<uint32_t> open_;
  size_t text_start_ = 0;  // of the text of the innermost open element
};

void XmlReader::advance(size_t to) {
  const size_t end = std::min(to, text_.size());
  line_ += static_cast<int32_t>(std::count(text_.begin() + static_cast<ptrdiff_t>(at_),
                                           text_.begin() + static_cast<ptrdiff_t>(end), '\n'));
  at_ = end;
}

void XmlReader::skip_past(std::string_view end, const char *sentence) {
  const size_t found = text_.find(end, at_);
  if (found == std::string_view::npos) fail(sentence);
  advance(found + end.size());
}

std::string_view XmlReader::name() {
  size_t stop = at_;
  while (stop < text_.size() && is_name_character(text_[stop])) ++stop;
  const std::string_view found = text_.substr(at_, stop - at_);
  if (found.empty()) fail("the XML lacks a name here, or the file is cut short");
  advance(stop);
  return found;
}

void XmlReader::read_attributes(XmlElement &element) {
  for (;;) {
    advance(std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()));
    if (at_ == text_.size()) fail("the XML ends within an element: the file is cut short");
    if (text_[at_] == '>' || text_[at_] == '/') return;
    if (element.attributes.size() == most_attributes) fail("an element has over 32 attributes");
    const std::string_view key = name();
    advance(std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()));
    if (at_ == text_.size() || text_[at_] != '=') fail("an attribute of the XML has no value");
    advance(std::min(text_.find_first_not_of(" \t\r\n", at_ + 1), text_.size()));
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    if (quote != '"' && quote != '\'') fail("an attribute of the XML is not in quotation marks");
    const size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) fail("the XML ends within an attribute: it is cut short");
    element.attributes.emplace_back(key, xml_unescaped(text_.substr(at_ + 1, end - at_ - 1)));
    advance(end + 1);
  }
}

// Text of the innermost open element ends before `end`, where a tag begins.
void XmlReader::end_text(size_t end) {
  if (open_.empty()) return;
  const std::string_view found = text_.substr(text_start_, end - text_start_);
  std::string_view &content = elements_[open_.back()].content;
  if (without_blanks(content).empty()) content = found;
}

void XmlReader::read_start() {
  end_text(at_ - 1);
  if (elements_.size() > 0 && open_.empty()) fail("the XML has more than one outermost element");
  if (open_.size() == deepest_element) fail("the XML is nested too deeply");
  if (elements_.size() == most_elements) fail("the XML has more than 2^20 elements");
  XmlElement element;
  element.line = line_;
  element.name = name();
  read_attributes(element);
  const bool is_empty = text_[at_] == '/';
  if (is_empty) skip_past(">", "the XML ends within an element: the file is cut short");
  if (!is_empty) advance(at_ + 1);
  const auto index = static_cast<uint32_t>(elements_.size());
  if (!open_.empty()) elements_[open_.back()].inside.push_back(index);
  is_stopped_ = element.name == stop_;
  if (is_stopped_) element.content = text_.substr(at_);
  if (!is_empty && !is_stopped_) open_.push_back(index);
  elements_.push_back(std::move(element));
  text_start_ = at_;
}

void XmlReader::read_end() {
  end_text(at_ - 2);
  if (open_.empty() || elements_[open_.back()].name != name()) {
    fail("the XML closes an element that is not open");
  }
  skip_past(">", "the XML ends within an element: the file is cut short");
  open_.pop_back();
  text_start_ = at_;
}

std::vector<XmlElement> XmlReader::read() {
  while (!is_stopped_) {
    const size_t next = text_.find('<', at_);
    if (next == std::string_view::npos) break;
    advance(next + 1);
    const std::string_view rest = text_.substr(at_);
    if (rest.starts_with("?")) {
      skip_past("?>", "the XML ends within its declaration: the file is cut short");
    } else if (rest.starts_with("!--")) {
      skip_past("-->", "the XML ends within a comment: the file is cut short");
    } else if (rest.starts_with("!")) {
      fail("document types and CDATA are not read");
    } else if (rest.starts_with("/")) {
      advance(at_ + 1);
      read_end();
    } else {
      read_start();
    }
  }
  if (elements_.empty()) fail("the text is not XML");
  if (!open_.empty() && !is_stopped_) fail("the XML ends within an element: the file is cut short");
  return std::move(elements_);
}

}  // namespace

std::string_view XmlElement::attribute(std::string_view key, std::string_view otherwise) const {
  for (const auto &[name_of, value] : attributes) {
    if (name_of == key) return value;
  }
  return otherwise;
}

std::vector<XmlElement> read_xml(std::string_view text, std::string_view stop) {
  return XmlReader(text, stop).read();
}

const XmlElement *find_inside(const std::vector<XmlElement> &all, const XmlElement &in,
                              std::string_view name) {
  for (const uint32_t index : in.inside) {
    if (all[index].name == name) return &all[index];
  }
  return nullptr;
}

}  // namespace mvs::core
