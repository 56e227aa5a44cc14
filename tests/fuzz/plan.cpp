// Any bytes as a plan and as a journal: an error with a sentence, or steps whose numbers are in
// range and are read again as they were.
#include "formats/plan/plan.h"
#include "formats/file/journal.h"
#include "history/event_limits.h"
#include "tests/fuzz/fuzz.h"

using namespace mvs::core;

namespace {

void check_steps(const std::vector<PlanStep> &steps) {
  for (const PlanStep &step : steps) {
    if (!step.event) continue;
    demand(fault_of(*step.event).empty(), "an event out of range was read");
    if (step.event->kind > RecordedEvent::step) continue;  // the kind of a tool stands elsewhere
    Json again = Json::array();
    again.add(event_json(*step.event));
    demand(read_steps(again)[0].event == step.event, "an event changed on its way through JSON");
  }
}

template <typename Work>
void must_be_clean(Work work) {
  try {
    work();
  } catch (const Error &error) {
    demand(error.code == MVS_E_FORMAT || error.code == MVS_E_VERSION,
           "an error of a kind that a reader does not make");
    demand(error.what()[0] != '\0', "an error without a sentence");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const std::string_view text(reinterpret_cast<const char *>(data), size);
  must_be_clean([&] { check_steps(read_plan(text).steps); });
  must_be_clean([&] {
    for (const std::string &record : read_journal(text).texts) {
      const Json json = Json::parse(record);
      if (json.has("steps")) check_steps(read_steps(json["steps"]));
    }
  });
  return 0;
}
