// Reading a plan's file; the library checks what is in it.
#include "plan_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "console.h"
#include "host.h"

namespace cli {
namespace {

[[noreturn]] void refuse(mvs_result code, const std::string &path, const std::string &why) {
  mvs_error error = {};
  error.code = code;
  std::snprintf(error.part, sizeof error.part, "%s", "plan");
  std::snprintf(error.message, sizeof error.message, "%s: %s", path.c_str(), why.c_str());
  throw mvs::Error(error);
}

}  // namespace

std::string plan_text(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  if (!file || content.fail()) {
    refuse(MVS_E_IO, path, std::string("cannot be read: ") + std::strerror(errno));
  }
  const Json json = Json::parse(content.str(), nullptr, false);
  if (!json.is_object() || json.value("format", "") != "mvs-plan" || !json.contains("valve") ||
      !json["valve"].is_object() || !json.contains("steps") || !json["steps"].is_array()) {
    refuse(MVS_E_FORMAT, path, "this is no plan of libmvs");
  }
  return content.str();
}

}  // namespace cli
