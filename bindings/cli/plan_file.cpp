// Reading a plan's file; the library checks what is in it.
#include "plan_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "console.h"
#include "host.h"

namespace cli {

namespace {

// What is wrong with a plan that somebody wrote; "" where the library can look at it. Its valve is
// for people: a plan without one is done on any.
std::string fault_of(const Json &plan) {
  if (!plan.is_object() || plan.value("format", Json()) != "mvs-plan") {
    return "this is no plan: it lacks \"format\": \"mvs-plan\"";
  }
  if (!plan.contains("steps") || !plan["steps"].is_array()) return "\"steps\" has to be a list";
  for (const Json &step : plan["steps"]) {
    if (!step.is_object()) return "each of its \"steps\" has to be an object with a \"do\"";
  }
  if (plan.contains("valve") && !plan["valve"].is_object()) return "\"valve\" has to be an object";
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
    fault = std::string("this is no JSON: ") + error.what();
  }
  if (!fault.empty()) fail(MVS_E_FORMAT, "plan", path + ": " + fault);
  return content.str();
}

}  // namespace cli
