// Plans and journals of mvs.Snapshot and mvs.Simulator, and the limits of chordae.
#include <mvs/plan.h>
#include <pybind11/stl/filesystem.h>

#include "simulator.h"
#include "values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Path = std::filesystem::path;

// mvs_plan_options that point to the given author and notes.
class PlanOptions {
 public:
  PlanOptions(const std::string &author, const std::string &notes, bool measures) {
    options_.measures = measures ? 1 : 0;
    options_.author = c_text(author, "author");
    options_.notes = c_text(notes, "notes");
  }
  const mvs_plan_options *get() const { return &options_; }

 private:
  mvs_plan_options options_ = sized<mvs_plan_options>();
};

std::string plan(const Snapshot &snapshot, const std::string &author, const std::string &notes,
                 bool measures) {
  const PlanOptions options(author, notes, measures);
  // most plans fit into the first buffer; measures, which take long, are then computed once
  std::string text(1 << 16, '\0');
  uint64_t size = 0;
  const auto write = [&] {
    return mvs_write_plan(snapshot.get(), options.get(), text.data(), text.size(), &size);
  };
  release_and(write);
  const bool whole = size <= text.size();
  text.resize(size);
  if (!whole) release_and(write);
  return text;
}

void save_plan(const Snapshot &snapshot, const Path &path, const std::string &author,
               const std::string &notes, bool measures) {
  const PlanOptions options(author, notes, measures);
  const std::string name = path.string();
  release_and([&] { return mvs_save_plan(snapshot.get(), options.get(), name.c_str()); });
}

std::string text_of(const py::object &plan) {
  return py::module_::import("mvs.plans").attr("text_of")(plan).cast<std::string>();
}

py::object replay_plan(Simulator &self, const py::object &plan, py::object progress) {
  const std::string text = text_of(plan);
  auto replay = sized<mvs_replay>();
  self.call_with(std::move(progress), [&](mvs_sim *sim) {
    return mvs_replay_plan(sim, text.data(), text.size(), &replay);
  });
  return replay_value(replay);
}

py::object check_plan(Simulator &self, const py::object &plan) {
  const std::string text = text_of(plan);
  return replay_value(filled<mvs_replay>(self, [&](mvs_sim *sim, mvs_replay *replay) {
    return mvs_check_plan(sim, text.data(), text.size(), replay);
  }));
}

py::object recover_journal(Simulator &self, const Path &path, py::object progress) {
  const std::string name = path.string();
  auto replay = sized<mvs_replay>();
  self.call_with(std::move(progress),
                 [&](mvs_sim *sim) { return mvs_recover_journal(sim, name.c_str(), &replay); });
  return replay_value(replay);
}

py::object limits_of(uint32_t kind) {
  double strain = 0, tension = 0;
  must(mvs_get_chord_limits(kind, &strain, &tension));
  return chord_limits_value(strain, tension);
}

void bind_journal(py::class_<Simulator> &type) {
  type.def(
      "open_journal",
      [](Simulator &self, const Path &path) { text_call<mvs_open_journal>(self, path.string()); },
      "path"_a,
      "Starts a journal of the present valve in a new file: every operation, undo, redo and "
      "checkpoint is on the disk before its call returns. The history so far is written first. "
      "close_journal, or another valve, ends the journal. StateError if the file exists, IoError "
      "if it cannot be written.");
  type.def("close_journal", &plain_call<mvs_close_journal>,
           "Ends the journal; its file stays. StateError without an open journal.");
  type.def("recover_journal", &recover_journal, "path"_a, py::kw_only(), "progress"_a = py::none(),
           "Replays a journal after a crash and continues it; returns mvs.Replay. Set or load its "
           "first valve before: StateError names the hash of that valve. A truncated last record "
           "is dropped; FormatError if an earlier record is damaged.\n\nprogress: as for settle");
}

}  // namespace

void bind_plan_writing(py::class_<Snapshot> &type) {
  type.def("plan", &plan, py::kw_only(), "author"_a = "", "notes"_a = "", "measures"_a = false,
           "The plan from the valve as set or loaded to this snapshot: JSON text in SI units, "
           "described in formats/FORMAT.md.\n\nauthor, notes: texts for the plan\nmeasures: add "
           "the measures before and after each operation (takes longer)");
  type.def("save_plan", &save_plan, "path"_a, py::kw_only(), "author"_a = "", "notes"_a = "",
           "measures"_a = false,
           "Writes the plan to a file; arguments as for plan. IoError if it cannot be written.");
}

void bind_plans(py::module_ &module, py::class_<Simulator> &type) {
  type.def("replay_plan", &replay_plan, "plan"_a, py::kw_only(), "progress"_a = py::none(),
           "Replays a plan on the present valve and returns mvs.Replay; applies all steps or none. "
           "On the valve of the plan the result is the same bit for bit; on another valve parts "
           "are found by name and sites by their scallop.\n\nplan: its text, the path of its file, "
           "or the dictionary of json.loads\nprogress: as for settle\nErrors name the failing "
           "step. IdError: unknown part. OpError: impossible operation. FormatError, VersionError: "
           "not a plan. IoError: the file cannot be read.");
  type.def("check_plan", &check_plan, "plan"_a,
           "Raises the exception that replay_plan would raise for the operations of a plan, else "
           "returns mvs.Replay; does not settle and changes nothing.");
  bind_journal(type);
  module.def(
      "chord_limits", &limits_of, "kind"_a,
      "The working range of chordae of a mvs.ChordKind (mvs.ChordLimits: strain, and tension in "
      "N), below rupture; infinite for sutures. Sources: libmvs/measure/DEFINITIONS.md.");
}

}  // namespace mvs_python
