// Plans and journals of mvs.Snapshot and mvs.Simulator, and what chordae are held against.
#include <mvs/plan.h>
#include <pybind11/stl/filesystem.h>

#include "simulator.h"
#include "values.h"

namespace mvs_python {
namespace {

using Path = std::filesystem::path;

// Author and notes with the struct that points to them.
class PlanOptions {
 public:
  PlanOptions(const std::string &author, const std::string &notes, bool measures) {
    options_.struct_size = sizeof options_;
    options_.measures = measures ? 1 : 0;
    options_.author = whole(author, "author");
    options_.notes = whole(notes, "notes");
  }
  const mvs_plan_options *get() const { return &options_; }

 private:
  // C would end the text at a zero byte and lose the rest.
  static const char *whole(const std::string &text, const char *name) {
    if (text.find('\0') == std::string::npos) return text.c_str();
    refuse(MVS_E_ARGUMENT, name, std::string(name) + ": a text without zero bytes is needed");
  }

  mvs_plan_options options_{};
};

std::string plan(const Snapshot &snapshot, const std::string &author, const std::string &notes,
                 bool measures) {
  const PlanOptions options(author, notes, measures);
  // most plans fit at once: measures, which take long, are then made once
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
  return replay_value(self.replay_plan(text_of(plan), std::move(progress)));
}

py::object check_plan(Simulator &self, const py::object &plan) {
  return replay_value(self.check_plan(text_of(plan)));
}

py::object recover_journal(Simulator &self, const Path &path, py::object progress) {
  return replay_value(self.recover_journal(path.string(), std::move(progress)));
}

py::object limits_of(uint32_t kind) {
  double strain = 0, tension = 0;
  must(mvs_get_chord_limits(kind, &strain, &tension));
  return chord_limits_value(strain, tension);
}

void bind_journal(py::class_<Simulator> &type) {
  type.def(
      "open_journal", [](Simulator &self, const Path &path) { self.open_journal(path.string()); },
      py::arg("path"),
      "Starts a journal of the present valve in a new file: from now on each operation, undo, redo "
      "and checkpoint is on the disk before the call that did it returns. What was done before is "
      "written first. Ends by close_journal, or with the valve. StateError if the file is there "
      "already, IoError if the system refuses.");
  type.def("close_journal", &Simulator::close_journal,
           "Ends the journal; its file stays. StateError if none is open.");
  type.def("recover_journal", &recover_journal, py::arg("path"), py::kw_only(),
           py::arg("progress") = py::none(),
           "Redoes what a journal holds, after a crash, and goes on with it; returns mvs.Replay. "
           "Set or load the valve it was started on first: StateError names its hash if it is "
           "another one. A record that the crash cut short is dropped; FormatError if one is "
           "damaged that others follow.\n\nprogress: as for settle");
}

}  // namespace

void bind_plan_writing(py::class_<Snapshot> &type) {
  type.def("plan", &plan, py::kw_only(), py::arg("author") = "", py::arg("notes") = "",
           py::arg("measures") = false,
           "The plan that led to this snapshot, from the valve as it was set or loaded: JSON text, "
           "SI units, a dictionary by json.loads. formats/FORMAT.md describes it.\n\nauthor, "
           "notes: written into it\nmeasures: with what the valve measured before and after each "
           "operation (takes longer)");
  type.def("save_plan", &save_plan, py::arg("path"), py::kw_only(), py::arg("author") = "",
           py::arg("notes") = "", py::arg("measures") = false,
           "Writes the plan to a file; arguments as for plan. IoError if the system refuses.");
}

void bind_plans(py::module_ &module, py::class_<Simulator> &type) {
  type.def("replay_plan", &replay_plan, py::arg("plan"), py::kw_only(),
           py::arg("progress") = py::none(),
           "Replays a plan from the present valve on, all of it or nothing, and returns "
           "mvs.Replay. On the valve it was made on, the result is the same bit for bit; on "
           "another one parts are found by name and sites by their scallop.\n\nplan: its text, the "
           "path of its file, or the dictionary of json.loads\nprogress: as for settle\n"
           "The error of a step that cannot be done names the step: IdError for a part that is "
           "not there, OpError for what cannot be. FormatError or VersionError for what is no "
           "plan, IoError for a file that cannot be read.");
  type.def("check_plan", &check_plan, py::arg("plan"),
           "Raises what replay_plan would raise for the operations of a plan, and returns "
           "mvs.Replay if there is nothing; settles nothing on the way and changes nothing.");
  bind_journal(type);
  module.def("chord_limits", &limits_of, py::arg("kind"),
             "The range in which chordae of a mvs.ChordKind work (mvs.ChordLimits: strain, and "
             "tension in N); infinite for sutures. Not where they rupture. Sources: "
             "libmvs/measure/README.md.");
}

}  // namespace mvs_python
