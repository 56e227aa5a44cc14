#include "text/plan_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "text/console.h"
#include "text/json_text.h"
#include "valve/host.h"

namespace cli {
namespace {

constexpr const char *origin = " (mvs repair --save-plan writes a plan)";

std::string read_file(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  // a folder opens, but cannot be read; an empty file sets no bit of `file`
  if (!file || (file.peek() == EOF && file.bad())) {
    fail(MVS_E_IO, "plan", path + ": cannot be read: " + std::strerror(errno));
  }
  file.clear();
  content << file.rdbuf();
  return content.str();
}

}  // namespace

std::string plan_text(const std::string &path) {
  std::string content = read_file(path);
  std::string fault;
  parse_json(content, fault);
  if (!fault.empty()) fail(MVS_E_FORMAT, "plan", path + ": is no plan: " + fault + origin);
  try {
    mvs::check_plan(content);
  } catch (const mvs::Error &error) {
    fail(error.code(), error.part(), path + ": " + error.what(), error.line());
  }
  return content;
}

}  // namespace cli
