// Plays a case through the public interface and holds every move of it to the same demands: numbers
// stay finite, no step makes energy, nothing crosses that did not cross before, rest is told as it
// is, what is refused changes nothing, and undo leads back to the first bits.
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

// How a case comes to rest.
enum class Way { newton, implicit, live };
const char *name_of(Way way);

// How much a case may work.
struct Effort {
  uint32_t newton = 1000, implicit = 400, live = 200;  // iterations, steps, steps
  double dt = 1e-3;                                    // s, of implicit and live steps
  bool may_refuse = false;  // a start so absurd that MVS_E_DIVERGED is an answer
};

// What came of a case.
struct Verdict {
  uint32_t moves = 0;               // settles and steps
  double made = 0;                  // largest share of its energy that a step made out of nothing
  double gained = 0;                // J, the most that a settle ended above where it began
  size_t crossed = 0;               // pairs of triangles that cross and did not before
  double residual = 0;              // N, of the last move, recomputed from the snapshot
  bool at_rest = false;             // the same of rest
  uint32_t refused = 0;             // calls
  std::string sentence;             // of the last refusal
  std::vector<std::string> faults;  // demands that were not met, each once

  bool passed() const { return faults.empty(); }
};

class Watch {
 public:
  Watch(Way way, const Effort &effort) : way_(way), effort_(effort) {}

  mvs::Sim &sim() { return sim_; }
  Way way() const { return way_; }
  const Effort &effort() const { return effort_; }

  // To be called once the valve lies as the case starts.
  void begin();

  // Applies an operation unless the library refuses it; true when it was applied.
  template <typename Op>
  bool operate(Op op, uint32_t kind) {
    op.op = {sizeof op, kind};
    return operate(&op.op);
  }
  bool operate(const mvs_op *op);
  // A call that may be refused with a sentence; true when it was not.
  bool attempt(mvs_result result);

  // A tool has moved, come or gone: the next move is not asked for energy.
  void changed() {
    energy_is_known_ = false;
    tool_has_changed_ = true;
  }
  void load(double pressure, double boundary_fraction = 1);
  // Settles, or steps as often as the effort says.
  void rest();
  // False if it was refused.
  bool step(double dt);

  // What the next faults are about: "chord P2/3".
  void about(const std::string &part) { about_ = part; }
  // Undoes every operation, back to the first bits.
  void take_back();
  // The same, and says how the case went.
  Verdict finish();
  // How it went where something was thrown.
  Verdict failed(const std::string &thrown);
  // Whether there is a valve: false where the start itself was refused.
  bool is_laid_out() const;

 private:
  void refuse(const char *what, const Hash &before);
  void settle(uint32_t solver, uint32_t iterations);
  void look_again();
  void look(const mvs_stats &stats);
  void compare_crossings(const mvs::Snapshot &now);
  void demand(bool condition, const std::string &fault);
  double potential_at_start();

  Way way_;
  Effort effort_;
  mvs::Sim sim_;
  Verdict verdict_;
  std::string about_;
  Hash first_{};  // before the first operation, or at the start
  bool operated_ = false;
  // of the state before the move at hand
  std::vector<double> x_;
  std::vector<Pair> crossing_;
  double energy_ = 0;  // J, potential and kinetic
  bool tool_has_changed_ = false;
  bool energy_is_known_ = false;  // false where something but a move has changed since
};

}  // namespace stability
