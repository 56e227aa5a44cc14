// Linear scan for the line of a part: counts statements of its kind, and compares names.
#include "formats/obj/part_line.h"

#include <algorithm>
#include <array>
#include <optional>

#include "base/utf8.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

// A kind of part in error messages, and the words of its lines.
struct PartLines {
  std::string_view kind;
  std::string_view counted;  // the k-th line of this word belongs to part k
  std::string_view named;    // a line of this word may have the name of the part
};
constexpr std::array<PartLines, 10> kinds = {{{"node ", "v", ""},
                                              {"triangle ", "f", ""},
                                              {"edge ", "", ""},
                                              {"chord ", "l", "chord"},
                                              {"papillary head ", "head", "head"},
                                              {"leaflet ", "leaflet", "leaflet"},
                                              {"scallop ", "scallop", "scallop"},
                                              {"ring ", "ring", "ring"},
                                              {"curve ", "curve", "curve"},
                                              {"annulus", "annulus", ""}}};

class PartSearch {
 public:
  explicit PartSearch(std::string_view part) {
    for (const PartLines &kind : kinds) {
      if (part.starts_with(kind.kind)) lines_ = kind;
    }
    if (part == "valve") lines_ = {part, part, ""};
    name_ = part.substr(lines_.kind.size());
    const size_t dash = name_.find('-');
    is_edge_ = lines_.kind == "edge " && dash != std::string_view::npos &&
               parse_whole(name_.substr(0, dash), edge_[0]) &&
               parse_whole(name_.substr(dash + 1), edge_[1]);
    uint64_t index = 0;
    // the annulus and the valve have no index: their first line stands for them
    if (name_.empty() || lines_.kind == "annulus" || parse_whole(name_, index)) index_ = index;
  }

  // Whether the line has the name of the part or joins the nodes of the edge; the first line of its
  // index counts only if no line has its name.
  bool is_found(std::string_view content, int32_t number) {
    Line line(content, number);
    std::string_view word = line.word();
    if (word == "#mvs") word = line.word();
    vertices_ += word == "v";
    if (is_edge_ && word == "f") return has_edge(line);
    if (word.empty()) return false;
    if (word == lines_.counted) count(word, line);
    return word == lines_.named && has_name(line);
  }

  int32_t line_of_index() const { return line_of_index_; }

 private:
  bool has_edge(Line &line) const {
    std::array<uint64_t, 3> nodes;
    for (uint64_t &node : nodes) node = line.vertex(vertices_);
    return std::count(nodes.begin(), nodes.end(), edge_[0]) > 0 &&
           std::count(nodes.begin(), nodes.end(), edge_[1]) > 0;
  }

  bool has_name(Line &line) const {
    std::string name;
    return Fields(line).text("name", name) && name == name_;
  }

  // An l line has a segment, a part of its own, for each vertex but the first.
  void count(std::string_view word, Line line) {
    uint64_t parts = 1;
    if (word == "l") {
      for (line.word(), line.word(); !line.at_end(); line.word()) ++parts;
    }
    if (index_ && *index_ >= seen_ && *index_ < seen_ + parts) {
      line_of_index_ = line.number_of_line();
    }
    seen_ += parts;
  }

  PartLines lines_ = {};
  std::string_view name_;
  std::optional<uint64_t> index_;
  bool is_edge_ = false;
  std::array<uint64_t, 2> edge_ = {};
  uint64_t vertices_ = 0, seen_ = 0;
  int32_t line_of_index_ = 0;
};

int32_t line_of_part(std::string_view text, std::string_view part) {
  PartSearch search(part);
  text = without_byte_order_mark(text);
  for (int32_t number = 1; !text.empty(); ++number) {
    if (search.is_found(take_line(text), number)) return number;
  }
  return search.line_of_index();
}

// Whether the sentence has a number of a part, such as "node 17".
bool has_number_of_part(std::string_view sentence) {
  constexpr std::array words = {"node ", "nodes ", "triangle ", "edge ", "chord ", "head "};
  return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
    const size_t at = sentence.find(word), after = at + word.size();
    return at != std::string_view::npos && after < sentence.size() && sentence[after] >= '0' &&
           sentence[after] <= '9';
  });
}

}  // namespace

Error with_line_of_part(const Error &error, std::string_view text) {
  const int32_t line = line_of_part(text, error.part);
  if (line == 0) return error;
  std::string sentence = error.what();
  if (has_number_of_part(sentence)) sentence += " (these numbers count from 0)";
  return {error.code, error.part, sentence, line};
}

}  // namespace mvs::core
