// Inflates block by block into memory of the stated size.
#include "formats/surface/vtp_blocks.h"

#ifdef MVS_HAVE_ZLIB
#include <zlib.h>
#endif

#include "base/error.h"

namespace mvs::core {

uint64_t VtpBlocks::stored_size() const {
  uint64_t sum = 0;
  for (const uint64_t size : stored) sum += size;
  return sum;
}

#ifdef MVS_HAVE_ZLIB

namespace {

// Deflate codes at most 258 bytes by two bits.
constexpr uint64_t most_ratio = 1032;

void inflate_block(std::string_view stored, uint64_t size, std::string &out) {
  const size_t start = out.size();
  out.resize(start + size);
  uLongf length = size;
  const int result = uncompress(reinterpret_cast<Bytef *>(out.data() + start), &length,
                                reinterpret_cast<const Bytef *>(stored.data()), stored.size());
  MVS_MUST(result != Z_MEM_ERROR, MVS_E_MEMORY, "", "there is no memory for %llu bytes",
           static_cast<unsigned long long>(size));
  MVS_MUST(result == Z_OK && length == size, MVS_E_FORMAT, "",
           "a compressed block is damaged or has another size than the %llu bytes that its header "
           "states",
           static_cast<unsigned long long>(size));
}

}  // namespace

bool has_zlib() {
  return true;
}

std::string inflate_blocks(const VtpBlocks &blocks, std::string_view stored) {
  std::string out;
  size_t at = 0;
  for (size_t k = 0; k < blocks.stored.size(); ++k) {
    const bool is_part = k + 1 == blocks.stored.size() && blocks.last > 0;
    const uint64_t size = is_part ? blocks.last : blocks.whole;
    const uint64_t length = blocks.stored[k];
    MVS_MUST(length <= stored.size() - at && size / most_ratio <= length, MVS_E_FORMAT, "",
             "a block of %llu bytes cannot come from %llu compressed ones",
             static_cast<unsigned long long>(size), static_cast<unsigned long long>(length));
    inflate_block(stored.substr(at, length), size, out);
    at += length;
  }
  return out;
}

#else

bool has_zlib() {
  return false;
}

std::string inflate_blocks(const VtpBlocks &, std::string_view) {
  throw Error(MVS_E_UNSUPPORTED, "compressor", "this libmvs was built without zlib");
}

#endif

}  // namespace mvs::core
