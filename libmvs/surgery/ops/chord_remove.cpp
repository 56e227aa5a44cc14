// Operation chord_remove: removes a chord and the segments that depend on it.
#include "base/error.h"
#include "surgery/surgery.h"

namespace mvs::core {

void operate(Surgery &s, const mvs_op_chord_remove &op) {
  const uint32_t index = chord_of(s, op.chord);
  const std::string name = s.valve.chords.get()[index].name;
  const size_t before = s.valve.chords.size();
  s.valve.chords.erase(s.valve.chords.begin() + index);
  prune_chords(s);
  const size_t with_it = before - s.valve.chords.size() - 1;
  s.title = "Remove chord " + name;
  if (with_it > 0) s.title += format(" and %zu segments that depend on it", with_it);
}

}  // namespace mvs::core
