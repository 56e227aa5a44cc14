// Compressed arrays of VTK XML files: blocks of zlib streams (RFC 1950) behind a header with their
// sizes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace mvs::core {

// Sizes in bytes, from the header of an array: the number of blocks, the size of a whole block,
// that of the last one if it is a part, and the stored size of each.
struct VtpBlocks {
  uint64_t whole = 0, last = 0;
  std::vector<uint64_t> stored;

  uint64_t stored_size() const;
};

// Whether this build reads compressed arrays.
bool has_zlib();

// The bytes of all blocks; `stored` holds them one after the other. Throws MVS_E_FORMAT if a stream
// is damaged or a block has another size than its header states. Memory is bounded by 1,032 times
// the stored bytes, the most that deflate can compress.
std::string inflate_blocks(const VtpBlocks &blocks, std::string_view stored);

}  // namespace mvs::core
