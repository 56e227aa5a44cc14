#include "text/plan_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "text/console.h"
#include "valve/host.h"

namespace cli {
namespace {

// An error sentence for a plan whose structure is wrong, else "": the library checks the contents.
// "valve" is optional; a plan without it can be applied to any valve.
std::string fault_of(const Json &plan) {
  if (!plan.is_object() || plan.value("format", Json()) != "mvs-plan") {
    return "not a plan: it lacks \"format\": \"mvs-plan\"";
  }
  if (!plan.contains("steps") || !plan["steps"].is_array()) return "\"steps\" must be a list";
  for (const Json &step : plan["steps"]) {
    if (!step.is_object()) return "each of its \"steps\" must be an object with a \"do\"";
  }
  if (plan.contains("valve") && !plan["valve"].is_object()) return "\"valve\" must be an object";
  return "";
}

}  // namespace

std::string plan_text(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream content;
  content << file.rdbuf();
  if (!file || content.fail()) {
    fail(MVS_E_IO, "plan", path + ": cannot be read: " + std::strerror(errno));
  }
  std::string fault;
  try {
    fault = fault_of(Json::parse(content.str()));
  } catch (const Json::exception &error) {
    fault = std::string("not JSON: ") + error.what();
  }
  if (!fault.empty()) fail(MVS_E_FORMAT, "plan", path + ": " + fault);
  return content.str();
}

}  // namespace cli
