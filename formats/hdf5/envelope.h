// The header of our HDF5 files: 512 bytes that HDF5 skips as its user block. It holds the name of
// the format, the version, the length and a checksum, so that a damaged file is refused before HDF5
// parses a byte: HDF5 opens most damaged files without an error, and crashes on some.
//
//   0  "\x89MVS\r\n\x1a\n"            24  checksum of bytes 0 to 23 and of all from byte 40
//   8  version, 32 bits               40  a readable line, zeros
//  12  512, 32 bits                  512  HDF5
//  16  bytes after 512, 64 bits            numbers are little-endian
//
// A later version keeps this layout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mvs::core {

inline constexpr size_t envelope_bytes = 512;

// Fills the first 512 of `bytes`, which the caller reserved.
void seal(std::string &bytes, uint32_t version);

// Checks length, checksum and version. Throws MVS_E_FORMAT for a foreign, cut or damaged file,
// MVS_E_VERSION for a whole file of another version.
void check_seal(std::string_view bytes, uint32_t version);

}  // namespace mvs::core
