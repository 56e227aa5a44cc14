#include "laws.h"

#include <mvs/valve.h>

#include "errors.h"

namespace mvs_python {
namespace {

using namespace py::literals;

namespace py = pybind11;

using Describe = mvs_result (*)(uint32_t law, mvs_law *description);

py::object law_value(Describe describe, uint32_t number) {
  auto law = sized<mvs_law>();
  must(describe(number, &law));
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
      "leaflet_law", [](uint32_t law) { return law_value(&mvs_get_leaflet_law, law); }, "law"_a,
      "The description of a LeafletLaw (mvs.Law): its constants, units, defaults and ranges. "
      "ArgumentError for an unknown law.");
  module.def(
      "chord_law", [](uint32_t law) { return law_value(&mvs_get_chord_law, law); }, "law"_a,
      "The description of a ChordLaw (mvs.Law). ArgumentError for an unknown law.");
}

}  // namespace mvs_python
