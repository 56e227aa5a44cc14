// The terms of the total energy by several threads: each has a part of the nodes, to which it adds
// in the order of a single thread. Energies are computed by element, and summed in that order. So
// no bit depends on the number of threads.
#pragma once

#include <vector>

#include "base/workers.h"
#include "energy/hessian_assembler.h"
#include "energy/node_parts.h"
#include "energy/term.h"

namespace mvs::core {

class TotalEnergy;

class SharedTerms {
 public:
  void use_workers(Workers *workers) { workers_ = workers; }
  Workers *workers() const { return workers_; }

  // Whether it pays to share a pass over all elements. Not with instruments, whose points belong to
  // no part.
  bool pay(const TotalEnergy &of, double microseconds_of_element) const;
  // These replace the passes of TotalEnergy after the collection of contact.
  double energy(const TotalEnergy &of, const std::vector<Vec3> &x);
  double gradient(const TotalEnergy &of, const std::vector<Vec3> &x, std::vector<Vec3> &g,
                  double &elastic);
  bool fill(const TotalEnergy &of, const std::vector<Vec3> &x, Curvature curvature,
            HessianAssembler &assembler);

 private:
  void make_room(const TotalEnergy &of);

  Workers *workers_ = nullptr;
  NodeParts parts_;
  // of each element: J; m3
  std::vector<double> spring_, membrane_, bending_, chord_, contact_, volume_;
};

}  // namespace mvs::core
