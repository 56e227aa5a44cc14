// Writes and checks the header of HDF5 files.
#include "formats/hdf5/envelope.h"

#include <algorithm>

#include "base/error.h"
#include "base/hash.h"

namespace mvs::core {
namespace {

// As in PNG: a byte with its high bit set, line ends and a DOS end of file, which a transfer in
// text mode changes.
constexpr std::string_view magic("\x89MVS\r\n\x1a\n", 8);
constexpr std::string_view hdf5_magic("\x89HDF\r\n\x1a\n", 8);
constexpr std::string_view readable_line =
    "A state of libmvs. HDF5 begins at byte 512; formats/FORMAT.md says what is in it.\n";
constexpr size_t version_at = 8, header_at = 12, length_at = 16, checksum_at = 24, text_at = 40;

void put(char *at, uint64_t number, int bytes) {
  for (int k = 0; k < bytes; ++k) at[k] = static_cast<char>(number >> 8 * k);
}

uint64_t get(const char *at, int bytes) {
  uint64_t number = 0;
  for (int k = bytes; k-- > 0;) number = number << 8 | static_cast<unsigned char>(at[k]);
  return number;
}

std::array<uint64_t, 2> checksum_of(std::string_view bytes) {
  Hash hash;
  hash.add(bytes.substr(0, checksum_at));
  hash.add(bytes.substr(text_at));
  return hash.value();
}

// HDF5 searches its signature at byte 0, 512, 1024, 2048, ...
bool is_hdf5(std::string_view bytes) {
  for (size_t at = 0; at < bytes.size(); at = std::max(envelope_bytes, 2 * at)) {
    if (bytes.substr(at).starts_with(hdf5_magic)) return true;
  }
  return false;
}

[[noreturn]] void refuse_foreign(std::string_view bytes) {
  MVS_MUST(!bytes.empty(), MVS_E_FORMAT, "", "the file is empty");
  MVS_MUST(!bytes.starts_with("\x89MVS") && !bytes.starts_with("\tMVS"), MVS_E_FORMAT, "",
           "the file is one of libmvs, but its first bytes were changed, as copying in text mode "
           "does: copy it again, in binary mode");
  MVS_MUST(!is_hdf5(bytes), MVS_E_FORMAT, "",
           "this HDF5 file is not one of libmvs: open it with the program that made it, and bring "
           "the valve as OBJ");
  fail(MVS_E_FORMAT, "", "the file is not an HDF5 file of libmvs: give its format");
}

}  // namespace

void seal(std::string &bytes, uint32_t version) {
  MVS_MUST(bytes.size() >= envelope_bytes, MVS_E_INTERNAL, "", "no room for the envelope");
  std::fill_n(bytes.begin(), envelope_bytes, '\0');
  std::copy(magic.begin(), magic.end(), bytes.begin());
  put(&bytes[version_at], version, 4);
  put(&bytes[header_at], envelope_bytes, 4);
  put(&bytes[length_at], bytes.size() - envelope_bytes, 8);
  std::copy(readable_line.begin(), readable_line.end(), bytes.begin() + text_at);
  const auto checksum = checksum_of(bytes);
  put(&bytes[checksum_at], checksum[0], 8);
  put(&bytes[checksum_at + 8], checksum[1], 8);
}

void check_seal(std::string_view bytes, uint32_t version) {
  if (!bytes.starts_with(magic)) refuse_foreign(bytes);
  MVS_MUST(bytes.size() > envelope_bytes, MVS_E_FORMAT, "",
           "the file was cut after %zu bytes: take the last whole copy", bytes.size());
  const uint64_t stated = get(&bytes[length_at], 8), there = bytes.size() - envelope_bytes;
  MVS_MUST(stated <= there, MVS_E_FORMAT, "",
           "the file was cut: %llu bytes should follow its first 512, %llu do; take the last whole "
           "copy",
           static_cast<unsigned long long>(stated), static_cast<unsigned long long>(there));
  MVS_MUST(stated == there, MVS_E_FORMAT, "",
           "the file is longer than it should be, by %llu bytes: take the last whole copy",
           static_cast<unsigned long long>(there - stated));
  const std::array<uint64_t, 2> stored = {get(&bytes[checksum_at], 8),
                                          get(&bytes[checksum_at + 8], 8)};
  MVS_MUST(stored == checksum_of(bytes), MVS_E_FORMAT, "",
           "the file is damaged, its checksum does not fit: take the last whole copy");
  const auto found = static_cast<uint32_t>(get(&bytes[version_at], 4));
  MVS_MUST(found == version, MVS_E_VERSION, "",
           "the file has version %u, this libmvs reads version %u", found, version);
  MVS_MUST(get(&bytes[header_at], 4) == envelope_bytes, MVS_E_FORMAT, "",
           "the header of the file does not have %zu bytes", envelope_bytes);
}

}  // namespace mvs::core
