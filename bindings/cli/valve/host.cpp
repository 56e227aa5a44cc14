#include "valve/host.h"

#include <cinttypes>
#include <cstdio>
#include <set>
#include <string>

#include "text/command_units.h"

namespace cli {

// A valve that is changed or closed several times is checked each time: a sentence is said once.
void log_to_stderr(void *, mvs_log_level level, const char *text) {
  static std::set<std::string> said;
  if (level > MVS_LOG_WARNING || !said.insert(text).second) return;
  std::fprintf(stderr, "mvs: %s\n", CommandUnits::apply() ? in_command_units(text).c_str() : text);
}

mvs::Simulator make_sim(mvs_sim_desc desc) {
  desc.log = log_to_stderr;
  return mvs::Simulator(desc);
}

mvs::Snapshot load(const std::string &path) {
  mvs::Simulator sim = make_sim();
  sim.load_file(path);
  return sim.snapshot();
}

Size size_of(const mvs::Snapshot &valve) {
  Size size;
  for (const uint8_t kind : valve.view<uint8_t>(MVS_ARRAY_NODE_KIND)) {
    size.vertices += kind == MVS_NODE_KIND_LEAFLET || kind == MVS_NODE_KIND_ANNULUS;
    size.branches += kind == MVS_NODE_KIND_BRANCH;
  }
  size.faces = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES).rows();
  size.chords = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES).rows();
  size.heads = valve.view<uint32_t>(MVS_ARRAY_HEAD_NODES).rows();
  size.annulus = valve.view<uint32_t>(MVS_ARRAY_ANNULUS_NODES).rows();
  return size;
}

mvs::Error error_of(mvs_result code, const std::string &part, const std::string &sentence,
                    int32_t line) {
  mvs_error error = {};
  error.code = code;
  error.line = line;
  std::snprintf(error.part, sizeof error.part, "%s", part.c_str());
  std::snprintf(error.message, sizeof error.message, "%s", sentence.c_str());
  return mvs::Error(error);
}

void fail(mvs_result code, const std::string &part, const std::string &sentence, int32_t line) {
  throw error_of(code, part, sentence, line);
}

std::string hash_of(const mvs::Snapshot &valve) {
  const auto hash = valve.hash();
  char text[33];
  std::snprintf(text, sizeof text, "%016" PRIx64 "%016" PRIx64, hash[0], hash[1]);
  return text;
}

}  // namespace cli
