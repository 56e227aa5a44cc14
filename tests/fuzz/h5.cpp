// Any bytes as an HDF5 file of libmvs: a clean error, or a tree and a session that survive writing
// and reading. Every change is caught by the checksum, so the bytes are tried a second time under a
// valid one: that models a file made with intent, and exercises the checks before HDF5 reads it.
#include "tests/fuzz/fuzz.h"

#include "formats/hdf5/tree.h"
#include "formats/session/layout.h"

namespace {

constexpr uint32_t version = mvs::core::session_version;

void check_round_trip(const mvs::core::H5Tree &tree) {
  const std::string bytes = mvs::core::write_h5(tree, version);
  const mvs::core::H5Tree again = mvs::core::read_h5(bytes, "mvs", version);
  demand(again.arrays.size() == tree.arrays.size(), "arrays were lost on their way");
  demand(mvs::core::write_h5(again, version) == bytes, "the bytes changed on their way");
}

void try_bytes(std::string_view bytes) {
  try {
    check_round_trip(mvs::core::read_h5(bytes, "mvs", version));
    const std::string again = mvs::core::write_session(mvs::core::read_session(bytes), {});
    demand(mvs::core::write_session(mvs::core::read_session(again), {}) == again,
           "a session changed");
  } catch (const mvs::core::Error &error) {
    demand(error.code == MVS_E_FORMAT || error.code == MVS_E_VERSION ||
               error.code == MVS_E_MEMORY || error.code == MVS_E_OP,
           "an error of a kind that a reader does not make");
    demand(error.what()[0] != '\0', "an error without a sentence");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  std::string bytes(reinterpret_cast<const char *>(data), size);
  try_bytes(bytes);
  if (size < mvs::core::envelope_bytes) return 0;
  mvs::core::seal(bytes, version);
  try_bytes(bytes);
  return 0;
}
