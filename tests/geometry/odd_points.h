// Points of random and degenerate pairs of segments and triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/types.h"

namespace mvs::core {

// Points around the origin, 1 to 100 mm away, in one of several kinds of position.
class Points {
 public:
  explicit Points(uint64_t seed) : state_(seed) {}
  uint32_t below(uint32_t n) { return static_cast<uint32_t>(bits() >> 33) % n; }
  // Moves on to another kind of pair; all of its points are of that kind.
  void next_pair() {
    kind_ = static_cast<int>(below(8));
    size_ = kind_ == 5 ? 1e-5 : 0.01;
    middle_ = kind_ == 6 ? Vec3(0.07, -0.05, 0.03) : Vec3(0, 0, 0);
    line_ = any();
    made_.clear();
  }
  int kind() const { return kind_; }
  Vec3 point() {
    Vec3 p = middle_ + size_ * any();
    if (kind_ == 1) p = lattice();                           // ties of all sorts
    if (kind_ == 2) p.z() = middle_.z();                     // one plane, exactly
    if (kind_ == 3) p = middle_ + size_ * number() * line_;  // one line, but for rounding
    if (kind_ == 4) p = middle_ + size_ * (number() * line_ + 1e-5 * any());  // needles
    if (kind_ == 7 && made_.size() > 1 && below(2) == 0) p = on_an_edge();
    made_.push_back(p);
    return p;
  }
  template <size_t N>
  std::array<Vec3, N> points() {
    std::array<Vec3, N> out;
    for (Vec3 &p : out) p = point();
    return out;
  }

 private:
  uint64_t bits() {  // xorshift64* (Vigna 2016)
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return state_ * 0x2545F4914F6CDD1D;
  }
  double number() { return static_cast<double>(bits() >> 11) * 0x1p-52 - 1; }
  Vec3 any() {
    const double x = number(), y = number();
    return Vec3(x, y, number());
  }
  Vec3 lattice() {
    const double x = below(5), y = below(5);
    return 0x1p-9 * Vec3(x, y, below(3));
  }
  // A corner of before, or the middle between two: contact at a corner or edge.
  Vec3 on_an_edge() {
    const Vec3 &p = made_[below(static_cast<uint32_t>(made_.size()))];
    const Vec3 &q = made_[below(static_cast<uint32_t>(made_.size()))];
    return 0.5 * (p + q);
  }

  uint64_t state_;
  int kind_ = 0;
  double size_ = 0;
  Vec3 middle_, line_;
  std::vector<Vec3> made_;
};

constexpr const char *kind_names[] = {"random", "lattice", "plane",   "line",
                                      "needle", "small",   "far off", "touching"};

}  // namespace mvs::core
