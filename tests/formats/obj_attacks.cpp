// Damaged OBJ files and failing allocations: always a clean error or a valid valve. The four sweeps
// of ufbx: truncate at every byte, change every byte, remove every line, fail every allocation.
#include <array>
#include <cstdlib>
#include <new>

#include "formats/hdf5/tree.h"
#include "tests/formats/samples.h"

using namespace mvs::core;

namespace {

// Allocations until one fails, counted only while a test asks for it.
long allocations_left = -1;
long allocations_alive = 0;

void *allocate(size_t size) {
  if (allocations_left == 0) throw std::bad_alloc();
  if (allocations_left > 0) --allocations_left;
  void *const memory = std::malloc(size == 0 ? 1 : size);
  if (!memory) throw std::bad_alloc();
  ++allocations_alive;
  return memory;
}

void release(void *memory) {
  if (!memory) return;
  --allocations_alive;
  std::free(memory);
}

std::string small_text() {
  const Pair pair = moving_example();
  return write_obj(pair.model, pair.state);
}

// Reads a text; returns MVS_OK, or the code of a clean error.
mvs_result outcome(std::string_view text) {
  try {
    const Loaded loaded = read_obj(text);
    make_model(loaded.valve);
    return MVS_OK;
  } catch (const Error &error) {
    CHECK(error.what()[0] != '\0');
    CHECK((error.code == MVS_E_OP || error.line > 0 || text.empty()));
    return error.code;
  }
}

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();) {
    const size_t stop = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, stop - at));
    at = stop;
  }
  return lines;
}

// Runs `work` with the first, the second, ... allocation failing, until none fails. Errors of the
// work itself count as success.
template <typename Work>
long fail_every_allocation(Work work) {
  for (long n = 0;; ++n) {
    const long alive = allocations_alive;
    bool failed = false;
    allocations_left = n;
    try {
      work();
    } catch (const std::bad_alloc &) {
      failed = true;
    } catch (const Error &) {
      failed = allocations_left == 0;
    }
    allocations_left = -1;
    REQUIRE(allocations_alive == alive);
    if (!failed) return n;
  }
}

}  // namespace

void *operator new(size_t size) {
  return allocate(size);
}
void *operator new[](size_t size) {
  return allocate(size);
}
// std::stable_sort allocates its buffer through this operator
void *operator new(size_t size, const std::nothrow_t &) noexcept {
  try {
    return allocate(size);
  } catch (const std::bad_alloc &) {
    return nullptr;
  }
}
void operator delete(void *memory) noexcept {
  release(memory);
}
void operator delete[](void *memory) noexcept {
  release(memory);
}
void operator delete(void *memory, size_t) noexcept {
  release(memory);
}
void operator delete[](void *memory, size_t) noexcept {
  release(memory);
}

TEST_CASE("a_file_truncated_at_any_byte_is_refused") {
  const std::string text = small_text();
  // without its last line end the file is complete
  CHECK(outcome(text) == MVS_OK);
  CHECK(outcome(std::string_view(text).substr(0, text.size() - 1)) == MVS_OK);
  for (size_t size = 0; size + 1 < text.size(); ++size) {
    CAPTURE(size);
    CHECK(outcome(std::string_view(text).substr(0, size)) == MVS_E_FORMAT);
  }
}

TEST_CASE("a_missing_or_repeated_line_is_refused") {
  const std::vector<std::string> lines = lines_of(small_text());
  for (size_t changed = 0; changed < lines.size(); ++changed) {
    if (lines[changed].starts_with("# ")) continue;
    std::string without, doubled;
    for (size_t k = 0; k < lines.size(); ++k) {
      if (k != changed) without += lines[k];
      doubled += lines[k] + (k == changed ? lines[k] : "");
    }
    CAPTURE(lines[changed]);
    CHECK(outcome(without) == MVS_E_FORMAT);
    CHECK(outcome(doubled) == MVS_E_FORMAT);
  }
}

TEST_CASE("any_changed_byte_gives_a_valve_or_a_clean_error") {
  std::string text = small_text();
  std::array<size_t, 2> seen{};
  for (char &byte : text) {
    const char before = byte;
    const int value = static_cast<unsigned char>(before);
    for (const int instead : {value + 1, value - 1, 0, 255}) {
      byte = static_cast<char>(instead);
      const mvs_result code = outcome(text);
      CHECK((code == MVS_OK || code == MVS_E_FORMAT || code == MVS_E_VERSION || code == MVS_E_OP));
      ++seen[code == MVS_OK ? 0 : 1];
    }
    byte = before;
  }
  MESSAGE(seen[0] << " changes gave a valve, " << seen[1] << " an error");
  CHECK(seen[0] > 0);
  CHECK(seen[1] > 0);
}

TEST_CASE("any_allocation_of_obj_files_may_fail") {
  const Pair pair = moving_valve();
  const std::string text = write_obj(pair.model, pair.state);
  const std::string bad = text.substr(0, text.size() / 2);
  const std::vector<VtpArray> arrays = {
      {"points", true, 1, std::vector<double>(pair.model.node_count(), 1.5)}};
  const std::string path = "any_allocation_may_fail.obj";
  // the minimum number of allocations: fewer would mean that nothing was tested; write_obj reserves
  // the whole text at once
  CHECK(fail_every_allocation([&] { read_obj(text); }) > 50);
  CHECK(fail_every_allocation([&] { read_obj(bad); }) > 50);
  CHECK(fail_every_allocation([&] { write_obj(pair.model, pair.state); }) > 0);
  CHECK(fail_every_allocation([&] { write_vtp(pair.model, pair.state, arrays); }) > 50);
  CHECK(fail_every_allocation([&] { write_whole_file(path, text); }) > 0);
  CHECK(fail_every_allocation([&] { read_whole_file(path); }) > 0);
  CHECK(read_whole_file(path) == text);
  std::remove(path.c_str());
}

#ifdef MVS_HAVE_HDF5
TEST_CASE("any_allocation_of_an_hdf5_file_may_fail") {
  H5Tree tree;
  tree.arrays["mvs/some/x"] = {std::vector<double>(30, 1.5), 3};
  tree.arrays["other/names"] = {std::vector<std::string>{"A", "P"}};
  tree.attributes[{"other", "text"}] = {"a text that no short string holds in itself"};
  const std::string bytes = write_h5(tree, 1);
  // HDF5 itself takes its memory from malloc, which does not fail here
  CHECK(fail_every_allocation([&] { write_h5(tree, 1); }) > 4);
  CHECK(fail_every_allocation([&] { read_h5(bytes, "mvs", 1); }) > 3);
  CHECK(write_h5(tree, 1) == bytes);
}
#endif
