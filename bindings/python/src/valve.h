// Converts a valve given as arrays (mvs.Valve) to the description of the C interface.
#pragma once

#include <mvs/valve.h>

#include <string>
#include <vector>

#include "arrays.h"

namespace mvs_python {

// Checks the arrays of a mvs.Valve and owns the memory that the description points to.
class ValveArguments {
 public:
  explicit ValveArguments(const py::object &valve);
  const mvs_valve_desc &desc() const { return desc_; }

 private:
  mvs_array array(const char *name, uint32_t components, std::vector<uint32_t> types);
  void read();
  void read_arrays();
  void read_leaflets();
  void read_scallops();
  void read_chords();
  void read_heads();
  void read_rings();
  void read_curves();
  void read_numbers();
  double number(const char *name) const;    // 0 for None
  double positive(const char *name) const;  // the same; refuses a 0 that is given
  std::vector<std::string> names(const char *name, size_t count) const;

  py::object valve_;
  mvs_valve_desc desc_{};
  std::vector<py::array> kept_;
  std::string name_;
  std::vector<std::string> leaflet_names_, scallop_names_, chord_names_, head_names_, ring_names_,
      curve_names_;
  std::vector<const char *> scallops_;
  std::vector<mvs_id> scallop_ids_;
  std::vector<uint32_t> first_leaflet_;  // zeros in place of a missing triangle_leaflet
  std::vector<mvs_leaflet_desc> leaflets_;
  std::vector<mvs_chord_desc> chords_;
  std::vector<mvs_head_desc> heads_;
  std::vector<mvs_ring_desc> rings_;
  std::vector<mvs_curve_desc> curves_;
};

}  // namespace mvs_python
