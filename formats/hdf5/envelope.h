// The first 512 bytes of our HDF5 files: HDF5 calls them the user block and skips them. They say
// whose file it is, of which version, how long, and with which SHA-256, so that a damaged file is
// refused before HDF5 parses a byte of it: HDF5 itself opens most damaged files without a word, and
// crashes on some.
//
//   0  "\x89MVS\r\n\x1a\n"            24  SHA-256 of bytes 0 to 23 and of all from byte 56
//   8  version, 32 bits               56  a line for people, zeros
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

// Fills the first 512 of `bytes`, which are there for it.
void seal(std::string &bytes, uint32_t version);

// Checks length, checksum and version. Throws MVS_E_FORMAT for a foreign, cut or damaged file,
// MVS_E_VERSION for a whole file of another version.
void check_seal(std::string_view bytes, uint32_t version);

}  // namespace mvs::core
