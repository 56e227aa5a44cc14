// Any bytes as a script of operations, tools, undo, redo, settle, step, save and load, checkpoints:
// every call succeeds or leaves all bits unchanged, undo and redo are exact, undoing everything
// gives the first valve, no move produces NaN or makes triangles or tools cross, and the plan of
// the script leads to the same bits. Without libFuzzer: `fuzz_ops SCRIPTS [FIRST]` runs that many
// random scripts from number FIRST on.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <vector>

#include "tests/fuzz/op_script.h"
#include "tests/short_run.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz::run_op_script(data, size);
  return 0;
}

#ifndef MVS_LIBFUZZER
namespace {

// The k-th argument.
int number(int argc, char **argv, int k, int otherwise) {
  return argc > k ? static_cast<int>(std::strtol(argv[k], nullptr, 10)) : otherwise;
}

int run_scripts(int argc, char **argv) {
  const char *lengthy = std::getenv("MVS_TEST_LONG");
  const int given = number(argc, argv, 1, 100), first = number(argc, argv, 2, 0);
  const int scripts = lengthy && *lengthy ? 10000 : short_run() ? (given + 3) / 4 : given;
  for (int seed = first; seed < first + scripts; ++seed) {
    std::mt19937 random(static_cast<uint32_t>(seed));
    std::vector<uint8_t> bytes(600);
    for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(random());
    std::fprintf(stderr, "\rscript %d", seed);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::fprintf(stderr, "\r%d scripts, every hash as it has to be\n", scripts);
  return 0;
}

}  // namespace

int main(int argc, char **argv) {
  try {
    return run_scripts(argc, argv);
  } catch (const std::exception &error) {
    std::fprintf(stderr, "\n%s\n", error.what());
    return 1;
  }
}
#endif
