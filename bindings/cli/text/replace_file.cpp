#include "text/replace_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "valve/host.h"

namespace cli {

void replace_file(const std::string &path, const std::string &bytes, const std::string &part) {
  const std::string beside = path + ".new";
  {
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file << bytes << std::flush;
    if (!file) fail(MVS_E_IO, part, beside + ": cannot be written: " + std::strerror(errno));
  }
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) {
    std::filesystem::remove(beside);
    fail(MVS_E_IO, part, path + ": cannot be replaced: " + error.message());
  }
}

}  // namespace cli
