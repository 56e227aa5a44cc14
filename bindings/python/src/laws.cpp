#include "module_parts.h"

#include <mvs/valve.h>

#include "errors.h"

namespace mvs_python {
namespace {

using namespace py::literals;

namespace py = pybind11;

using Get = mvs_result (*)(uint32_t index, mvs_law *law);

// Laws are numbered from 1 in the order of their index.
py::object law_value(Get get, uint32_t count, uint32_t number) {
  if (number == 0 || number > count) {
    refuse(MVS_E_ARGUMENT, "law",
           "law: 1 to " + std::to_string(count) + " are the laws, not " + std::to_string(number));
  }
  auto law = sized<mvs_law>();
  must(get(number - 1, &law));
  const py::module_ values = py::module_::import("mvs.arrays");
  py::list constants;
  for (uint32_t k = 0; k < law.constant_count; ++k) {
    const mvs_law_constant &c = law.constants[k];
    constants.append(values.attr("LawConstant")(c.key, c.unit, c.fallback, c.low, c.high));
  }
  return values.attr("Law")(law.word, law.name, py::tuple(constants));
}

}  // namespace

void bind_laws(py::module_ &module) {
  module.def(
      "leaflet_law",
      [](uint32_t law) {
        return law_value(&mvs_get_leaflet_law, mvs_get_leaflet_law_count(), law);
      },
      "law"_a,
      "The description of a LeafletLaw (mvs.Law): its constants, units, defaults and ranges. "
      "ArgumentError for an unknown law.");
  module.def(
      "chord_law",
      [](uint32_t law) { return law_value(&mvs_get_chord_law, mvs_get_chord_law_count(), law); },
      "law"_a, "The description of a ChordLaw (mvs.Law). ArgumentError for an unknown law.");
}

}  // namespace mvs_python
