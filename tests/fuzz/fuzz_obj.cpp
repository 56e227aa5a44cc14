// Any bytes as an extended OBJ: a clean error, or a valve that survives writing and reading.
// With clang and -DMVS_LIBFUZZER=ON a libFuzzer target; else a program that runs over the files of
// the folders named as arguments, as a test.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "formats/formats.h"

namespace {

void demand(bool condition, const char *what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_obj: %s\n", what);
  std::abort();
}

void check_round_trip(const mvs::Loaded &loaded) {
  const mvs::ModelPtr model = mvs::make_model(loaded.valve);
  const std::string text = mvs::write_obj(*model, loaded.state);
  const mvs::Loaded again = mvs::read_obj(text);
  const mvs::ModelPtr model_again = mvs::make_model(again.valve);
  demand(mvs::hash_of(*model, loaded.state) == mvs::hash_of(*model_again, again.state),
         "the valve changed on its way through a file");
  demand(mvs::write_obj(*model_again, again.state) == text, "the text changed on its way");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  try {
    check_round_trip(mvs::read_obj(text));
  } catch (const mvs::Error &error) {
    demand(error.code == MVS_E_FORMAT || error.code == MVS_E_VERSION || error.code == MVS_E_OP,
           "an error of a kind that a reader does not make");
    demand(error.what()[0] != '\0', "an error without a sentence");
  }
  return 0;
}

#ifndef MVS_LIBFUZZER
int main(int count, char **arguments) {
  size_t files = 0;
  for (int k = 1; k < count; ++k) {
    for (const auto &entry : std::filesystem::directory_iterator(arguments[k])) {
      const std::string text = mvs::read_whole_file(entry.path().string());
      LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t *>(text.data()), text.size());
      ++files;
    }
  }
  std::printf("%zu files\n", files);
  return files > 0 ? 0 : 1;
}
#endif
