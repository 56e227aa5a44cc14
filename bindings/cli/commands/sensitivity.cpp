// `mvs sensitivity`: derivatives of measures of a closed valve, sorted by influence.
#include <algorithm>
#include <cmath>

#include "commands/commands.h"
#include "valve/sensitivity.h"

namespace cli {
namespace {

struct SensitivityOptions {
  std::string file, to = "chords", chord, sort;
  std::vector<std::string> of = {"coaptation"};
  size_t top = 0;
};

Json notes_json(mvs_sensitivity_notes notes) {
  Json words = Json::array();
  for (const std::string &word : note_words(notes)) words.push_back(word);
  return words;
}

std::string quantity_key(const AskedQuantity &quantity, const AskedParameters &parameters) {
  return text("d_%s_%s_per_%s", quantity.name.c_str(), quantity.unit.c_str(),
              parameters.unit.c_str());
}

Json rows_json(const SensitivityTable &table, const std::vector<size_t> &order) {
  Json rows = Json::array();
  for (const size_t p : order) {
    Json row = {{"parameter", table.parameters.names[p]}};
    for (size_t q = 0; q < table.quantities.size(); ++q) {
      const std::string key = quantity_key(table.quantities[q], table.parameters);
      const size_t at = table.index(q, p);
      row[key] = number_json(table.derivative[at]);
      row[key + "_above"] = number_json(table.above[at]);
      row[key + "_below"] = number_json(table.below[at]);
    }
    row["notes"] = notes_json(table.parameter_notes[p]);
    rows.push_back(row);
  }
  return rows;
}

// The derivatives of a falling and of a growing parameter, as "-4.9/-5.1"; empty where they agree
// in all shown digits or are not known.
std::string both_sides(const SensitivityTable &table, size_t at) {
  const std::string below = text("%.3g", table.below[at]), above = text("%.3g", table.above[at]);
  return below == above || std::isnan(table.below[at]) ? std::string() : below + "/" + above;
}

std::string cell(const SensitivityTable &table, size_t q, size_t p) {
  const size_t at = table.index(q, p);
  const std::string sides = both_sides(table, at);
  return sides.empty() ? text("%.4g", table.derivative[at]) : sides;
}

// A switch whose two sides agree in all shown digits is not noted.
mvs_sensitivity_notes shown_notes(const SensitivityTable &table, size_t p) {
  constexpr mvs_sensitivity_notes of_sides = MVS_SENSITIVITY_NOTE_CHORD |
                                             MVS_SENSITIVITY_NOTE_CONTACT |
                                             MVS_SENSITIVITY_NOTE_KINK | MVS_SENSITIVITY_NOTE_SIDES;
  for (size_t q = 0; q < table.quantities.size(); ++q) {
    const size_t at = table.index(q, p);
    if (std::isnan(table.below[at]) || !both_sides(table, at).empty()) {
      return table.parameter_notes[p];
    }
  }
  return table.parameter_notes[p] & ~of_sides;
}

std::string lines(const SensitivityTable &table, const std::vector<size_t> &order) {
  size_t width = 9;
  for (const std::string &name : table.parameters.names) width = std::max(width, name.size());
  std::string out = text("\n  %-*s", static_cast<int>(width), "parameter");
  for (const AskedQuantity &q : table.quantities) {
    const std::string head =
        q.label + ", " + (q.unit.empty() ? "1" : q.unit) + "/" + table.parameters.unit;
    out += text("  %*s", static_cast<int>(std::max<size_t>(head.size(), 12)), head.c_str());
  }
  for (const size_t p : order) {
    out += text("\n  %-*s", static_cast<int>(width), table.parameters.names[p].c_str());
    for (size_t q = 0; q < table.quantities.size(); ++q) {
      const AskedQuantity &asked = table.quantities[q];
      const size_t head = asked.label.size() + 3 + std::max<size_t>(asked.unit.size(), 1) +
                          table.parameters.unit.size();
      out += text("  %*s", static_cast<int>(std::max<size_t>(head, 12)), cell(table, q, p).c_str());
    }
    const std::vector<std::string> words = note_words(shown_notes(table, p));
    if (!words.empty()) out += "  " + CLI::detail::join(words, ", ");
  }
  return out;
}

std::string quantity_lines(const SensitivityTable &table) {
  std::string out;
  for (size_t q = 0; q < table.quantities.size(); ++q) {
    const AskedQuantity &asked = table.quantities[q];
    const std::vector<std::string> words = note_words(table.quantity_notes[q]);
    out += text("\n  %s = %.4g %s%s%s", asked.label.c_str(), table.value[q], asked.unit.c_str(),
                words.empty() ? "" : "; ", CLI::detail::join(words, ", ").c_str());
  }
  return out;
}

size_t sort_row(const SensitivityTable &table, const std::string &name) {
  if (name.empty()) return 0;
  for (size_t q = 0; q < table.quantities.size(); ++q) {
    if (table.quantities[q].label == name || table.quantities[q].name == name) return q;
  }
  fail(MVS_E_ARGUMENT, "--sort", "--sort " + name + ": it has to be one of the quantities of --of");
}

void run_sensitivity(const SensitivityOptions &options, const Console &console) {
  const mvs::Snapshot valve = load(options.file);
  const SensitivityTable table = sensitivity_table(valve, options.of, options.to, options.chord);
  const size_t by = sort_row(table, options.sort);
  std::vector<size_t> order(table.parameters.names.size());
  for (size_t p = 0; p < order.size(); ++p) order[p] = p;
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return std::abs(table.derivative[table.index(by, a)]) >
           std::abs(table.derivative[table.index(by, b)]);
  });
  if (options.top > 0 && options.top < order.size()) order.resize(options.top);
  Json quantities = Json::array();
  for (size_t q = 0; q < table.quantities.size(); ++q) {
    quantities.push_back({{"name", table.quantities[q].name},
                          {"unit", table.quantities[q].unit},
                          {"value", number_json(table.value[q])},
                          {"notes", notes_json(table.quantity_notes[q])}});
  }
  const double pressure_mmhg = valve.load().pressure / pa_per_mmhg;
  print(console,
        {{"file", options.file},
         {"pressure_mmHg", pressure_mmhg},
         {"smooth", table.summary.smooth != 0},
         {"stiffness_margin_N_per_m", number_json(table.summary.stiffness_margin)},
         {"quantities", quantities},
         {"parameters", rows_json(table, order)}},
        text("%s: under %g mmHg, %zu parameter%s by influence on %s", options.file.c_str(),
             pressure_mmhg, table.parameters.names.size(),
             table.parameters.names.size() == 1 ? "" : "s", table.quantities[by].label.c_str()) +
            quantity_lines(table) + lines(table, order));
}

}  // namespace

void add_sensitivity(CLI::App &app, Console &console) {
  const auto [command, options] = add_command<SensitivityOptions>(
      app, console, "sensitivity",
      "list what a change of each chord, head, scallop or load does to measures of a closed valve, "
      "by derivatives; two numbers a/b are those of a falling and of a growing parameter",
      run_sensitivity);
  command->add_option("file", options->file, "closed valve at rest, .obj or .h5")->required();
  command
      ->add_option("--of", options->of,
                   "measures, joined by ',': coaptation, orifice, or the name of a measure "
                   "(\"mvs measure --json\" lists them, without unit)")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option(
          "--to", options->to,
          "chords (rest lengths), sites (insertion of each chord, moved along an edge of the "
          "leaflet to the vertex that the row names), heads (positions), scallops "
          "(thickness), pressure, annulus_scale (growth of annulus or ring)")
      ->capture_default_str()
      ->check(one_of(parameter_words()));
  command->add_option(
      "--chord", options->chord,
      "only this chord, with --to chords or sites, as a neochord by its name [all]");
  command->add_option("--sort", options->sort, "measure to sort by [the first]");
  command->add_option("--top", options->top, "print this number of parameters [all]")
      ->check(positive());
}

}  // namespace cli
