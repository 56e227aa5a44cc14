// Conversion of shells to triangles, and detection of the annulus loop.
#include <Eigen/Geometry>
#include <algorithm>

#include "formats/abaqus/valve.h"
#include "model/sides.h"

namespace mvs::core {
namespace {

unsigned long long number_of(const InpElement &element) {
  return element.number;
}

Vec3 normal_of(const InpMesh &mesh, const Tri &t) {
  const Vec3 &p = mesh.nodes[t[0]].x;
  return (mesh.nodes[t[1]].x - p).cross(mesh.nodes[t[2]].x - p);
}

// Returns the corners without repetitions: a quad with two equal corners is a triangle.
std::vector<uint32_t> corners_of(const InpElement &element) {
  std::vector<uint32_t> corners;
  for (size_t k = 0; k < element.nodes.size(); ++k) {
    if (element.nodes[k] != element.nodes[(k + 1) % element.nodes.size()]) {
      corners.push_back(element.nodes[k]);
    }
  }
  std::vector<uint32_t> sorted = corners;
  std::sort(sorted.begin(), sorted.end());
  const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
  if (corners.size() < 3 || repeats) {
    inp_fail(element.line, "element %llu has fewer than 3 corners: remove it", number_of(element));
  }
  return corners;
}

// Splits a quad along its shorter diagonal (from the first corner if both are equal), or along the
// other one if the quad is not convex there.
std::array<Tri, 2> split_quad(const InpMesh &mesh, const InpElement &element,
                              const std::vector<uint32_t> &q) {
  const std::array<std::array<Tri, 2>, 2> ways = {
      {{{{q[0], q[1], q[2]}, {q[0], q[2], q[3]}}}, {{{q[0], q[1], q[3]}, {q[1], q[2], q[3]}}}}};
  const double first = (mesh.nodes[q[2]].x - mesh.nodes[q[0]].x).squaredNorm();
  const double second = (mesh.nodes[q[3]].x - mesh.nodes[q[1]].x).squaredNorm();
  const size_t shorter = second < first ? 1 : 0;
  for (const size_t way : {shorter, 1 - shorter}) {
    const auto &[l, r] = ways[way];
    if (normal_of(mesh, l).dot(normal_of(mesh, r)) > 0) return ways[way];
  }
  inp_fail(element.line, "element %llu is folded or inverted: its nodes have to go around it",
           number_of(element));
}

void add_element(const InpMesh &mesh, uint32_t e, uint32_t section, InpSheet &sheet,
                 size_t &degenerate) {
  const InpElement &element = mesh.elements[e];
  const std::vector<uint32_t> corners = corners_of(element);
  degenerate += corners.size() < element.nodes.size();
  const auto add = [&](const Tri &triangle) {
    sheet.triangles.push_back(triangle);
    sheet.element.push_back(e);
    sheet.section.push_back(section);
    for (const uint32_t node : triangle) sheet.holds[node] = 1;
  };
  if (corners.size() == 3) return add({corners[0], corners[1], corners[2]});
  for (const Tri &triangle : split_quad(mesh, element, corners)) add(triangle);
}

// The two neighbours of each boundary node.
std::map<uint32_t, std::vector<uint32_t>> boundary_of(const InpMesh &mesh, const InpSheet &sheet) {
  std::map<uint32_t, std::vector<uint32_t>> beside;
  const std::vector<Side> sides = sorted_sides(sheet.triangles);
  for_each_edge(sides, [&](size_t first, size_t last) {
    if (last - first != 1) return;
    const Edge &edge = sides[first].edge;
    beside[edge[0]].push_back(edge[1]);
    beside[edge[1]].push_back(edge[0]);
  });
  for (const auto &[node, neighbours] : beside) {
    if (neighbours.size() == 2) continue;
    inp_fail(mesh.nodes[node].line,
             "node %llu is where the sheet touches itself in one point: join it along an edge, or "
             "give each part its own node",
             static_cast<unsigned long long>(mesh.nodes[node].number));
  }
  return beside;
}

// Each loop begins at its first node in the file and continues to the neighbour with the lower
// index.
std::vector<std::vector<uint32_t>> loops_of(
    const std::map<uint32_t, std::vector<uint32_t>> &beside) {
  std::vector<std::vector<uint32_t>> loops;
  std::set<uint32_t> seen;
  for (const auto &[first, neighbours] : beside) {
    if (seen.contains(first)) continue;
    std::vector<uint32_t> loop = {first};
    uint32_t before = first;
    for (uint32_t node = std::min(neighbours[0], neighbours[1]); node != first;) {
      loop.push_back(node);
      const std::vector<uint32_t> &next = beside.at(node);
      const uint32_t after = next[0] == before ? next[1] : next[0];
      before = node;
      node = after;
    }
    seen.insert(loop.begin(), loop.end());
    loops.push_back(std::move(loop));
  }
  return loops;
}

// Reports the first free node of the loop with the most prescribed nodes.
[[noreturn]] void fail_without_annulus(const InpMesh &mesh, const InpLoad &load,
                                       const std::vector<std::vector<uint32_t>> &loops) {
  size_t most = 0, length = 0;
  uint32_t missing = none;
  for (const std::vector<uint32_t> &loop : loops) {
    const auto held = static_cast<size_t>(std::count_if(
        loop.begin(), loop.end(), [&](uint32_t node) { return load.moved.contains(node); }));
    if (missing != none && held <= most) continue;
    most = held;
    length = loop.size();
    missing = *std::find_if(loop.begin(), loop.end(),
                            [&](uint32_t node) { return !load.moved.contains(node); });
  }
  if (missing == none) inp_fail(0, "the sheet has no boundary: a valve has an annulus");
  inp_fail(mesh.nodes[missing].line,
           "the annulus is a loop of the sheet's boundary whose nodes all have a *BOUNDARY: the "
           "nearest to that has %zu of its %zu nodes prescribed, but not node %llu; all leaflets "
           "have to be one sheet",
           most, length, static_cast<unsigned long long>(mesh.nodes[missing].number));
}

void find_annulus(const InpMesh &mesh, const InpLoad &load, InpSheet &sheet) {
  const std::vector<std::vector<uint32_t>> loops = loops_of(boundary_of(mesh, sheet));
  sheet.in_free_edge.assign(mesh.nodes.size(), 0);
  for (const std::vector<uint32_t> &loop : loops) {
    if (!std::all_of(loop.begin(), loop.end(),
                     [&](uint32_t node) { return load.moved.contains(node); })) {
      for (const uint32_t node : loop) sheet.in_free_edge[node] = 1;
    } else if (sheet.annulus.empty()) {
      sheet.annulus = loop;
    } else {
      inp_fail(mesh.nodes[loop[0]].line,
               "two loops of the sheet's boundary are prescribed all around, with nodes %llu and "
               "%llu: a valve has one annulus",
               static_cast<unsigned long long>(mesh.nodes[sheet.annulus[0]].number),
               static_cast<unsigned long long>(mesh.nodes[loop[0]].number));
    }
  }
  if (sheet.annulus.empty()) fail_without_annulus(mesh, load, loops);
}

void note_other_held(const InpMesh &mesh, const InpLoad &load, const InpSheet &sheet,
                     InpNotes &notes) {
  const std::set<uint32_t> annulus(sheet.annulus.begin(), sheet.annulus.end());
  for (const auto &[node, moved] : load.moved) {
    if (!sheet.holds[node] || annulus.contains(node)) continue;
    notes.left_out(mesh.nodes[node].line,
                   "a prescribed node of the sheet that is not on the annulus is left free");
  }
}

}  // namespace

InpSheet make_inp_sheet(const InpMesh &mesh, const InpProperties &properties, const InpLoad &load,
                        InpNotes &notes) {
  if (properties.shells.empty()) inp_fail(0, "the file has no *SHELL SECTION: no leaflets");
  std::vector<uint32_t> section_of(mesh.elements.size(), none);
  for (uint32_t s = 0; s < properties.shells.size(); ++s) {
    for (const uint32_t e : properties.shells[s].elements) section_of[e] = s;
  }
  InpSheet sheet;
  sheet.holds.assign(mesh.nodes.size(), 0);
  size_t degenerate = 0, shells = 0;
  for (uint32_t e = 0; e < mesh.elements.size(); ++e) {
    if (section_of[e] == none) continue;
    add_element(mesh, e, section_of[e], sheet, degenerate);
    ++shells;
  }
  notes.counted("%zu shells are %zu triangles, quads split along their shorter diagonal", shells,
                sheet.triangles.size());
  if (degenerate > 0) {
    notes.chosen("%zu quads with a repeated corner are one triangle each", degenerate);
  }
  find_annulus(mesh, load, sheet);
  note_other_held(mesh, load, sheet, notes);
  return sheet;
}

std::string inp_leaflet_name(std::string_view set) {
  static constexpr std::array endings = {"ELEMENTS", "ELEMENT", "ELEMS", "ELSET",
                                         "SHELLS",   "LEAFLET", "SET"};
  std::string_view name = set;
  for (bool again = true; again;) {
    again = false;
    for (const std::string_view ending : endings) {
      if (name.size() <= ending.size() + 1 || !inp_label(name).ends_with(ending)) continue;
      const char mark = name[name.size() - ending.size() - 1];
      if (mark != '_' && mark != '-' && mark != ' ') continue;
      name.remove_suffix(ending.size() + 1);
      again = true;
    }
  }
  return std::string(name);
}

}  // namespace mvs::core
