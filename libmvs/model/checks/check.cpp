// find_faults: runs the groups of checks in the order of their dependencies.
#include "model/checks/check.h"

#include "model/checks/checks.h"

namespace mvs::core {
namespace {

Sheet make_sheet(const Valve &valve) {
  Sheet sheet;
  sheet.sides = sorted_sides(valve.triangles);
  sheet.winding = find_winding(valve.triangles, sheet.sides);
  sheet.is_vertex = vertex_marks(valve.triangles, valve.rest.size());
  return sheet;
}

void check_shape(const Valve &valve, Faults &faults) {
  const size_t before = faults.list.size();
  check_lists(valve, faults);
  if (faults.list.size() > before) return;
  check_places(valve, faults);
  if (faults.list.size() > before) return;
  const Sheet sheet = make_sheet(valve);
  check_sheet(valve, sheet, faults);
  check_annulus(valve, sheet, faults);
  check_chords(valve, sheet, faults);
}

}  // namespace

void Faults::add(const std::string &part, const char *pattern, ...) {
  va_list arguments;
  va_start(arguments, pattern);
  list.push_back({part, vformat(pattern, arguments)});
  va_end(arguments);
}

std::vector<Fault> find_faults(const Valve &valve) {
  Faults faults;
  check_shape(valve, faults);
  check_parts(valve, faults);
  return faults.list;
}

std::vector<Fault> find_faults_beside_mesh(const Valve &valve) {
  Faults faults;
  check_lists(valve, faults);
  check_parts(valve, faults);
  return faults.list;
}

}  // namespace mvs::core
