// A valve of one's own: copied from a snapshot, edited, and set again through the C interface.
#pragma once

#include <string>
#include <vector>

#include "host.h"

namespace cli {

class ValveCopy {
 public:
  // Keeps `snapshot` for its arrays.
  explicit ValveCopy(mvs::Snapshot snapshot);

  // Makes the rest length of a chord `factor` times what it is; no such chord is an mvs::Error.
  void scale_chord(const std::string &name, double factor);

  // Makes this the valve of a simulator, with the ids and names of the one it was copied from.
  void set(mvs::Sim &sim) const;

 private:
  mvs_array array(uint32_t which) const;
  void copy_leaflets();
  void copy_chords();
  void copy_heads();
  void copy_scallops();

  mvs::Snapshot snapshot_;
  std::vector<mvs_part> leaflet_parts_, scallop_parts_, chord_parts_, head_parts_;
  std::vector<mvs_leaflet_desc> leaflets_;
  std::vector<mvs_chord_desc> chords_;
  std::vector<mvs_head_desc> heads_;
  std::vector<const char *> scallop_names_;
  std::vector<mvs_id> scallop_ids_;
};

}  // namespace cli
