#include "valve/chords.h"

#include <algorithm>

namespace cli {
namespace {

// Indexed by MVS_CHORD_KIND_*.
constexpr const char *kinds[] = {"other", "marginal",    "rough zone", "strut",
                                 "basal", "commissural", "trunk",      "suture"};

std::vector<std::string> flags_of(uint32_t bits, double tension) {
  std::vector<std::string> flags;
  if (bits & MVS_CHORD_FLAG_OVER_STRAIN) flags.emplace_back("over strain");
  if (bits & MVS_CHORD_FLAG_OVER_TENSION) flags.emplace_back("over tension");
  if (tension == 0) flags.emplace_back("slack");
  return flags;
}

// Compares numbers in names by their value: A2/7 before A2/17.
bool counts_before(const std::string &a, const std::string &b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  size_t i = 0, k = 0;
  while (i < a.size() && k < b.size()) {
    if (!is_digit(a[i]) || !is_digit(b[k])) {
      if (a[i] != b[k]) return a[i] < b[k];
      ++i, ++k;
      continue;
    }
    const size_t i0 = std::min(a.find_first_not_of('0', i), a.size());
    const size_t k0 = std::min(b.find_first_not_of('0', k), b.size());
    for (i = i0; i < a.size() && is_digit(a[i]);) ++i;
    for (k = k0; k < b.size() && is_digit(b[k]);) ++k;
    if (i - i0 != k - k0) return i - i0 < k - k0;
    const int order = a.compare(i0, i - i0, b, k0, k - k0);
    if (order != 0) return order < 0;
  }
  return a.size() - i < b.size() - k;
}

}  // namespace

const char *chord_kind_name(uint32_t kind) {
  return kind < std::size(kinds) ? kinds[kind] : "unknown";
}

std::vector<ChordRow> chord_table(const mvs::Snapshot &valve) {
  const uint32_t count = static_cast<uint32_t>(valve.parts(MVS_PART_CHORD).size());
  std::vector<ChordRow> rows;
  for (uint32_t c = 0; c < count; ++c) {
    const mvs_chord_info chord = valve.chord(c);
    rows.push_back({chord.name, chord_kind_name(chord.kind), chord.heads, chord.scallops,
                    chord.length, chord.rest_length, chord.strain, chord.tension,
                    flags_of(chord.flags, chord.tension)});
  }
  return rows;
}

std::vector<std::string> chord_orders() {
  return {"tension", "strain", "name", "length"};
}

void sort_chords(std::vector<ChordRow> &rows, const std::string &order) {
  const auto sort_by = [&rows](auto before) { std::stable_sort(rows.begin(), rows.end(), before); };
  using Row = const ChordRow &;
  if (order == "tension") sort_by([](Row a, Row b) { return a.tension > b.tension; });
  if (order == "strain") sort_by([](Row a, Row b) { return a.strain > b.strain; });
  if (order == "name") sort_by([](Row a, Row b) { return counts_before(a.name, b.name); });
  if (order == "length") sort_by([](Row a, Row b) { return a.length > b.length; });
}

}  // namespace cli
