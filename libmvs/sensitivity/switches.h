// Switches near an equilibrium: surfaces u(x, p) = 0 across which the tangent jumps while the
// forces are continuous. A chord becomes slack or taut, a spring or chord passes the kink of a
// bilinear law, the closest point of a contact pair passes from a face to its edge or from an edge
// to its end. And contact that begins, whose stiffness grows from zero within its first
// micrometres.
//
// Where the forces agree on both sides of a surface, the Hessian jumps by k a a^T, a the gradient
// of u (Hadamard's compatibility condition). So a switch is a gradient and a stiffness on each
// side.
#pragma once

#include "sensitivity/parameters.h"
#include "sensitivity/tangent.h"

namespace mvs::core {

enum class SwitchKind { chord, kink, contact };

struct Switch {
  SwitchKind kind;
  uint32_t index;                    // chord, leaflet of a spring (kink), vertex (contact)
  std::vector<NodeVector> gradient;  // of u
  double over = 0;                   // m, u at the equilibrium
  double up = 0, down = 0;           // N/m beyond the tangent where u grows, falls
  double rest_length = 0, kink = 0;  // of a spring or chord: u is its length less rest (1 + kink)
  bool is_chord = false;             // `index` is a chord
  double strength = 0, range = 0;    // of contact that begins: its pair; strength 0 elsewhere

  bool begins() const { return strength != 0; }
};

// Chordae that become slack or taut within `slack`, m.
std::vector<Switch> find_chord_switches(const Model &model, const std::vector<Vec3> &x,
                                        double slack);
// Appends the kinks of bilinear laws of chordae and springs.
void find_kinks(const Model &model, const std::vector<Vec3> &x, double slack,
                const SpringTerm &springs, std::vector<Switch> &to);
// Appends those of contact, between leaflets, and of leaflets with balls and rods; `energy` is
// prepared for x.
void find_contact_switches(const Model &model, const std::vector<Vec3> &x, double slack,
                           TotalEnergy &energy, std::vector<Switch> &to);

// The gradient as one vector a node.
NodeField field_of(const Model &model, const Switch &s);

// du/dp at fixed positions.
double own_rate(const Model &model, const std::vector<Vec3> &x, const Switch &s,
                const Parameter &parameter);

}  // namespace mvs::core
