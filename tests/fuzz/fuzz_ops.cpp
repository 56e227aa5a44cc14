// Any bytes as a script of operations, undo, redo, settle, step, save and load, checkpoints: every
// call succeeds or leaves all bits as they were, undo and redo are exact, undoing everything gives
// the first valve, and no move leaves a number that is none or makes triangles cross. Without
// libFuzzer: `fuzz_ops SCRIPTS`, so many random scripts.
#include <mvs/mvs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "../stability/crossings.h"

namespace {

using Hash = std::array<uint64_t, 2>;

void demand(bool condition, const char *what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_ops: %s\n", what);
  std::abort();
}

// Bytes as numbers; zeros when they run out.
class Bytes {
 public:
  Bytes(const uint8_t *data, size_t size) : data_(data), size_(size) {}
  bool done() const { return size_ == 0; }
  uint32_t below(uint32_t limit) { return limit == 0 ? 0 : next() % limit; }
  double between(double low, double high) { return low + (high - low) * next() / 255.0; }

 private:
  uint8_t next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  const uint8_t *data_;
  size_t size_;
};

// Builds an operation from its description: parts that are there, values in and out of range.
class Builder {
 public:
  Builder(const mvs::Snapshot &valve, Bytes &bytes) : valve_(valve), bytes_(bytes) {}

  const mvs_op *build() {
    const uint32_t index = bytes_.below(mvs_op_count());
    mvs_op_info info = mvs::sized<mvs_op_info>();
    mvs::must(mvs_op_describe(index, &info));
    words_.assign((info.size + 7) / 8, 0);
    put(mvs_op{info.size, info.kind}, 0);
    for (uint32_t f = 0; f < info.fields; ++f) {
      mvs_field_info field = mvs::sized<mvs_field_info>();
      mvs::must(mvs_op_describe_field(index, f, &field));
      // what may be left out is left out half the time
      if (field.required || bytes_.below(2)) fill(field);
    }
    return reinterpret_cast<const mvs_op *>(words_.data());
  }

 private:
  template <typename Value>
  void put(const Value &value, uint32_t offset) {
    std::memcpy(reinterpret_cast<char *>(words_.data()) + offset, &value, sizeof value);
  }

  mvs_id part(uint32_t kind) {
    const std::vector<mvs_part> parts = valve_.parts(kind);
    if (parts.empty() || bytes_.below(32) == 0) return bytes_.below(200);
    return parts[bytes_.below(static_cast<uint32_t>(parts.size()))].id;
  }

  mvs_site site() {
    mvs_site s = {};
    s.how = 1 + bytes_.below(3);
    s.index = bytes_.below(250) * (1 + bytes_.below(2));
    if (s.how == MVS_SITE_TRIANGLE) {
      s.u[0] = bytes_.between(0, 1);
      s.u[1] = (1 - s.u[0]) * bytes_.between(0, 1);
      s.u[2] = 1 - s.u[0] - s.u[1];
    } else if (s.how == MVS_SITE_ANATOMICAL) {
      s.scallop = part(MVS_PART_SCALLOP);
      s.u[0] = bytes_.between(0, 1);
      s.u[1] = bytes_.between(0, 1);
    }
    return s;
  }

  // Mostly well inside the range, on a scale of factors where the range is wide.
  double number(const mvs_field_info &f) {
    const double share = bytes_.between(0, 1);
    if (f.low > 0) return f.low * std::pow(f.high / f.low, share);
    return f.low + share * (f.high - f.low);
  }

  void fill(const mvs_field_info &f) {
    switch (f.type) {
      case MVS_FIELD_NUMBER:
        return put(number(f), f.offset);
      case MVS_FIELD_COUNT:
      case MVS_FIELD_CHOICE:
        return put(static_cast<uint32_t>(number(f)), f.offset);
      case MVS_FIELD_CHORD:
        return put(part(MVS_PART_CHORD), f.offset);
      case MVS_FIELD_HEAD:
        return put(part(MVS_PART_HEAD), f.offset);
      case MVS_FIELD_SCALLOP:
        return put(part(MVS_PART_SCALLOP), f.offset);
      case MVS_FIELD_SITE:
        return put(site(), f.offset);
      case MVS_FIELD_POINT:
        return put(mvs_point{{bytes_.between(-0.02, 0.02), bytes_.between(-0.02, 0.02),
                              bytes_.between(-0.03, 0.01)},
                             1,
                             0},
                   f.offset);
      case MVS_FIELD_VECTOR:
        return put(std::array<double, 3>{bytes_.between(-0.01, 0.01), bytes_.between(-0.01, 0.01),
                                         bytes_.between(-0.01, 0.01)},
                   f.offset);
      case MVS_FIELD_POINTS:
        points_.push_back(std::make_unique<std::vector<double>>());
        for (uint32_t k = 3 * bytes_.below(12); k > 0; --k) {
          points_.back()->push_back(bytes_.between(-0.02, 0.02));
        }
        return put(mvs_array{points_.back()->data(), points_.back()->size() / 3, 3, MVS_F64, 0},
                   f.offset);
      default:
        return put(bytes_.below(2) ? "a name" : "another", f.offset);
    }
  }

  const mvs::Snapshot &valve_;
  Bytes &bytes_;
  std::vector<uint64_t> words_;
  std::vector<std::unique_ptr<std::vector<double>>> points_;
};

// A simulator, and what is known about its history.
class Script {
 public:
  explicit Script(const uint8_t *data, size_t size) : bytes_(data, size) {
    mvs_parametric_desc desc = {};
    desc.vertices = 200;
    desc.chords = 30;
    desc.branching = bytes_.below(2);
    sim_.generate(desc);
    first_ = undone_ = hash();
  }

  void run() {
    for (int k = 0; k < 40 && !bytes_.done(); ++k) {
      act();
      if (history().done == 0) first_ = hash();
    }
    while (mvs_undo(sim_.get()) == MVS_OK) {
    }
    demand(hash() == first_, "undoing everything did not give what was before the first operation");
  }

 private:
  Hash hash() const {
    const auto found = sim_.snapshot().hash();
    return {found[0], found[1]};
  }

  mvs_history history() const {
    mvs_history out = mvs::sized<mvs_history>();
    mvs::must(mvs_snapshot_history(sim_.snapshot().get(), &out));
    return out;
  }

  void act() {
    switch (bytes_.below(10)) {
      case 0:
        return undo();
      case 1:
        return redo();
      case 2:
        return settle();
      case 3:
        return step();
      case 4:
        return save_and_load();
      case 5:
        return checkpoint();
      default:
        return operate();
    }
  }

  // Check and apply agree; a refusal changes nothing; undo gives what was before, redo what was
  // after.
  void operate() {
    const mvs::Snapshot valve = sim_.snapshot();
    Builder builder(valve, bytes_);
    const mvs_op *op = builder.build();
    const Hash before = hash();
    const uint32_t done = history().done;
    const mvs_result checked = mvs_check_op(sim_.get(), op);
    demand(hash() == before, "a check changed something");
    const mvs_result applied = mvs_apply_op(sim_.get(), op, nullptr);
    demand(checked == applied, "check and apply disagree");
    if (applied != MVS_OK) {
      demand(applied == MVS_E_OP || applied == MVS_E_ID || applied == MVS_E_ARGUMENT,
             mvs_last_error()->message);
      demand(hash() == before && history().done == done, "a refused operation changed something");
      return;
    }
    const Hash after = hash();
    mvs::must(mvs_undo(sim_.get()));
    demand(hash() == before, "undo did not give the bits before");
    mvs::must(mvs_redo(sim_.get()));
    demand(hash() == after, "redo did not give the bits after");
  }

  void undo() {
    const bool any = history().done > 0;
    demand((mvs_undo(sim_.get()) == MVS_OK) == any, "undo where there is none, or none where");
    if (any && history().done == 0) undone_ = hash();
  }
  void redo() {
    const mvs_history before = history();
    const bool any = before.undone > 0;
    demand((mvs_redo(sim_.get()) == MVS_OK) == any, "redo where there is none, or none where");
    if (any && before.done == 0) first_ = undone_;
  }

  void settle() {
    sim_.set_load(bytes_.between(0, 20e3), bytes_.between(0, 1));
    mvs_settle_options options = mvs::sized<mvs_settle_options>();
    options.max_iterations = 3;
    move([&] { return mvs_settle(sim_.get(), &options, nullptr); });
  }

  void step() {
    move([&] { return mvs_step(sim_.get(), nullptr); });
  }

  // What crosses after a move crossed before it: operations may make triangles cross, moves not.
  template <typename Call>
  void move(Call &&call) {
    const std::vector<stability::Pair> before = crossing();
    tolerate(call());
    const std::vector<stability::Pair> after = crossing();
    demand(std::includes(before.begin(), before.end(), after.begin(), after.end()),
           "a move made triangles cross");
  }

  std::vector<stability::Pair> crossing() const {
    const mvs::Snapshot now = sim_.snapshot();
    const auto x = now.view<double>(MVS_NODE_POSITION);
    const auto triangles = now.view<uint32_t>(MVS_TRIANGLE_NODES);
    demand(std::all_of(x.begin(), x.end(), [](double v) { return std::isfinite(v); }),
           "a place is no number");
    return stability::crossings(x.data(), x.rows(), triangles.data(), triangles.rows());
  }

  // An operation may make a valve whose forces overflow; that is told, and changes nothing.
  void tolerate(mvs_result result) {
    demand(result == MVS_OK || result == MVS_E_DIVERGED, mvs_last_error()->message);
  }

  // A copy made by way of a file goes on to the same bits.
  void save_and_load() {
    const mvs::Snapshot valve = sim_.snapshot();
    mvs::Sim copy;
    const bool whole = bytes_.below(2) == 1 && std::strstr(mvs_features(), "hdf5");
    const uint32_t how = whole ? MVS_FORMAT_H5 : MVS_FORMAT_OBJ;
    copy.load_memory(valve.save_memory(how), how);
    demand(copy.snapshot().hash() == valve.hash(), "the valve changed on its way through a file");
    const std::string plan = valve.plan();
    demand(mvs_step(copy.get(), nullptr) == mvs_step(sim_.get(), nullptr),
           "the copy does not step as the original does");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy went another way");
    if (!whole) return;
    // a file of the second kind has the history too
    undo();
    demand(mvs_undo(copy.get()) == MVS_OK || history().done == 0, "the copy has no history");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy undid something else");
    redo();
    demand(mvs_redo(copy.get()) == MVS_OK || history().undone == 0, "the copy has no future");
    demand(copy.snapshot().hash() == sim_.snapshot().hash(), "the copy redid something else");
  }

  void checkpoint() {
    if (bytes_.below(2) == 0) {
      mvs::must(mvs_set_checkpoint(sim_.get(), "here"));
      kept_ = {hash(), first_, undone_};
      return;
    }
    const mvs_result result = mvs_restore_checkpoint(sim_.get(), "here");
    demand((result == MVS_OK) == (kept_.size() == 3), mvs_last_error()->message);
    if (result != MVS_OK) return;
    demand(hash() == kept_[0], "a checkpoint came back with other bits");
    first_ = kept_[1];
    undone_ = kept_[2];
  }

  mvs::Sim sim_;
  Bytes bytes_;
  Hash first_{};            // what undoing everything has to give: before the first operation
  Hash undone_{};           // the same for what can be redone from there
  std::vector<Hash> kept_;  // of the checkpoint: its own, and both of the above
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  Script(data, size).run();
  return 0;
}

#ifndef MVS_LIBFUZZER
int main(int argc, char **argv) {
  const char *lengthy = std::getenv("MVS_TEST_LONG");
  const int given = argc > 1 ? std::atoi(argv[1]) : 100;
  const int scripts = lengthy && *lengthy ? 10000 : given;
  for (int seed = 0; seed < scripts; ++seed) {
    std::mt19937 random(static_cast<uint32_t>(seed));
    std::vector<uint8_t> bytes(600);
    for (uint8_t &byte : bytes) byte = static_cast<uint8_t>(random());
    std::fprintf(stderr, "\rscript %d", seed);
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::fprintf(stderr, "\r%d scripts, every hash as it has to be\n", scripts);
  return 0;
}
#endif
