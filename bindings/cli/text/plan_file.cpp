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

bool is_text(const Json &object, const char *key) {
  return !object.contains(key) || object[key].is_string();
}

// An error sentence for a step whose structure is wrong, else "".
std::string fault_of_step(const Json &step) {
  if (!step.is_object() || !step.contains("do") || !step["do"].is_string()) {
    return "each of its \"steps\" must be an object with a \"do\"";
  }
  for (const char *key : {"title", "group"}) {
    if (!is_text(step, key)) return text("\"%s\" of a step must be a text", key);
  }
  return "";
}

// An error sentence for a plan whose structure is wrong, else "": the library checks the contents.
// "valve" is optional; a plan without it can be applied to any valve.
std::string fault_of(const Json &plan) {
  if (!plan.is_object() || plan.value("format", Json()) != "mvs-plan") {
    return std::string("is no plan: it lacks \"format\": \"mvs-plan\"") + origin;
  }
  if (!plan.contains("steps") || !plan["steps"].is_array()) return "\"steps\" must be a list";
  for (const Json &step : plan["steps"]) {
    std::string fault = fault_of_step(step);
    if (!fault.empty()) return fault;
  }
  if (plan.contains("valve") && !plan["valve"].is_object()) return "\"valve\" must be an object";
  for (const char *key : {"author", "notes"}) {
    if (!is_text(plan, key)) return text("\"%s\" must be a text", key);
  }
  return "";
}

// The same for the text of a file.
std::string fault_of_text(const std::string &content) {
  std::string fault;
  const Json plan = parse_json(content, fault);
  return fault.empty() ? fault_of(plan) : "is no plan: " + fault + origin;
}

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
  const std::string fault = fault_of_text(content);
  if (!fault.empty()) fail(MVS_E_FORMAT, "plan", path + ": " + fault);
  return content;
}

}  // namespace cli
