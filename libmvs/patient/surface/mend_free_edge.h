// Notches of a torn or ragged rim are filled: of the free edge, and of the annulus.
#pragma once

#include "patient/leaflet_sheet.h"

namespace mvs::core {

// m: a notch is at most this wide at its mouth, and at most this deep. Segmentations of thin tissue
// lose patches of a few voxels at the free edge; clefts between scallops reach half of the height
// of the posterior leaflet, 5 mm and more, and are kept.
inline constexpr double widest_notch = 6e-3, deepest_notch = 4e-3;

// The notches that were filled.
struct FilledNotches {
  double deepest = 0, saved = 0, area = 0;   // m, m, m2
  double mean_depth = 0;                     // m
  size_t sheet_triangles = 0;                // those of a filling come behind
  std::vector<size_t> last;                  // behind the last triangle of each notch
  std::vector<std::vector<uint32_t>> inner;  // vertices of each notch that left the edge
};

// Closes a rim of the sheet, free edge or annulus, over its notches: in the order of the length
// that it becomes shorter by, a notch is filled with triangles up to the straight line between both
// ends of its mouth: sharp ones, and gentle ones as well if the edge is torn in several places. The
// bottoms of valleys, of which the edge goes on rising beyond both ends of the mouth, stay as they
// are at a commissure. Vertices with a mark in `kept` stay on the edge. Labels of new triangles are
// those beside them.
FilledNotches fill_notches(LeafletSheet &sheet, std::vector<uint32_t> &rim,
                           const std::vector<uint8_t> &kept);

// Marks the vertices of the notches whose filling is in one of the pairs of crossing triangles, or
// of all notches if none is; returns whether there was a vertex to mark.
bool keep_crossing(const FilledNotches &notches, const std::vector<Edge> &crossings,
                   std::vector<uint8_t> &kept);

enum class NotchesOf : uint8_t { free_edge, annulus };
// Adds the finding "free_edge" or "annulus_notches" if there are any.
void report_notches(const FilledNotches &notches, NotchesOf rim, Findings &findings);

}  // namespace mvs::core
