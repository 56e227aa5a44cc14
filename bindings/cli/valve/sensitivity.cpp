#include "valve/sensitivity.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "text/readouts.h"

namespace cli {
namespace {

AskedQuantity quantity_of(const std::string &given) {
  AskedQuantity asked{given, given, "", 1};
  if (given == "coaptation") asked.name = "coaptation_area";
  if (given == "orifice") asked.name = "regurgitant_orifice_area";
  for (const mvs_field_info &field : mvs::fields_of(MVS_STRUCT_MEASURES)) {
    if (asked.name != field.name) continue;
    if (const ShownUnit *row = shown_unit(field.unit)) {
      asked.unit = row->unit;
      asked.scale = row->scale;
    }
  }
  return asked;
}

// One parameter for each part of a kind.
AskedParameters of_parts(const mvs::Snapshot &valve, mvs_part_kind parts, mvs_parameter_kind kind) {
  AskedParameters asked{{}, {}, "mm", 1e-3};
  for (const mvs_part &part : valve.parts(parts)) {
    const uint32_t axes = kind == MVS_PARAMETER_HEAD_POSITION ? 3 : 1;
    for (uint32_t axis = 0; axis < axes; ++axis) {
      mvs_parameter parameter = {};
      parameter.kind = kind;
      parameter.index = part.index;
      parameter.component = axis;
      asked.list.push_back(parameter);
      asked.names.push_back(axes == 1 ? part.name : text("%s %c", part.name, "xyz"[axis]));
    }
  }
  return asked;
}

AskedParameters single(const std::string &name, mvs_parameter_kind kind, const std::string &unit,
                       double scale) {
  mvs_parameter parameter = {};
  parameter.kind = kind;
  return {{name}, {parameter}, unit, scale};
}

// The vertex of the leaflet at which a chord inserts; UINT32_MAX for a chord between other nodes.
uint32_t insertion_of(const mvs::Snapshot &valve, uint32_t chord) {
  const auto kind = valve.view<uint8_t>(MVS_ARRAY_NODE_KIND);
  const uint32_t *ends = valve.view<uint32_t>(MVS_ARRAY_CHORD_NODES).row(chord);
  const bool first = *kind.row(ends[0]) == MVS_NODE_KIND_LEAFLET;
  const bool second = *kind.row(ends[1]) == MVS_NODE_KIND_LEAFLET;
  return first == second ? UINT32_MAX : ends[first ? 0 : 1];
}

// The insertion of each chord along each edge that leaves it, named by the vertex at its end.
AskedParameters sites(const mvs::Snapshot &valve) {
  AskedParameters asked{{}, {}, "mm", 1e-3};
  const auto triangles = valve.view<uint32_t>(MVS_ARRAY_TRIANGLE_NODES);
  for (const mvs_part &part : valve.parts(MVS_PART_CHORD)) {
    const uint32_t node = insertion_of(valve, part.index);
    std::set<uint32_t> around;
    for (size_t t = 0; t < triangles.rows(); ++t) {
      const uint32_t *corner = triangles.row(t);
      if (std::find(corner, corner + 3, node) != corner + 3) around.insert(corner, corner + 3);
    }
    around.erase(node);
    for (const uint32_t toward : around) {
      mvs_parameter parameter = {};
      parameter.kind = MVS_PARAMETER_CHORD_SITE;
      parameter.index = part.index;
      parameter.component = toward;
      asked.list.push_back(parameter);
      asked.names.push_back(text("%s to %u", part.name, toward));
    }
  }
  return asked;
}

// Keeps the parameters of one chord; fails if the chord has no insertion to move.
AskedParameters of_chord(const mvs::Snapshot &valve, const std::string &to,
                         const std::string &chord, const AskedParameters &all) {
  if (to != "chords" && to != "sites") {
    fail(MVS_E_ARGUMENT, "--chord", "--chord " + chord + ": it needs --to chords or --to sites");
  }
  const uint32_t index = valve.find(MVS_PART_CHORD, chord).index;
  AskedParameters kept{{}, {}, all.unit, all.scale};
  for (size_t p = 0; p < all.list.size(); ++p) {
    if (all.list[p].index != index) continue;
    kept.list.push_back(all.list[p]);
    kept.names.push_back(all.names[p]);
  }
  if (kept.list.empty()) {
    fail(MVS_E_OP, "--chord", "--chord " + chord + ": this chord does not end on a leaflet");
  }
  return kept;
}

AskedParameters parameters_of(const mvs::Snapshot &valve, const std::string &to) {
  if (to == "sites") return sites(valve);
  if (to == "chords") return of_parts(valve, MVS_PART_CHORD, MVS_PARAMETER_CHORD_REST_LENGTH);
  if (to == "heads") return of_parts(valve, MVS_PART_HEAD, MVS_PARAMETER_HEAD_POSITION);
  if (to == "scallops") return of_parts(valve, MVS_PART_SCALLOP, MVS_PARAMETER_SCALLOP_THICKNESS);
  if (to == "pressure") return single(to, MVS_PARAMETER_PRESSURE, "mmHg", pa_per_mmhg);
  return single(to, MVS_PARAMETER_ANNULUS_SCALE, "%", 0.01);
}

template <typename Number>
std::vector<Number> array_of(const mvs::Sensitivity &found, mvs_sensitivity_array which) {
  mvs_view view = {};
  mvs::must(mvs_sensitivity_get_array(found.get(), which, &view));
  const auto *data = static_cast<const Number *>(view.data);
  return {data, data + view.count * view.components};
}

}  // namespace

std::vector<std::string> parameter_words() {
  return {"chords", "sites", "heads", "scallops", "pressure", "annulus_scale"};
}

SensitivityTable sensitivity_table(const mvs::Snapshot &valve, const std::vector<std::string> &of,
                                   const std::string &to, const std::string &chord) {
  SensitivityTable table = {};
  std::vector<mvs_quantity> list;
  for (const std::string &name : of) table.quantities.push_back(quantity_of(name));
  for (const AskedQuantity &asked : table.quantities) {
    mvs_quantity quantity = {};
    quantity.kind = MVS_QUANTITY_MEASURE;
    quantity.measure = asked.name.c_str();
    list.push_back(quantity);
  }
  table.parameters = parameters_of(valve, to);
  if (!chord.empty()) table.parameters = of_chord(valve, to, chord, table.parameters);
  const mvs::Sensitivity found(valve, list, table.parameters.list);
  table.summary = found.summary();
  table.value = array_of<double>(found, MVS_SENSITIVITY_ARRAY_VALUE);
  table.derivative = array_of<double>(found, MVS_SENSITIVITY_ARRAY_DERIVATIVE);
  table.above = array_of<double>(found, MVS_SENSITIVITY_ARRAY_ABOVE);
  table.below = array_of<double>(found, MVS_SENSITIVITY_ARRAY_BELOW);
  table.quantity_notes = array_of<uint32_t>(found, MVS_SENSITIVITY_ARRAY_QUANTITY_NOTES);
  table.parameter_notes = array_of<uint32_t>(found, MVS_SENSITIVITY_ARRAY_PARAMETER_NOTES);
  for (size_t q = 0; q < table.quantities.size(); ++q) {
    table.value[q] *= table.quantities[q].scale;
    for (std::vector<double> *side : {&table.derivative, &table.above, &table.below}) {
      for (size_t p = 0; p < table.parameters.names.size(); ++p) {
        (*side)[table.index(q, p)] *= table.quantities[q].scale * table.parameters.scale;
      }
    }
  }
  return table;
}

std::vector<std::string> note_words(mvs_sensitivity_notes notes) {
  static const std::pair<mvs_sensitivity_notes, const char *> words[] = {
      {MVS_SENSITIVITY_NOTE_SWITCH, "switch"},
      {MVS_SENSITIVITY_NOTE_CHORD, "chord about to switch"},
      {MVS_SENSITIVITY_NOTE_SNAP, "about to snap"},
      {MVS_SENSITIVITY_NOTE_DIFFERENCES, "by differences"},
      {MVS_SENSITIVITY_NOTE_RASTER, "on a raster"},
      {MVS_SENSITIVITY_NOTE_EXTREME, "extreme value"},
      {MVS_SENSITIVITY_NOTE_ENVELOPE, "rim fixed in the tissue"},
      {MVS_SENSITIVITY_NOTE_CONTACT, "contact about to switch"},
      {MVS_SENSITIVITY_NOTE_KINK, "kink of a law"},
      {MVS_SENSITIVITY_NOTE_SIDES, "both sides confirmed"},
      {MVS_SENSITIVITY_NOTE_TIED, "several chordae have the largest value"}};
  std::vector<std::string> found;
  for (const auto &[bit, word] : words) {
    if ((notes & bit) != 0) found.emplace_back(word);
  }
  return found;
}

}  // namespace cli
