// Near names by edit distance (Levenshtein), without regard to case; a name that begins with the
// unknown one, or with which the unknown one begins, is as near as one edit.
#include "model/part_names.h"

#include <algorithm>
#include <numeric>

namespace mvs::core {
namespace {

constexpr size_t most_near = 8, most_listed = 12;
constexpr size_t farthest = 2;  // edits

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// The least number of inserted, deleted and replaced characters, by rows of the distance table.
size_t edits(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 0; i < a.size(); ++i) {
    size_t diagonal = row[0]++;
    for (size_t k = 0; k < b.size(); ++k) {
      const size_t replaced = lower(a[i]) == lower(b[k]) ? diagonal : diagonal + 1;
      diagonal = row[k + 1];
      row[k + 1] = std::min({replaced, diagonal + 1, row[k] + 1});
    }
  }
  return row.back();
}

bool begins_with(std::string_view text, std::string_view start) {
  return !start.empty() && text.size() >= start.size() &&
         edits(text.substr(0, start.size()), start) == 0;
}

size_t distance(std::string_view unknown, std::string_view name) {
  const size_t exact = edits(unknown, name);
  const bool begins = begins_with(name, unknown) || begins_with(unknown, name);
  return begins ? std::min<size_t>(exact, 1) : exact;
}

// The names at the smallest distance that occurs, in their order; none if that is too far.
std::vector<std::string_view> nearest(std::string_view unknown,
                                      const std::vector<std::string_view> &existing) {
  size_t least = std::min(farthest, std::max<size_t>(1, unknown.size() / 2));
  std::vector<std::string_view> near;
  for (const std::string_view name : existing) {
    const size_t here = distance(unknown, name);
    if (here > least) continue;
    if (here < least) near.clear();
    least = here;
    near.push_back(name);
  }
  return near;
}

std::string listed(const char *start, const std::vector<std::string_view> &names, size_t most) {
  std::string list = start;
  for (size_t k = 0; k < names.size() && k < most; ++k) {
    list.append(k == 0 ? "" : ", ").append(names[k]);
  }
  return list + (names.size() > most ? ", ..." : "");
}

}  // namespace

std::string near_names(std::string_view unknown, const std::vector<std::string_view> &existing) {
  if (existing.empty()) return "; there is no such part";
  // names of parts have at most 63 bytes; a comparison with a long text would take long
  if (existing.size() > most_listed && unknown.size() < 64) {
    const std::vector<std::string_view> near = nearest(unknown, existing);
    if (!near.empty()) return listed("; near: ", near, most_near);
  }
  return listed("; there are ", existing, most_listed);
}

}  // namespace mvs::core
