// Messages about unsupported keywords and parameters.
#include "formats/abaqus/notes.h"

#include <mvs/sim.h>

#include <algorithm>
#include <array>
#include <cstdarg>

#include "formats/text/line.h"

namespace mvs::core {
namespace {

// Limit of messages, above the number in real files.
constexpr size_t most_messages = 200;

struct Reason {
  std::string_view keyword, why;
};
// Reasons for ignored keywords that files of valves contain.
constexpr std::array reasons = {
    Reason{"TRANSVERSE SHEAR", "a membrane does not shear through its thickness"},
    Reason{"SECTION CONTROLS", "a setting of Abaqus' elements"},
    Reason{"HOURGLASS STIFFNESS", "a setting of Abaqus' elements"},
    Reason{"BULK VISCOSITY", "a setting of Abaqus' solver"},
    Reason{"VARIABLE MASS SCALING", "a setting of Abaqus' solver"},
    Reason{"FIXED MASS SCALING", "a setting of Abaqus' solver"},
    Reason{"DYNAMIC", "settle has its own options for the path to equilibrium"},
    Reason{"STATIC", "settle has its own options for the path to equilibrium"},
    Reason{"CONTROLS", "a setting of Abaqus' solver"},
    Reason{"DAMPING", "settle and step have their own option for damping"},
    Reason{"FRICTION", "leaflets slide without friction here"},
    Reason{"OUTPUT", "an output request"},
    Reason{"NODE OUTPUT", "an output request"},
    Reason{"ELEMENT OUTPUT", "an output request"},
    Reason{"CONTACT OUTPUT", "an output request"},
    Reason{"ENERGY OUTPUT", "an output request"},
    Reason{"NODE PRINT", "an output request"},
    Reason{"EL PRINT", "an output request"},
    Reason{"NODE FILE", "an output request"},
    Reason{"EL FILE", "an output request"},
    Reason{"MONITOR", "an output request"},
    Reason{"RESTART", "an output request"},
    Reason{"PREPRINT", "an output request"},
    Reason{"FILE OUTPUT", "an output request"},
};

std::string reason_for(std::string_view keyword) {
  const auto found = std::find_if(reasons.begin(), reasons.end(),
                                  [&](const Reason &r) { return r.keyword == keyword; });
  return found == reasons.end() ? "not known to this reader" : std::string(found->why);
}

}  // namespace

void InpNotes::left_out(int32_t line, const std::string &sentence) {
  const auto [place, is_new] = known_.emplace(sentence, left_out_.size());
  if (is_new) left_out_.push_back({line, sentence, 0});
  ++left_out_[place->second].count;
}

void InpNotes::chosen(const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  chosen_.push_back(vformat(pattern, arguments));
  va_end(arguments);
}

void InpNotes::counted(const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  counted_.push_back(vformat(pattern, arguments));
  va_end(arguments);
}

void InpNotes::left_over(const std::vector<InpCard> &cards) {
  for (const InpCard &card : cards) {
    // quoted() also shortens, so that a hostile keyword cannot fill the log
    const std::string shown = quoted("*" + card.keyword);
    if (!card.used) {
      left_out(card.line, shown + " is left out: " + reason_for(card.keyword));
      continue;
    }
    for (const InpParameter &parameter : card.parameters) {
      if (parameter.taken) continue;
      left_out(card.line, "parameter " + quoted(parameter.key) + " of " + shown + " is left out");
    }
  }
}

std::vector<Note> InpNotes::list() const {
  std::vector<LeftOut> sorted = left_out_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const LeftOut &l, const LeftOut &r) { return l.line < r.line; });
  std::vector<Note> notes;
  for (const LeftOut &note : sorted) {
    if (notes.size() == most_messages) {
      notes.push_back(
          {MVS_LOG_WARNING, format("%zu more kinds of lines from line %d on are left out",
                                   sorted.size() - most_messages, note.line)});
      break;
    }
    const std::string times = note.count > 1 ? format(" (%zu times)", note.count) : "";
    notes.push_back({MVS_LOG_WARNING, format("line %d: ", note.line) + note.sentence + times});
  }
  for (const std::string &sentence : chosen_) notes.push_back({MVS_LOG_WARNING, sentence});
  for (const std::string &sentence : counted_) notes.push_back({MVS_LOG_INFO, sentence});
  return notes;
}

}  // namespace mvs::core
