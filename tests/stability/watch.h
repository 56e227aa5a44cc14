// Plays a case through the public interface and checks every move by the same criteria: values stay
// finite, no step creates energy, no new crossing, convergence is reported truthfully, refused
// calls change nothing, and undo restores the first bits.
#pragma once

#include <mvs/experimental.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/stability/crossings.h"
#include "tests/stability/edge_work.h"

namespace stability {

using Hash = std::array<uint64_t, 2>;

// The solver that brings a case to rest: Newton or implicit Euler to rest, or live steps.
enum class SolverMode { newton, implicit, live };
const char *name_of(SolverMode mode);

// Limits of the work in a case.
struct Effort {
  uint32_t newton = 1000, implicit = 400, live = 200;  // iterations, steps, steps
  double dt = 1e-3;                                    // s, of implicit and live steps
  bool may_refuse = false;  // a start so absurd that MVS_E_DIVERGED is an answer
};

// The result of a case.
struct Verdict {
  uint32_t moves = 0;               // settles and steps
  double made = 0;                  // largest share of its energy that a step created
  double gained = 0;                // J, the most by which a settle ended above its start
  size_t crossed = 0;               // pairs of triangles that cross and did not before
  double residual = 0;              // N, of the last move, recomputed from the snapshot
  bool at_rest = false;             // recomputed as well
  uint32_t refused = 0;             // calls
  std::string sentence;             // of the last refusal
  std::vector<std::string> faults;  // criteria that were violated, each once

  bool passed() const { return faults.empty(); }
};

class Watch {
 public:
  Watch(SolverMode mode, const Effort &effort) : mode_(mode), effort_(effort) {}

  mvs::Simulator &sim() { return sim_; }
  SolverMode mode() const { return mode_; }
  const Effort &effort() const { return effort_; }

  // To be called once the start of the case is complete.
  void begin();

  // Applies an operation; returns true if the library accepted it.
  template <typename Op>
  bool operate(Op op, uint32_t kind) {
    op.op = {sizeof op, kind};
    return operate(&op.op);
  }
  bool operate(const mvs_op *op);
  // Makes a call that may be refused with a sentence; returns true if it was accepted.
  bool attempt(mvs_result result);

  // To be called when a tool was moved, added or removed: the energy of the next move is not
  // checked.
  void changed() {
    energy_is_known_ = false;
    tool_has_changed_ = true;
  }
  void load(double pressure, double boundary_fraction = 1);
  // Settles, or steps as often as the effort says.
  void rest();
  // False if it was refused.
  bool step(double dt);

  // The subject of the next faults: "chord P2/3".
  void about(const std::string &part) { about_ = part; }
  // Undoes every operation, back to the first bits.
  void take_back();
  // The same, and returns the result of the case.
  Verdict finish();
  // The result where an error was thrown.
  Verdict failed(const std::string &thrown);
  // Whether there is a valve: false where the start was refused.
  bool is_laid_out() const;

 private:
  void refuse(const char *what, const Hash &before);
  void settle(uint32_t solver, uint32_t iterations);
  void look_again();
  void look(const mvs_stats &stats);
  void compare_crossings(const mvs::Snapshot &now);
  void demand(bool condition, const std::string &fault);
  double potential_at_start();

  SolverMode mode_;
  Effort effort_;
  mvs::Simulator sim_;
  Verdict verdict_;
  std::string about_;
  Hash first_{};  // before the first operation, or at the start
  bool operated_ = false;
  // of the state before the present move
  std::vector<double> x_;
  std::vector<Pair> crossing_;
  double energy_ = 0;  // J, potential and kinetic
  bool tool_has_changed_ = false;
  bool energy_is_known_ = false;  // false after a change that is no move
};

}  // namespace stability
