#include "text/command_units.h"

#include <regex>

#include "text/console.h"
#include "text/op_forms.h"

namespace cli {
namespace {

int scopes = 0;

// The lengths of a sentence: "0.5 m", "3e-05 m", "1e-4 to 0.2 m"; not "0.5 m/s" or "0.5 m2".
std::string with_lengths_in_mm(const std::string &sentence) {
  static const std::string number = R"(-?\d+(?:\.\d+)?(?:e[-+]?\d+)?)";
  static const std::regex length("(?:(" + number + ") to )?(" + number + R"() m(?![\w/]))");
  const auto in_mm = [](const std::string &metres) {
    double value = 0;
    read_number(metres, value);
    return text("%.4g", 1e3 * value);
  };
  std::string out, rest = sentence;
  for (std::smatch found; std::regex_search(rest, found, length); rest = found.suffix()) {
    out += found.prefix();
    if (found[1].matched) out += in_mm(found[1]) + " to ";
    out += in_mm(found[2]) + " mm";
  }
  return out + rest;
}

}  // namespace

std::string in_command_units(const std::string &sentence) {
  static const std::pair<std::regex, const char *> hints[] = {
      {std::regex(R"(\blooks like mm given as m\b)"), "lengths are in mm"},
      {std::regex(R"(\blooks like (a modulus|moduli) in kPa or MPa given as Pa\b)"),
       "moduli are in MPa"},
      {std::regex(R"(\byoung is in Pa, area in m2\b)"), "young is in MPa, area in mm2"},
      {std::regex(R"(\b(in|than) m\b)"), "$1 mm"},
      {std::regex(R"(\ba pressure of \S+ Pa is (\S+ mmHg): .*)"),
       "a pressure of $1 is unusual: pressures are in mmHg, 120 in systole"},
      {std::regex(R"(\boptions\.septum\b)"), "--septum"}};
  std::string out = with_lengths_in_mm(sentence);
  for (const auto &[hint, words] : hints) out = std::regex_replace(out, hint, words);
  return out;
}

CommandUnits::CommandUnits() {
  ++scopes;
}

CommandUnits::~CommandUnits() {
  --scopes;
}

bool CommandUnits::apply() {
  return scopes > 0;
}

}  // namespace cli
