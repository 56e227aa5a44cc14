// Sums of the rows of the projected stiffness of tissue and contact.
#include "tests/bench/relaxation/fictitious_masses.h"

#include <algorithm>
#include <cmath>

using namespace mvs::core;

namespace bench {
namespace {

// Least mass as a share of the median one: a branch point between slack chordae has no stiffness.
constexpr double least = 1e-3;

std::vector<double> row_sums(const BlockMatrix &matrix) {
  std::vector<double> sum(matrix.size(), 0.0);
  for (uint32_t c = 0; c < matrix.size(); ++c) {
    sum[c] += matrix.value[matrix.start[c]].norm();
    for (uint32_t k = matrix.start[c] + 1; k < matrix.start[c + 1]; ++k) {
      const double norm = matrix.value[k].norm();
      sum[c] += norm;
      sum[matrix.row[k]] += norm;
    }
  }
  return sum;
}

}  // namespace

FictitiousMasses::FictitiousMasses(const Model &model, const Options &options)
    : model_(&model),
      options_(options),
      spring_(model),
      membrane_(model),
      bending_(model),
      chord_(model),
      mass_(model.node_count(), 0.0) {
  std::vector<Edge> pairs;
  spring_.add_pairs(pairs);
  first_membrane_ = pairs.size();
  membrane_.add_pairs(pairs);
  first_bending_ = pairs.size();
  bending_.add_pairs(pairs);
  first_chord_ = pairs.size();
  chord_.add_pairs(pairs);
  system_.set_pattern(model, pairs, {});
}

void FictitiousMasses::renew(const std::vector<Vec3> &x, const ContactTerm &contact) {
  stretched_ = x;
  for (Vec3 &p : stretched_) p *= 1 + options_.margin;
  row_.assign(x.size(), 0.0);
  add_tissue(stretched_);
  add_contact(contact);
  sorted_.clear();
  for (size_t i = 0; i < row_.size(); ++i) {
    if (!model_->topology.fixed[i]) sorted_.push_back(row_[i]);
  }
  const auto middle = sorted_.begin() + static_cast<std::ptrdiff_t>(sorted_.size() / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  for (size_t i = 0; i < row_.size(); ++i) {
    const double now = options_.safety * std::max(row_[i], least * *middle) / 4;
    mass_[i] = std::max(now, options_.kept * mass_[i]);
  }
}

void FictitiousMasses::add_tissue(const std::vector<Vec3> &x) {
  system_.clear();
  system_.begin_term(0);
  spring_.hessian(x, Curvature::projected, system_);
  system_.begin_term(first_membrane_);
  membrane_.hessian(x, Curvature::projected, system_);
  system_.begin_term(first_bending_);
  bending_.hessian(x, Curvature::projected, system_);
  system_.begin_term(first_chord_);
  chord_.hessian(x, Curvature::projected, system_);
  const std::vector<double> sums = row_sums(system_.matrix);
  for (size_t r = 0; r < sums.size(); ++r) row_[system_.node_of[r]] += sums[r];
}

void FictitiousMasses::add_contact(const ContactTerm &contact) {
  for (const ContactPair &pair : contact.contact_pairs()) {
    const double stiffness =
        std::abs(pair.strength) / pair.range * penalty(pair.gap() / pair.range).second;
    double weights = 0;
    for (uint32_t k = 0; k < pair.count; ++k) weights += std::abs(pair.weight[k]);
    for (uint32_t k = 0; k < pair.count; ++k) {
      row_[pair.node[k]] += stiffness * std::abs(pair.weight[k]) * weights;
    }
  }
}

}  // namespace bench
