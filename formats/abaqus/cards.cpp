// Lines, parameters, fields and numbers of Abaqus input.
#include "formats/abaqus/cards.h"

#include <algorithm>
#include <cctype>
#include <cstdarg>

#include "formats/text/decimal.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr size_t longest_line = 64 * 1024, most_lines = size_t{1} << 24, most_parameters = 64;

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

char capital(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

// Returns the text in capitals, with each run of blanks as one.
std::string keyword_of(std::string_view text) {
  std::string out;
  for (const char c : trimmed(text)) {
    const bool blank = c == ' ' || c == '\t';
    if (blank && !out.empty() && out.back() == ' ') continue;
    out += blank ? ' ' : capital(c);
  }
  return out;
}

// Takes the text up to the next unquoted comma, and removes the comma.
std::string_view next_field(std::string_view &rest) {
  bool in_quotes = false;
  size_t stop = 0;
  for (; stop < rest.size() && (in_quotes || rest[stop] != ','); ++stop) {
    if (rest[stop] == '"') in_quotes = !in_quotes;
  }
  const std::string_view field = rest.substr(0, stop);
  rest.remove_prefix(std::min(stop + 1, rest.size()));
  return trimmed(field);
}

void add_parameters(std::string_view text, InpCard &card, int32_t line) {
  while (!trimmed(text).empty()) {
    const std::string_view field = next_field(text);
    if (field.empty()) continue;
    const size_t equals = std::min(field.find('='), field.size());
    InpParameter parameter;
    parameter.key = keyword_of(field.substr(0, equals));
    parameter.value = trimmed(field.substr(std::min(equals + 1, field.size())));
    for (const InpParameter &other : card.parameters) {
      if (other.key != parameter.key) continue;
      inp_fail(line, "parameter %s of *%s is given twice", quoted(parameter.key).c_str(),
               card.keyword.c_str());
    }
    if (card.parameters.size() == most_parameters) {
      inp_fail(line, "*%s has over %zu parameters", card.keyword.c_str(), most_parameters);
    }
    card.parameters.push_back(std::move(parameter));
  }
}

InpCard new_card(std::string_view text, int32_t line) {
  InpCard card;
  card.line = line;
  text.remove_prefix(1);
  card.keyword = keyword_of(next_field(text));
  if (card.keyword.empty()) inp_fail(line, "a keyword has to follow the star");
  if (card.is("INCLUDE")) {
    inp_fail(line, "*INCLUDE is not followed: paste the other file in its place");
  }
  add_parameters(text, card, line);
  return card;
}

std::string_view next_line(std::string_view &text, int32_t line) {
  const size_t stop = std::min(text.find('\n'), text.size());
  const std::string_view content = text.substr(0, stop);
  text.remove_prefix(std::min(stop + 1, text.size()));
  if (content.size() > longest_line) {
    inp_fail(line, "the line has %zu bytes, the limit is %zu", content.size(), longest_line);
  }
  return trimmed(content);
}

}  // namespace

void inp_fail(int32_t line, const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  const std::string sentence = vformat(pattern, arguments);
  va_end(arguments);
  throw Error(MVS_E_FORMAT, "", sentence, line);
}

std::string inp_label(std::string_view word) {
  word = trimmed(word);
  std::string label;
  for (const char c : word) {
    if (c != '"') label += capital(c);
  }
  return label;
}

std::string_view InpRow::word() {
  return next_field(rest_);
}

double InpRow::number(const char *what, int shift, std::optional<double> otherwise) {
  const std::string_view token = word();
  if (token.empty()) {
    if (otherwise) return *otherwise;
    inp_fail(line_, "the line ends where %s is needed", what);
  }
  // Fortran's double precision exponent
  std::string text(token);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
  double value = 0;
  if (!parse_decimal(text, value, shift)) {
    inp_fail(line_, "%s is not a number; %s is needed", quoted(token).c_str(), what);
  }
  return value;
}

uint64_t InpRow::whole(const char *what) {
  const std::string_view token = word();
  uint64_t value = 0;
  if (token.empty()) inp_fail(line_, "the line ends where %s is needed", what);
  if (!parse_whole(token, value)) {
    inp_fail(line_, "%s is not a whole number; %s is needed", quoted(token).c_str(), what);
  }
  return value;
}

std::optional<std::string_view> InpCard::take(std::string_view key) {
  for (InpParameter &parameter : parameters) {
    if (parameter.key != key) continue;
    parameter.taken = true;
    return parameter.value;
  }
  return {};
}

std::string InpCard::need(std::string_view key) {
  const std::optional<std::string_view> value = take(key);
  if (!value || inp_label(*value).empty()) {
    inp_fail(line, "*%s lacks %.*s=", keyword.c_str(), static_cast<int>(key.size()), key.data());
  }
  return inp_label(*value);
}

std::vector<InpCard> split_inp(std::string_view text) {
  std::vector<InpCard> cards;
  size_t lines = 0;
  bool continues = false;  // a keyword line that ends with a comma continues in the next line
  for (int32_t number = 1; !text.empty(); ++number) {
    const std::string_view line = next_line(text, number);
    if (line.empty() || line.starts_with("**")) continue;
    if (++lines > most_lines) inp_fail(number, "the file has over %zu lines", most_lines);
    if (continues && !line.starts_with('*')) {
      add_parameters(line, cards.back(), number);
    } else if (line.starts_with('*')) {
      cards.push_back(new_card(line, number));
    } else if (cards.empty()) {
      inp_fail(number, "%s stands before the first keyword: Abaqus input begins with one, as *NODE",
               quoted(line).c_str());
    } else {
      cards.back().data.push_back({line, number});
      continue;
    }
    continues = line.ends_with(',');
  }
  return cards;
}

InpUnitsLine find_inp_units(std::string_view text) {
  for (int32_t number = 1; !text.empty(); ++number) {
    std::string_view line = next_line(text, number);
    if (line.starts_with('*') && !line.starts_with("**")) break;
    while (line.starts_with('*')) line.remove_prefix(1);
    line = trimmed(line);
    if (!keyword_of(line.substr(0, 5)).starts_with("UNITS")) continue;
    line = trimmed(line.substr(5));
    if (line.starts_with(':') || line.starts_with('=')) return {trimmed(line.substr(1)), number};
  }
  return {};
}

}  // namespace mvs::core
