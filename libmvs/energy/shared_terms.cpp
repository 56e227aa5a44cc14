// Passes over the elements that touch the nodes of a part, or over a slice of all.
#include "energy/shared_terms.h"

#include <atomic>
#include <numeric>

#include "energy/total_energy.h"

namespace mvs::core {
namespace {

double sum_of(const std::vector<double> &energies) {
  return std::accumulate(energies.begin(), energies.end(), 0.0);
}

}  // namespace

bool SharedTerms::pay(const TotalEnergy &of, double microseconds_of_element) const {
  if (workers_ == nullptr || !of.instrument_.empty()) return false;
  const size_t elements =
      of.spring_.size() + of.membrane_.size() + of.bending_.size() + of.contact_.size();
  return pay_for(workers_, microseconds_of_element * static_cast<double>(elements));
}

void SharedTerms::make_room(const TotalEnergy &of) {
  spring_.resize(of.spring_.size());
  membrane_.resize(of.membrane_.size());
  bending_.resize(of.bending_.size());
  chord_.assign(of.chord_.size(), 0.0);  // slack ones stay zero
  contact_.resize(of.contact_.size());
  volume_.resize(of.pressure_.size());
}

double SharedTerms::energy(const TotalEnergy &of, const std::vector<Vec3> &x) {
  make_room(of);
  const uint32_t parts = 2 * workers_->width();
  workers_->parallel_for(parts, [&](uint32_t part) {
    const auto slice = [&](size_t count, const auto &use) {
      use(begin_of_part(part, parts, count), begin_of_part(part + 1, parts, count));
    };
    const auto fill = [&](const auto &term, std::vector<double> &to) {
      slice(to.size(), [&](size_t k, size_t end) { term.energies(x, k, end, to.data()); });
    };
    fill(of.spring_, spring_);
    fill(of.membrane_, membrane_);
    fill(of.bending_, bending_);
    fill(of.chord_, chord_);
    slice(contact_.size(),
          [&](size_t k, size_t end) { of.contact_.energies(k, end, contact_.data()); });
    slice(volume_.size(),
          [&](size_t k, size_t end) { of.pressure_.volumes(x, k, end, volume_.data()); });
  });
  return sum_of(spring_) + sum_of(membrane_) + sum_of(bending_) + sum_of(chord_) +
         of.instrument_.energy(x) + sum_of(contact_) + of.pressure_.energy_of(x, volume_.data()) +
         of.grasp_.energy(x);
}

double SharedTerms::gradient(const TotalEnergy &of, const std::vector<Vec3> &x,
                             std::vector<Vec3> &g, double &elastic) {
  g.resize(x.size());
  make_room(of);
  const uint32_t parts = workers_->width();
  parts_.divide(*of.model_, parts);
  workers_->parallel_for(parts, [&](uint32_t part) {
    const NodePart nodes = parts_.part(part);
    for (uint32_t i = 0; i < g.size(); ++i) {
      if (nodes.has(i)) g[i].setZero();
    }
    const auto add = [&](const auto &term, std::vector<double> &energies) {
      PartGradient to{g, nodes, energies.data()};
      term.add_gradient(x, to);
    };
    add(of.spring_, spring_);
    add(of.membrane_, membrane_);
    add(of.bending_, bending_);
    add(of.chord_, chord_);
    PartGradient of_contact{g, nodes, contact_.data()};
    of.contact_.add_gradient(of_contact);
    add(of.pressure_, volume_);
    const uint32_t last = begin_of_part(part + 1, parts, volume_.size());
    of.pressure_.volumes(x, begin_of_part(part, parts, volume_.size()), last, volume_.data());
  });
  elastic = sum_of(spring_);
  elastic += sum_of(membrane_);
  elastic += of.bending_.sum_by_batches(bending_.data());
  elastic += sum_of(chord_);
  elastic += sum_of(contact_);
  return elastic + of.pressure_.energy_of(x, volume_.data());
}

bool SharedTerms::fill(const TotalEnergy &of, const std::vector<Vec3> &x, Curvature curvature,
                       HessianAssembler &assembler) {
  const uint32_t parts = workers_->width();
  parts_.divide(*of.model_, parts);
  assembler.boundary_force.resize(assembler.matrix.size());
  std::atomic<bool> is_complete{true};
  workers_->parallel_for(parts, [&](uint32_t part) {
    HessianPart to(assembler, parts_.part(part));
    to.clear();
    if (of.contact_.hessian(x, curvature, to)) {
      of.fill_sheet(x, curvature, to);
    } else {
      is_complete = false;
    }
  });
  if (is_complete) of.grasp_.hessian(x, assembler);
  return is_complete;
}

}  // namespace mvs::core
