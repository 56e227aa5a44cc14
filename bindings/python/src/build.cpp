#include "build.h"

#include <mvs/build.h>
#include <pybind11/stl.h>

#include <map>
#include <memory>
#include <string>

#include "arrays.h"
#include "values.h"

namespace mvs_python {
namespace {

using namespace py::literals;

using Number = std::optional<double>;
using Count = std::optional<uint32_t>;

mvs_surface_kind kind_of(const std::optional<std::string> &given) {
  if (!given) return 0;
  static const std::map<std::string, mvs_surface_kind> kinds = {{"mid", MVS_SURFACE_KIND_MID},
                                                                {"atrial", MVS_SURFACE_KIND_ATRIAL},
                                                                {"skin", MVS_SURFACE_KIND_SKIN}};
  const auto found = kinds.find(*given);
  if (found == kinds.end()) {
    refuse(MVS_E_ARGUMENT, "kind",
           "kind is '" + *given + "', it must be 'mid', 'atrial' or 'skin'");
  }
  return found->second;
}

// The arrays of one call, described for the C interface.
struct SurfaceArrays {
  std::vector<py::array> kept;

  mvs_array points(const py::object &value, const char *name) {
    return array(value, {name, 3, {MVS_TYPE_F64, MVS_TYPE_F32}});
  }
  mvs_array triangles(const py::object &value, const char *name) {
    return array(value, {name, 3, {MVS_TYPE_U32}});
  }
  mvs_array array(const py::object &value, Wanted wanted) {
    if (value.is_none()) return {};
    return described(array_argument(value, wanted), kept);
  }
};

py::object finding_value(const mvs_finding &found) {
  const auto *values = static_cast<const double *>(found.values.data);
  const py::array_t<double> owned(static_cast<py::ssize_t>(found.values.count), values);
  owned.attr("setflags")("write"_a = false);
  const py::module_ module = py::module_::import("mvs.values");
  return module.attr("Finding")(
      "name"_a = found.name,
      "source"_a = py::module_::import("mvs.kinds").attr("FindingSource")(found.source),
      "confidence"_a = found.confidence, "sentence"_a = found.sentence, "values"_a = owned,
      "unit"_a = found.unit, "doubtful"_a = found.doubtful != 0);
}

py::tuple findings_of(const mvs_findings *found) {
  uint32_t count = 0;
  must(mvs_findings_get_count(found, &count));
  py::list findings;
  for (uint32_t k = 0; k < count; ++k) {
    auto one = sized<mvs_finding>();
    must(mvs_findings_get(found, k, &one));
    findings.append(finding_value(one));
  }
  return py::tuple(findings);
}

py::tuple build_valve(Simulator &self, const py::object &points, const py::object &triangles,
                      const std::optional<std::string> &kind, const std::string &name,
                      const py::object &triangle_leaflet, const py::object &thickness,
                      const py::object &annulus, const py::object &commissures,
                      const py::object &anterior, const py::object &papillary_tips,
                      const py::object &closed_points, const py::object &closed_triangles,
                      const py::object &closed_annulus, const py::object &closed_tips,
                      const py::object &leaflet, Number edge, Number chord_factor,
                      Number coaptation_length, Number edge_error, Number edge_lost,
                      Number thickness_error, Number closed_error, Count chords, bool leak,
                      py::object progress) {
  SurfaceArrays arrays;
  auto surface = sized<mvs_surface_desc>();
  surface.kind = kind_of(kind);
  surface.name = c_text(name, "name");
  surface.points = arrays.points(points, "points");
  surface.triangles = arrays.triangles(triangles, "triangles");
  surface.triangle_leaflet =
      arrays.array(triangle_leaflet, {"triangle_leaflet", 1, {MVS_TYPE_U32}});
  surface.annulus = arrays.points(annulus, "annulus");
  surface.commissures = arrays.points(commissures, "commissures");
  surface.anterior = arrays.points(anterior, "anterior");
  surface.papillary_tips = arrays.points(papillary_tips, "papillary_tips");
  surface.closed_points = arrays.points(closed_points, "closed_points");
  surface.closed_triangles = arrays.triangles(closed_triangles, "closed_triangles");
  surface.closed_annulus = arrays.points(closed_annulus, "closed_annulus");
  surface.closed_tips = arrays.points(closed_tips, "closed_tips");
  auto options = sized<mvs_build_options>();
  if (py::isinstance<py::float_>(thickness)) {
    options.thickness = thickness.cast<double>();
  } else {
    surface.point_thickness =
        arrays.array(thickness, {"thickness", 1, {MVS_TYPE_F64, MVS_TYPE_F32}});
  }
  options.leaflet_law =
      leaflet.is_none()
          ? 0
          : py::module_::import("mvs.laws").attr("leaflet_law_of")(leaflet).cast<uint32_t>();
  options.edge = given_or_default(edge, "edge");
  options.chord_factor = given_or_default(chord_factor, "chord_factor");
  options.coaptation_length = given_or_default(coaptation_length, "coaptation_length");
  options.edge_error = edge_error.value_or(0);
  options.edge_lost = given_or_default(edge_lost, "edge_lost");
  options.thickness_error = given_or_default(thickness_error, "thickness_error");
  options.closed_error = given_or_default(closed_error, "closed_error");
  options.chords = given_or_default(chords, "chords");
  options.without_leak = leak ? 0 : 1;
  mvs_findings *found = nullptr;
  self.call_with(std::move(progress),
                 [&](mvs_sim *sim) { return mvs_build_valve(sim, &surface, &options, &found); });
  const std::unique_ptr<mvs_findings, void (*)(mvs_findings *)> held(found, &mvs_findings_release);
  return findings_of(found);
}

py::tuple find_leak_interval(Simulator &self, Number lengths, Number single, Number thickness,
                             py::object progress) {
  auto errors = sized<mvs_leak_errors>();
  errors.lengths = given_or_default(lengths, "lengths");
  errors.single = given_or_default(single, "single");
  errors.thickness = given_or_default(thickness, "thickness");
  mvs_findings *found = nullptr;
  self.call_with(std::move(progress),
                 [&](mvs_sim *sim) { return mvs_find_leak_interval(sim, &errors, &found); });
  const std::unique_ptr<mvs_findings, void (*)(mvs_findings *)> held(found, &mvs_findings_release);
  return findings_of(found);
}

}  // namespace

void bind_build(py::class_<Simulator> &type) {
  type.def(
      "build_valve", &build_valve, "points"_a, "triangles"_a = py::none(), py::kw_only(),
      "kind"_a = py::none(), "name"_a = "valve", "triangle_leaflet"_a = py::none(),
      "thickness"_a = py::none(), "annulus"_a = py::none(), "commissures"_a = py::none(),
      "anterior"_a = py::none(), "papillary_tips"_a = py::none(), "closed_points"_a = py::none(),
      "closed_triangles"_a = py::none(), "closed_annulus"_a = py::none(),
      "closed_tips"_a = py::none(), "leaflet"_a = py::none(), "edge"_a = py::none(),
      "chord_factor"_a = py::none(), "coaptation_length"_a = py::none(),
      "edge_error"_a = py::none(), "edge_lost"_a = py::none(), "thickness_error"_a = py::none(),
      "closed_error"_a = py::none(), "chords"_a = py::none(), "leak"_a = true,
      "progress"_a = py::none(),
      "Replaces the valve by one that is built from a surface of open, unloaded leaflets, and "
      "returns what was found, guessed and assumed (tuple of mvs.Finding). All in one frame, "
      "in m.\n\npoints: (n, 3)\ntriangles: (m, 3) uint32; None: each three points in turn are "
      "one\nkind: \"mid\", \"atrial\" or \"skin\"; None: a closed surface is a skin, an open one "
      "the mid-surface\ntriangle_leaflet: (m,) uint32, 0 unknown, 1 anterior, 2 "
      "posterior\nthickness: m, a number or (n,); None: 0.8 mm\nannulus: (k, 3), in any "
      "order\ncommissures: (2, 3)\nanterior: (1, 3), a point of the anterior "
      "leaflet\npapillary_tips: (k, 3)\nclosed_points, closed_triangles: the same leaflets "
      "closed, a mid-surface or a skin; chords get lengths with which the valve closes to "
      "them\nclosed_annulus: (k, 3), "
      "along the "
      "loaded annulus in any order; None: an affine motion onto rims of the closed "
      "surface\nclosed_tips: "
      "(k, 3), papillary_tips under load, in their order; None: they follow the rigid part of "
      "the annulus' motion\nleaflet: law of the leaflets; None: \"bilinear\", with a closed "
      "surface the law that closes nearest to it "
      "(finding \"tissue\")\nedge: m, of the triangles; None: as for 1,000 "
      "vertices\nchord_factor: on all rest lengths [1]\ncoaptation_length: m, overlap in the "
      "middle for which rest lengths are chosen [8e-3]\nedge_error: m, how far the "
      "free edge may lie farther out or in; widens the interval of leaks [0]\nedge_lost: m, of "
      "tissue "
      "that may be missing at the free edge; widens the interval of leaks; None: half of the mean "
      "depth of its filled notches\nthickness_error: m, by how much the leaflets may be thicker or "
      "thinner; widens the interval of leaks [0]\nclosed_error: m, standard deviation of places "
      "of the closed surface; gaps of it widen the interval of leaks from 3.6 times as much of "
      "width on, of tissue thicker than twice as much, or 1e-3, from as much more [0.5e-3, as of "
      "labels of segmentation networks]\nchords: about this number of "
      "segments "
      "[100]\nleak: whether the leak is found over the plausible lengths of chordae; takes 3 to 13 "
      "closures\nprogress: as in settle");
  type.def(
      "find_leak_interval", &find_leak_interval, py::kw_only(), "lengths"_a = py::none(),
      "single"_a = py::none(), "thickness"_a = py::none(), "progress"_a = py::none(),
      "Closes the valve from open under 120 mmHg with chordae of other lengths and leaflets of "
      "other thicknesses, and returns findings (tuple of mvs.Finding), to be taken by name: "
      "\"leak\", \"leak_interval\" and \"leak_limits\", m2: the difference between meshes of one "
      "sealed valve, and the width from which an interval says nothing; with a thickness "
      "\"thickness_error\" before them. The valve stays as it is.\n\nlengths: share by "
      "which all rest "
      "lengths, and those of a group, may be off together [0.1]\nsingle: share, of a chord "
      "beside its group [0.03]\nthickness: m, of the leaflets [0]\nprogress: as in settle");
}

}  // namespace mvs_python
