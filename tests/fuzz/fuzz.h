// Shared by the fuzz targets. With clang and -DMVS_LIBFUZZER=ON they are libFuzzer targets;
// otherwise programs that run over the files of the folders named as arguments, as a test.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "base/error.h"
#include "formats/formats.h"

// Stops with a sentence unless the condition holds.
inline void demand(bool condition, const char *what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: %s\n", what);
  std::abort();
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#ifndef MVS_LIBFUZZER
int main(int count, char **arguments) {
  size_t files = 0;
  for (int k = 1; k < count; ++k) {
    for (const auto &entry : std::filesystem::directory_iterator(arguments[k])) {
      const std::string text = mvs::core::read_whole_file(entry.path().string());
      LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t *>(text.data()), text.size());
      ++files;
    }
  }
  std::printf("%zu files\n", files);
  return files > 0 ? 0 : 1;
}
#endif
