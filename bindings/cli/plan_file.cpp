// Reading a plan's file; the library checks what is in it.
#include "plan_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "console.h"
#include "host.h"

namespace cli {

std::string plan_text(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  if (!file || content.fail()) {
    fail(MVS_E_IO, "plan", path + ": cannot be read: " + std::strerror(errno));
  }
  const Json json = Json::parse(content.str(), nullptr, false);
  if (!json.is_object() || json.value("format", "") != "mvs-plan" || !json.contains("valve") ||
      !json["valve"].is_object() || !json.contains("steps") || !json["steps"].is_array()) {
    fail(MVS_E_FORMAT, "plan", path + ": this is no plan of libmvs");
  }
  return content.str();
}

}  // namespace cli
