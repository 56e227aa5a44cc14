// Entry point of the Abaqus reader: units, parts, valve.
#include <algorithm>

#include "formats/abaqus/valve.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

struct Unit {
  std::string_view name;
  int power;
};
constexpr std::array lengths = {Unit{"M", 0}, Unit{"CM", 2}, Unit{"MM", 3}};
constexpr std::array stresses = {Unit{"PA", 0}, Unit{"KPA", -3}, Unit{"MPA", -6},
                                 Unit{"DYN/CM2", 1}};

// Parses "mm MPa", in any order, separated by commas or blanks; time is in s.
InpUnits units_of(const InpUnitsLine &given) {
  InpUnits units;
  std::string words = inp_label(given.words);
  std::replace(words.begin(), words.end(), ',', ' ');
  Line line(words, given.line);
  bool has_length = false, has_stress = false;
  for (std::string_view word = line.word(); !word.empty(); word = line.word()) {
    const auto is_word = [&](const Unit &unit) { return unit.name == word; };
    const auto length = std::find_if(lengths.begin(), lengths.end(), is_word);
    const auto stress = std::find_if(stresses.begin(), stresses.end(), is_word);
    if (length != lengths.end() && !has_length) {
      units.length = length->power;
      has_length = true;
    } else if (stress != stresses.end() && !has_stress) {
      units.stress = stress->power;
      has_stress = true;
    } else {
      inp_fail(given.line,
               "units are one of length (m, cm, mm) and one of stress (Pa, kPa, MPa, dyn/cm2): %s "
               "is neither",
               quoted(word).c_str());
    }
  }
  if (!has_length || !has_stress) {
    inp_fail(given.line, "units need one of length and one of stress, as `** units: mm MPa`");
  }
  return units;
}

InpUnits read_units(std::string_view text, InpNotes &notes) {
  const InpUnitsLine given = find_inp_units(text);
  if (given.line != 0) return units_of(given);
  notes.chosen(
      "Abaqus input has no units: taken as mm, MPa, tonne, s; a first line "
      "`** units: m Pa` says otherwise");
  return {};
}

}  // namespace

Imported read_inp(std::string_view text) {
  if (text.size() > max_file_bytes) {
    inp_fail(0, "the file has %zu bytes, the limit is %zu", text.size(), max_file_bytes);
  }
  InpNotes notes;
  const InpUnits units = read_units(text, notes);
  std::vector<InpCard> cards = split_inp(text);
  if (cards.empty()) inp_fail(0, "the file has no keyword: it is not an Abaqus input file");
  const InpMesh mesh = read_inp_mesh(cards, units, notes);
  const InpProperties properties = read_inp_properties(cards, mesh, notes);
  const InpLoad load = read_inp_load(cards, mesh, notes);
  Imported imported;
  imported.loaded = build_inp_valve(mesh, properties, load, notes);
  notes.left_over(cards);
  imported.notes = notes.list();
  return imported;
}

}  // namespace mvs::core
