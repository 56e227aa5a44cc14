#include "import/findings_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>

#include "text/content_hash.h"
#include "text/json_text.h"
#include "text/replace_file.h"

namespace cli {
namespace {

constexpr const char *sources[] = {"", "given", "measured", "guessed", "assumed"};

const char *source_name(mvs_finding_source source) {
  return source >= MVS_FINDING_SOURCE_GIVEN && source <= MVS_FINDING_SOURCE_ASSUMED
             ? sources[source]
             : "unknown";
}

mvs_finding_source source_of(const std::string &name) {
  for (uint32_t k = 1; k < std::size(sources); ++k) {
    if (name == sources[k]) return k;
  }
  return 0;
}

// A digest of the bits of the values: an edited row has another one.
std::string digest_of(const std::vector<double> &values) {
  std::string bytes;
  for (const double value : values) {
    const auto bits = std::bit_cast<uint64_t>(value);
    for (int k = 0; k < 64; k += 8) bytes += static_cast<char>((bits >> k) & 255);
  }
  return content_hash(bytes);
}

[[noreturn]] void refuse_findings(const std::string &path, const std::string &part,
                                  const std::string &sentence) {
  fail(MVS_E_FORMAT, part, path + ": " + sentence);
}

// The numbers of a finding; every one finite.
std::vector<double> numbers_of(const std::string &path, const std::string &name, const Json &row) {
  const auto values = row.find("values");
  if (values == row.end() || !values->is_array()) {
    refuse_findings(path, name, "the finding \"" + name + "\" has no list \"values\"");
  }
  std::vector<double> numbers;
  for (const Json &value : *values) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) {
      refuse_findings(path, name,
                      "the finding \"" + name + "\" has a value that is not a finite number");
    }
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

// A field of a finding, `absent` without it. One of another type is refused.
template <typename Value>
Value field_of(const std::string &path, const std::string &name, const Json &row, const char *key,
               const Value &absent) {
  const auto field = row.find(key);
  if (field == row.end()) return absent;
  const Json example = absent;
  const bool is_number = example.is_number();
  if (is_number ? field->is_number() : field->type() == example.type()) return field->get<Value>();
  const char *kind = is_number ? "a number" : example.is_string() ? "a text" : "true or false";
  refuse_findings(path, name,
                  "the finding \"" + name + "\" has a \"" + key + "\" that is not " + kind);
}

Json parsed(const std::string &path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail(MVS_E_IO, path, path + ": the file of findings cannot be opened");
  std::stringstream content;
  content << in.rdbuf();
  std::string fault;
  Json object = parse_json(content.str(), fault);
  if (!fault.empty()) refuse_findings(path, "json", "is no JSON text: " + fault);
  return object;
}

// The findings that are an input of a build, where their values go, and how many numbers one value
// has; of numbers there is one value.
struct Input {
  const char *name;
  std::vector<double> KnownValues::*values;
  size_t width;
};
constexpr Input inputs[] = {{"annulus", &KnownValues::annulus, 3},
                            {"commissures", &KnownValues::commissures, 3},
                            {"anterior", &KnownValues::anterior, 3},
                            {"papillary_tips", &KnownValues::papillary_tips, 3},
                            {"closed_annulus", &KnownValues::closed_annulus, 3},
                            {"closed_tips", &KnownValues::closed_tips, 3},
                            {"thickness", &KnownValues::thickness, 1},
                            {"edge_error", &KnownValues::edge_error, 1},
                            {"edge_lost", &KnownValues::edge_lost, 1},
                            {"thickness_error", &KnownValues::thickness_error, 1},
                            {"closed_error", &KnownValues::closed_error, 1},
                            {"tissue", &KnownValues::tissue, 1}};

// Null: the finding is no input.
const Input *find_input(const std::string &name) {
  const auto found = std::find_if(std::begin(inputs), std::end(inputs),
                                  [&](const Input &input) { return name == input.name; });
  return found == std::end(inputs) ? nullptr : found;
}

// Whether the values of a finding that a build wrote are others now. Not numbers: they are not
// used.
bool is_edited(const Json &row) {
  std::vector<double> values;
  for (const Json &value : row.value("values", Json::array())) {
    if (!value.is_number()) return true;
    values.push_back(value.get<double>());
  }
  return row.contains("unedited") && row["unedited"] != digest_of(values);
}

std::string names_of_inputs() {
  std::string names;
  for (const Input &input : inputs) names += (names.empty() ? "" : ", ") + std::string(input.name);
  return names;
}

// Names landmarks of an earlier import that are still not sure beside the interval of leaks, which
// has none of their errors. The build takes them for given ones.
void name_left_out(const std::string &landmarks, mvs::Finding &finding) {
  if (finding.name == "leak_interval" && !finding.values.empty()) {
    finding.sentence += "; errors of the " + landmarks + ", which were not given, are not in it";
  } else if (finding.name == "leak_limits") {
    finding.sentence +=
        "; errors of the guessed " + landmarks + " are not in it: give them as landmarks";
  }
}

}  // namespace

Json findings_json(const std::vector<mvs::Finding> &findings) {
  Json rows = Json::array();
  for (const mvs::Finding &finding : findings) {
    rows.push_back({{"name", finding.name},
                    {"source", source_name(finding.source)},
                    {"confidence", finding.confidence},
                    {"sentence", finding.sentence},
                    {"unit", finding.unit},
                    {"values", finding.values},
                    {"unedited", digest_of(finding.values)},
                    {"doubtful", finding.doubtful}});
  }
  return rows;
}

std::string findings_text(const std::vector<mvs::Finding> &findings) {
  std::string lines;
  for (const mvs::Finding &finding : findings) {
    lines += text("\n  %-15s %-9s %3.0f %%  %s", finding.name.c_str(), source_name(finding.source),
                  100 * finding.confidence, finding.sentence.c_str());
  }
  return lines;
}

void write_findings(const std::string &path, const std::string &surface,
                    const std::vector<mvs::Finding> &findings) {
  const Json object = {{"format", "libmvs import"},
                       {"version", 1},
                       {"surface", surface},
                       {"findings", findings_json(findings)}};
  replace_file(path, object.dump(2) + "\n", "findings");
}

bool is_input(const std::string &name) {
  return find_input(name) != nullptr;
}

KnownValues read_findings(const std::string &path) {
  const Json object = parsed(path);
  if (!object.is_object() || object.value("format", Json()) != "libmvs import") {
    refuse_findings(path, "format", "is no file of findings that `mvs import` wrote");
  }
  if (object.value("version", Json()) != 1) {
    refuse_findings(path, "version", "has a version that this program does not know: update mvs");
  }
  KnownValues known;
  const auto rows = object.find("findings");
  if (rows == object.end() || !rows->is_array()) {
    refuse_findings(path, "findings", "has no list \"findings\"");
  }
  for (const Json &row : *rows) {
    if (!row.is_object() || !row.contains("name") || !row["name"].is_string()) {
      refuse_findings(path, "findings", "has a finding without a name");
    }
    const std::string name = row["name"].get<std::string>();
    const Input *input = find_input(name);
    const auto source = field_of<std::string>(path, name, row, "source", "");
    // findings that a build wrote have a digest, so that this row is written by hand
    if (!input && !row.contains("unedited")) {
      refuse_findings(
          path, name,
          "the finding \"" + name + "\" is no input of a build; inputs are " + names_of_inputs());
    }
    if (!input || source == "measured") {
      if (is_edited(row)) known.ignored.push_back(name);
      continue;
    }
    std::vector<double> &values = known.*input->values;
    values = numbers_of(path, name, row);
    if (values.empty() || values.size() % input->width != 0 ||
        (input->width == 1 && values.size() != 1)) {
      refuse_findings(path, name,
                      "the finding \"" + name + "\" has " + std::to_string(values.size()) +
                          " values: points need x, y, z each, the others one");
    }
    const bool is_unsure = source == "guessed" || source == "assumed";
    const auto unedited = field_of<std::string>(path, name, row, "unedited", "");
    if (!is_unsure || unedited != digest_of(values)) continue;
    mvs::Finding found;
    found.name = name;
    found.source = source_of(source);
    found.confidence = field_of(path, name, row, "confidence", 1.0);
    found.doubtful = field_of(path, name, row, "doubtful", false);
    known.unsure[name] = std::move(found);
  }
  return known;
}

void keep_doubts(const KnownValues &known, std::vector<mvs::Finding> &findings) {
  bool has_heads = false, has_commissures = false;
  for (mvs::Finding &finding : findings) {
    const auto at = known.unsure.find(finding.name);
    if (at == known.unsure.end() || finding.source != MVS_FINDING_SOURCE_GIVEN) continue;
    finding.source = at->second.source;
    finding.confidence = std::min(finding.confidence, at->second.confidence);
    finding.doubtful = finding.doubtful || at->second.doubtful;
    finding.sentence += std::string("; ") + source_name(finding.source) +
                        " in an earlier import: change its source to \"given\" if it is known";
    has_heads = has_heads || finding.name == "papillary_tips";
    has_commissures = has_commissures || finding.name == "commissures";
  }
  if (!has_heads && !has_commissures) return;
  const std::string left_out = std::string(has_heads ? "papillary heads" : "") +
                               (has_heads && has_commissures ? " and " : "") +
                               (has_commissures ? "commissures" : "");
  for (mvs::Finding &finding : findings) name_left_out(left_out, finding);
}

}  // namespace cli
