// Sets and references to them: numbers, ranges, sets of sets, "instance.set".
#include "formats/abaqus/sets.h"

#include "formats/text/line.h"

namespace mvs::core {
namespace {

using Numbers = std::map<uint64_t, uint32_t>;

// Upper limit of a range, against typing errors.
constexpr uint64_t longest_range = uint64_t{1} << 24;

// Removes "instance." from a name; returns whether it was there.
bool strip_instance(std::string &label, const InpMesh &mesh) {
  const size_t dot = label.rfind('.');
  if (dot == std::string::npos || dot == 0) return false;
  const std::string instance = label.substr(0, dot);
  if (instance != mesh.instance && instance != mesh.part) return false;
  label = label.substr(dot + 1);
  return true;
}

// The noun for an item of a list, for error messages.
struct Kind {
  const char *thing;
  const Numbers &numbers;
  const InpSets &sets;
  const std::set<uint64_t> *skipped;

  // A set names each part of the file once, or a few times where its ranges overlap.
  size_t most_named() const {
    return 10 * (numbers.size() + (skipped ? skipped->size() : 0)) + 1000;
  }
};

std::vector<uint32_t> named(std::string_view word, int32_t line, const InpMesh &mesh,
                            const Kind &kind) {
  std::string label = inp_label(word);
  uint64_t number = 0;
  if (const InpSet *set = mesh.find_set(kind.sets, word)) return set->items;
  strip_instance(label, mesh);
  if (!parse_whole(label, number)) {
    inp_fail(line, "the file has no set of %ss %s", kind.thing, quoted(word).c_str());
  }
  if (kind.skipped && kind.skipped->contains(number)) return {};
  const auto place = kind.numbers.find(number);
  if (place == kind.numbers.end()) {
    inp_fail(line, "%s %llu is not in the file", kind.thing,
             static_cast<unsigned long long>(number));
  }
  return {place->second};
}

Kind node_kind(const InpMesh &mesh) {
  return {"node", mesh.node_of, mesh.node_sets, nullptr};
}
Kind element_kind(const InpMesh &mesh) {
  return {"element", mesh.element_of, mesh.element_sets, &mesh.skipped};
}

void check_named(size_t named_so_far, int32_t line, const Kind &kind) {
  if (named_so_far <= kind.most_named()) return;
  inp_fail(line, "the set names more than ten times the %ss of the file: name each once",
           kind.thing);
}

// Reads a range (first, last, step); every number of it has to exist.
void add_range(InpRow row, const InpMesh &mesh, const Kind &kind, size_t &named_so_far,
               std::vector<uint32_t> &items) {
  const uint64_t first = row.whole("the first number of a range");
  const uint64_t last = row.whole("the last number of a range");
  const std::string_view word = row.word();
  uint64_t step = 1;
  if (!word.empty() && (!parse_whole(word, step) || step == 0)) {
    inp_fail(row.line(), "%s is not a step of a range", quoted(word).c_str());
  }
  if (last < first || last - first > longest_range || (last - first) % step != 0) {
    inp_fail(row.line(), "from %llu to %llu in steps of %llu is not a range",
             static_cast<unsigned long long>(first), static_cast<unsigned long long>(last),
             static_cast<unsigned long long>(step));
  }
  for (uint64_t number = first; number <= last; number += step) {
    check_named(++named_so_far, row.line(), kind);
    const std::vector<uint32_t> found = named(std::to_string(number), row.line(), mesh, kind);
    items.insert(items.end(), found.begin(), found.end());
    if (last - number < step) break;
  }
}

// *NSET, ELSET=...: the nodes of a set of elements.
void add_nodes_of(InpCard &card, const InpMesh &mesh, std::vector<uint32_t> &items) {
  const auto elements = card.take("ELSET");
  if (!elements) return;
  for (const uint32_t e : mesh.named_elements(*elements, card.line)) {
    const std::vector<uint32_t> &nodes = mesh.elements[e].nodes;
    items.insert(items.end(), nodes.begin(), nodes.end());
  }
}

void read_set(InpCard &card, const char *key, const std::string &level, const InpMesh &mesh,
              const Kind &kind, InpSets &into) {
  card.used = true;
  card.need(key);
  for (const char *plain : {"INTERNAL", "INSTANCE", "UNSORTED"}) card.take(plain);
  const std::string_view name = *card.take(key);
  const bool generate = card.take("GENERATE").has_value();
  std::vector<uint32_t> items;
  size_t named_so_far = 0;
  if (card.is("NSET")) add_nodes_of(card, mesh, items);
  for (size_t k = 0; k < card.data.size(); ++k) {
    InpRow row = card.row(k);
    if (generate) {
      add_range(row, mesh, kind, named_so_far, items);
      continue;
    }
    while (!row.at_end()) {
      const std::string_view word = row.word();
      if (word.empty()) continue;
      const std::vector<uint32_t> found = named(word, row.line(), mesh, kind);
      items.insert(items.end(), found.begin(), found.end());
      check_named(named_so_far += found.size() + 1, row.line(), kind);
    }
  }
  add_to_inp_set(into, level, name, card.line, items);
}

}  // namespace

void add_to_inp_set(InpSets &sets, const std::string &level, std::string_view name, int32_t line,
                    const std::vector<uint32_t> &items) {
  InpSet &set = sets[level + inp_label(name)];
  if (set.line == 0) {
    set.name = std::string(name);
    std::erase(set.name, '"');
    set.line = line;
  }
  for (const uint32_t item : items) {
    if (set.members.insert(item).second) set.items.push_back(item);
  }
}

void read_inp_sets(std::vector<InpCard> &cards, InpMesh &mesh) {
  std::string level;
  for (InpCard &card : cards) {
    if (card.is("ASSEMBLY")) level = "@";
    if (card.is("INSTANCE")) level = "";
    if (card.is("END INSTANCE")) level = "@";
    if (card.is("END ASSEMBLY")) level = "";
    if (card.is("NSET")) {
      read_set(card, "NSET", level, mesh, node_kind(mesh), mesh.node_sets);
    } else if (card.is("ELSET")) {
      read_set(card, "ELSET", level, mesh, element_kind(mesh), mesh.element_sets);
    }
  }
}

// Without an instance, a set of the assembly has precedence.
const InpSet *InpMesh::find_set(const InpSets &sets, std::string_view word) const {
  std::string label = inp_label(word);
  if (!strip_instance(label, *this)) {
    if (const auto found = sets.find("@" + label); found != sets.end()) return &found->second;
  }
  const auto found = sets.find(label);
  return found == sets.end() ? nullptr : &found->second;
}

std::vector<uint32_t> InpMesh::named_nodes(std::string_view word, int32_t line) const {
  return named(word, line, *this, node_kind(*this));
}

std::vector<uint32_t> InpMesh::named_elements(std::string_view word, int32_t line) const {
  return named(word, line, *this, element_kind(*this));
}

}  // namespace mvs::core
