// Operation ring: attaches the annulus to a rigid ring.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/error.h"
#include "measure/annulus/frame.h"
#include "surgery/operation.h"
#include "surgery/ring/ring_curve.h"
#include "surgery/ring/ring_fit.h"
#include "surgery/surgery.h"

namespace mvs::core {
namespace {

// Physio II 34 as measured: 34.7 mm CC, 26.1 mm AP, saddle 4.7 mm (OPERATIONS.md).
constexpr double ap_over_cc = 26.1 / 34.7, saddle_over_cc = 4.7 / 34.7;

std::vector<Vec3> given_curve(const mvs_op_ring &op) {
  const bool curve = op.curve.count != 0, size = op.size != 0;
  MVS_MUST(curve || size, MVS_E_ARGUMENT, "ring",
           "ring: give a curve, or the size of a parametric ring");
  MVS_MUST(!curve || !size, MVS_E_ARGUMENT, "ring",
           "ring: both a curve and a size are given: leave one out");
  MVS_MUST(size || (op.ap_ratio == 0 && op.saddle == 0), MVS_E_ARGUMENT, "ring",
           "ring: ap_ratio and saddle shape a parametric ring: leave them out with a curve");
  if (curve) return without_repeated_start(points_of(op.curve));
  return parametric_ring(op.size, op.size * (op.ap_ratio != 0 ? op.ap_ratio : ap_over_cc),
                         op.saddle != 0 ? op.saddle : op.size * saddle_over_cc);
}

// Second moment of points across their principal line over the one along it.
double breadth(const std::vector<Vec3> &points) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3 &p : points) centre += p / static_cast<double>(points.size());
  Mat3 moments = Mat3::Zero();
  for (const Vec3 &p : points) moments += (p - centre) * (p - centre).transpose();
  const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(moments).eigenvalues();
  return values[2] > 0 ? values[1] / values[2] : 0;
}

Rigid by_landmarks(const std::vector<Vec3> &from, const std::vector<Vec3> &to, double width) {
  MVS_MUST(from.size() == to.size(), MVS_E_ARGUMENT, "landmarks",
           "ring: %zu landmarks, but %zu places in landmarks_at: give one place for each",
           from.size(), to.size());
  constexpr double least = 1e-4;  // 1 % across: the turn about the line would be a guess
  MVS_MUST(breadth(from) > least, MVS_E_ARGUMENT, "landmarks",
           "ring: the landmarks lie on one line: give three that span a triangle");
  MVS_MUST(breadth(to) > least, MVS_E_ARGUMENT, "landmarks_at",
           "ring: the places in landmarks_at lie on one line: give three that span a triangle");
  Rigid motion = register_points(from, to);
  double squares = 0;
  for (size_t k = 0; k < from.size(); ++k) {
    squares += (motion(from[k]) - to[k]).squaredNorm() / static_cast<double>(from.size());
  }
  const double off = std::sqrt(squares);
  // an error of a fifth of the ring means that another point was selected
  MVS_MUST(off <= 0.2 * width, MVS_E_OP, "landmarks",
           "ring: no rigid motion brings the landmarks to their places, they stay %.1f mm off: "
           "check their order and units",
           1e3 * off);
  return motion;
}

void must_fit_the_annulus(const Surgery &s, const Loop &ring, const Loop &annulus,
                          const Rigid &motion) {
  must_be_a_perimeter(s, ring.length(), "ring");
  Vec3 offset = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    offset += (motion(ring.at(ring.length() * k / 8)) - annulus.at(annulus.length() * k / 8)) / 8;
  }
  // half a diameter
  MVS_MUST(offset.norm() <= annulus.length() / 6, MVS_E_OP, "ring",
           "ring: it would lie %.0f mm from the annulus: check landmarks_at", 1e3 * offset.norm());
}

RingFit placed(const Surgery &s, const mvs_op_ring &op, const Loop &ring, const Loop &annulus) {
  const bool parametric = op.curve.count == 0;
  Rigid motion;
  RingSeat seat{nullptr, parametric};
  if (op.landmarks.count != 0 || op.landmarks_at.count != 0) {
    motion = by_landmarks(points_of(op.landmarks), points_of(op.landmarks_at), extent_of(ring)[0]);
    seat.motion = &motion;
  } else if (parametric) {
    motion = align({Vec3::Zero(), Mat3::Identity()}, valve_frame(s.before, s.before.valve.loaded));
    seat.motion = &motion;
  }
  const double a = anterior_stretch(s.before, annulus).middle();
  RingFit fit = fit_ring(ring, annulus, a, seat);
  must_fit_the_annulus(s, ring, annulus, fit.motion);
  return fit;
}

// Moves each annulus node to its share of the ring, with and without load.
void move_to_ring(Surgery &s, const Loop &ring, const Loop &annulus, const RingFit &fit) {
  const double a = anterior_stretch(s.before, annulus).middle();
  const std::vector<uint32_t> &nodes = s.before.valve.annulus;
  for (size_t k = 0; k < nodes.size(); ++k) {
    const Vec3 place = seat_of(ring, fit, (annulus.start_of(k) - a) / annulus.length());
    s.valve.open[nodes[k]] = place;
    s.valve.loaded[nodes[k]] = place;
  }
}

}  // namespace

void operate(Surgery &s, const mvs_op_ring &op) {
  const std::vector<Vec3> curve = given_curve(op);
  must_be_a_ring(s.op_name, curve);
  const Loop ring(curve), annulus(s.before.valve.annulus, s.before.valve.loaded);
  const RingFit fit = placed(s, op, ring, annulus);
  move_to_ring(s, ring, annulus, fit);
  std::vector<Vec3> points = curve;
  for (Vec3 &p : points) p = fit.motion(p);
  set_ring(s, op.name, "ring", RingKind::rigid, std::move(points));
  const Vec3 extent = extent_of(ring);
  s.title =
      format("Sew in %s, %.1f x %.1f mm, perimeter %.1f mm", s.valve.rings.get()[0].name.c_str(),
             1e3 * extent[0], 1e3 * extent[1], 1e3 * ring.length());
}

}  // namespace mvs::core
