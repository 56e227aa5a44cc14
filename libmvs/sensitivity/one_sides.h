// One-sided derivatives at switches: the forces that they add on each side (switch_problem), and
// what these do to positions and quantities.
#pragma once

#include "sensitivity/linear_response.h"
#include "sensitivity/switch_problem.h"

namespace mvs::core {

class OneSides {
 public:
  // The gradients of the switches are those of `response` after the quantities. Keeps references.
  OneSides(const SensitivityRequest &request, const LinearResponse &response,
           const std::vector<Switch> &switches, EquilibriumTangent &tangent, double slack);

  // Extra forces of the switches for a change of parameter p, empty on a side where no consistent
  // state was found.
  struct Sides {
    std::vector<double> up, down;
    bool is_known() const { return !up.empty() && !down.empty(); }
  };
  // Without the switches that a step by `slack` of the fastest node, if it is known, does not
  // reach.
  Sides sides_of(size_t p) const;
  // Notes of the switches whose forces change the motion by parameter p, or its derivative of
  // quantity q, by more than the error that the side test allows.
  mvs_sensitivity_notes notes_of_parameter(size_t p, const Sides &sides) const;
  mvs_sensitivity_notes notes_of_quantity(size_t q, size_t p, const Sides &sides) const;
  // The same for the motion by several parameters.
  mvs_sensitivity_notes notes_along(std::span<const ParameterStep> steps,
                                    const NodeField &motion) const;

  // The change of the derivative of each quantity by parameter p that extra forces make; NaN
  // without forces: no consistent state is known.
  std::vector<double> changes_of(size_t p, const std::vector<double> &forces) const;
  // dx/dp with extra forces, if response has that of the tangent.
  NodeField motion_of(size_t p, const std::vector<double> &forces) const;
  // Rates of the switches with extra forces.
  std::vector<double> rates_of(size_t p, const std::vector<double> &forces) const;

 private:
  Sides sides_along(std::vector<double> rates, double fastest) const;
  mvs_sensitivity_notes notes_of_motion(const Sides &sides, double fastest) const;
  // The change of quantity q by a unit force of switch j.
  double change_by(size_t q, size_t j) const;
  template <typename Matters>
  mvs_sensitivity_notes notes_where(const Sides &sides, Matters matters) const;

  const SensitivityRequest &request_;
  const LinearResponse &response_;
  const std::vector<Switch> &switches_;
  double slack_;
  std::vector<NodeField> motion_;    // K^-1 of a unit force along each switch
  std::vector<double> flexibility_;  // row-major
};

}  // namespace mvs::core
