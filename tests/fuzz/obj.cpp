// Any bytes as an extended OBJ: a clean error, or a valve that survives writing and reading.
#include "tests/fuzz/fuzz.h"

namespace {

void check_round_trip(const mvs::core::Loaded &loaded) {
  const mvs::core::ModelPtr model = mvs::core::make_model(loaded.valve);
  const std::string text = mvs::core::write_obj(*model, loaded.state);
  const mvs::core::Loaded again = mvs::core::read_obj(text);
  const mvs::core::ModelPtr model_again = mvs::core::make_model(again.valve);
  demand(mvs::core::hash_of(*model, loaded.state) == mvs::core::hash_of(*model_again, again.state),
         "the valve changed on its way through a file");
  demand(mvs::core::write_obj(*model_again, again.state) == text, "the text changed on its way");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  try {
    check_round_trip(mvs::core::read_obj(text));
  } catch (const mvs::core::Error &error) {
    demand(error.code == MVS_E_FORMAT || error.code == MVS_E_VERSION || error.code == MVS_E_OP,
           "an error of a kind that a reader does not make");
    demand(error.what()[0] != '\0', "an error without a sentence");
  }
  return 0;
}
