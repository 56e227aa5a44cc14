// Any bytes as Abaqus input: an error with a sentence, or a valid valve.
#include "model/model.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  try {
    const mvs::core::Imported imported = mvs::core::read_inp(text);
    const mvs::core::ModelPtr model = mvs::core::make_model(imported.loaded.valve);
    demand(model->node_count() == imported.loaded.state.x.size(), "a state of another valve");
  } catch (const mvs::core::Error &error) {
    demand(error.code == MVS_E_FORMAT, "an error of a kind that this reader does not make");
    demand(error.what()[0] != '\0', "an error without a sentence");
  }
  return 0;
}
