// mvs.Snapshot: its arrays, parts, history and files.
#include "snapshot.h"

#include <mvs/file.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "ensemble.h"
#include "sensitivity.h"
#include "values.h"
#include "views.h"

namespace mvs_python {
namespace {

using namespace py::literals;

py::array view(const py::object &self, uint32_t which) {
  const Snapshot &snapshot = self.cast<const Snapshot &>();
  mvs_view found{};
  release_and([&] { return mvs_snapshot_get_array(snapshot.get(), which, &found); });
  return array_of(found, self);
}

std::string hash(const Snapshot &snapshot) {
  uint64_t bits[2];
  release_and([&] { return mvs_snapshot_get_hash(snapshot.get(), bits); });
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(bits[0]),
                static_cast<unsigned long long>(bits[1]));
  return text;
}

py::object load_case(const Snapshot &snapshot) {
  auto load = sized<mvs_load_case>();
  must(mvs_snapshot_get_load(snapshot.get(), &load));
  return load_value(load);
}

py::tuple parts(const Snapshot &snapshot) {
  py::list all;
  for (uint32_t kind = MVS_PART_LEAFLET; kind <= MVS_PART_CURVE; ++kind) {
    uint32_t count = 0;
    must(mvs_snapshot_get_part_count(snapshot.get(), kind, &count));
    for (uint32_t index = 0; index < count; ++index) {
      mvs_part part{};
      must(mvs_snapshot_get_part(snapshot.get(), kind, index, &part));
      all.append(part_value(part));
    }
  }
  return py::tuple(all);
}

py::object find(const Snapshot &snapshot, uint32_t kind, const std::string &name) {
  mvs_part part{};
  must(mvs_snapshot_find_part(snapshot.get(), kind, c_text(name, "name"), &part));
  return part_value(part);
}

py::tuple tools(const Snapshot &snapshot) {
  uint32_t count = 0;
  must(mvs_snapshot_get_tool_count(snapshot.get(), &count));
  py::tuple found(count);
  for (uint32_t k = 0; k < count; ++k) {
    auto state = sized<mvs_tool_state>();
    must(mvs_snapshot_get_tool(snapshot.get(), k, &state));
    found[k] = tool_value(state);
  }
  return found;
}

py::tuple tool_bodies(const Snapshot &snapshot, uint32_t index) {
  auto state = sized<mvs_tool_state>();
  must(mvs_snapshot_get_tool(snapshot.get(), index, &state));
  py::tuple found(state.body_count);
  for (uint32_t k = 0; k < state.body_count; ++k) {
    auto body = sized<mvs_tool_body>();
    must(mvs_snapshot_get_tool_body(snapshot.get(), index, k, &body));
    found[k] = tool_body_value(body);
  }
  return found;
}

py::tuple history(const Snapshot &snapshot) {
  auto size = sized<mvs_history>();
  must(mvs_snapshot_get_history(snapshot.get(), &size));
  py::list entries;
  for (uint32_t k = 0; k < size.done + size.undone; ++k) {
    auto entry = sized<mvs_history_entry>();
    must(mvs_snapshot_get_history_entry(snapshot.get(), k, &entry));
    entries.append(history_value(entry, k < size.done));
  }
  return py::tuple(entries);
}

py::tuple checkpoints(const Snapshot &snapshot) {
  mvs_history size{};
  size.struct_size = sizeof size;
  must(mvs_snapshot_get_history(snapshot.get(), &size));
  py::list names;
  for (uint32_t k = 0; k < size.checkpoints; ++k) {
    const char *name = nullptr;
    must(mvs_snapshot_get_checkpoint(snapshot.get(), k, &name));
    names.append(name);
  }
  return py::tuple(names);
}

void save(const Snapshot &snapshot, const std::filesystem::path &path, const std::string &format) {
  const uint32_t chosen = format_of(format);
  const std::string name = path.string();
  release_and([&] { return mvs_save_file(snapshot.get(), name.c_str(), chosen); });
}

py::bytes to_bytes(const Snapshot &snapshot, const std::string &format) {
  const uint32_t chosen = format_of(format);
  uint64_t size = 0;
  std::string bytes;
  const auto write = [&] {
    return mvs_save_memory(snapshot.get(), chosen, bytes.data(), bytes.size(), &size);
  };
  release_and(write);
  bytes.resize(size);
  release_and(write);
  return py::bytes(bytes);
}

std::string text(const Snapshot &snapshot) {
  return std::string("<mvs.Snapshot \"") + mvs_snapshot_get_name(snapshot.get()) + "\" " +
         hash(snapshot) + ">";
}

}  // namespace

uint32_t format_of(const std::string &name) {
  if (name == "auto") return MVS_FORMAT_AUTO;
  if (name == "obj") return MVS_FORMAT_OBJ;
  if (name == "vtp") return MVS_FORMAT_VTP;
  if (name == "h5") return MVS_FORMAT_H5;
  if (name == "inp") return MVS_FORMAT_INP;
  if (name == "feb") return MVS_FORMAT_FEB;
  if (name == "vtm") return MVS_FORMAT_VTM;
  refuse(
      MVS_E_ARGUMENT, "format",
      "format: \"auto\", \"obj\", \"h5\", \"vtp\", \"vtm\", \"inp\" or \"feb\" is needed, not \"" +
          name + "\"");
}

void bind_snapshot(py::module_ &module) {
  py::class_<Snapshot> type(
      module, "Snapshot",
      "An immutable valve with its state.\n\nIts arrays are read-only and zero-copy; each keeps "
      "the snapshot alive, and a snapshot outlives its simulator. Any thread may use it. Ctrl-C "
      "stops "
      "ensemble, and cost while it opens the valve; other calls end first.");
  for (const View &entry : views) {
    const uint32_t which = entry.which;
    type.def_property_readonly(
        entry.name, [which](const py::object &self) { return view(self, which); }, entry.doc);
  }
  type.def_property_readonly(
      "name", [](const Snapshot &s) { return mvs_snapshot_get_name(s.get()); },
      "Name of the valve.");
  type.def_property_readonly(
      "hash", &hash,
      "128-bit hash of model and state in hexadecimal: equal for equal inputs of the next step.");
  type.def_property_readonly(
      "at_rest",
      [](const Snapshot &self) {
        auto rest = sized<mvs_rest>();
        must(mvs_snapshot_get_rest(self.get(), &rest));
        return rest.at_rest != 0;
      },
      "Whether a settle or step found this state at rest under its load.");
  type.def_property_readonly(
      "stability",
      [](const Snapshot &self) {
        auto stability = sized<mvs_stability>();
        must(mvs_snapshot_get_stability(self.get(), &stability));
        return stability_value(stability);
      },
      "Stability of the equilibrium that a snapshot at rest is in (mvs.Stability). The first use "
      "computes it: half a minute for 100,000 vertices, which Ctrl-C does not stop; node_mode is "
      "the "
      "mode.");
  type.def_property_readonly("load_case", &load_case, "The load (mvs.Load), Pa and fraction.");
  type.def_property_readonly("parts", &parts,
                             "All named parts (tuple of mvs.Part): leaflets, scallops, chordae, "
                             "heads, rings; `index` is the row in the arrays of their kind.");
  type.def_property_readonly("tools", &tools,
                             "The instruments (tuple of mvs.Tool) in the order of their addition.");
  type.def(
      "tool_bodies", &tool_bodies, "index"_a,
      "The bodies of the convex tool at an index of `tools` (tuple of mvs.ToolBody); empty for "
      "others.");
  type.def_property_readonly("history", &history,
                             "The operations on the valve (tuple of mvs.HistoryEntry): the applied "
                             "ones from first to last, then the undone ones in the order of redo.");
  type.def_property_readonly("checkpoints", &checkpoints,
                             "The names of the checkpoints (tuple of str).");
  type.def("find", &find, "kind"_a, "name"_a,
           "The part of a kind with this name; IdError if there is no such part.");
  type.def(
      "save", &save, "path"_a, py::kw_only(), "format"_a = "auto",
      "Writes a file; format \"auto\" follows the ending: .obj (exact round trip), .h5 (with "
      "the history), .vtp (for ParaView and Slicer), .vtm (the same with orifice and coaptation "
      "line, in a folder beside it) or .feb (a FEBio model of the closure). "
      "IoError if it cannot be written.");
  type.def("to_bytes", &to_bytes, py::kw_only(), "format"_a = "obj",
           "The contents of the file that save would write.");
  bind_measures(type);
  bind_plan_writing(type);
  bind_ensemble(module, type);
  bind_sensitivity(type);
  type.def("__repr__", &text);
}

}  // namespace mvs_python
