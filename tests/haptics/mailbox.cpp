// Hand-over between threads: no torn value, the order preserved, every lost value counted.
#include "haptics/mailbox.h"

#include <doctest/doctest.h>

#include <thread>

using namespace mvs::core;

namespace {

// A value is torn if its words differ.
struct Words {
  std::array<uint64_t, 8> word = {};
  static Words of(uint64_t number) {
    Words words;
    words.word.fill(number);
    return words;
  }
  bool whole() const {
    for (const uint64_t w : word) {
      if (w != word[0]) return false;
    }
    return true;
  }
};

constexpr uint64_t last = 200000;

// Runs write(1) ... write(last) beside read(), which returns true when it has seen the end; `wrong`
// counts errors, since doctest is too slow for a loop of this length.
template <typename Write, typename Read>
void race(Write write, Read read) {
  std::thread writer([&] {
    for (uint64_t k = 1; k <= last; ++k) write(k);
  });
  while (!read()) {
  }
  writer.join();
}

}  // namespace

TEST_CASE("a mailbox returns the newest value, whole, and each at most once as new") {
  Mailbox<Words> box;
  CHECK_FALSE(box.refresh());
  uint64_t before = 0, wrong = 0, seen = 0;
  race([&](uint64_t k) { box.post(Words::of(k)); },
       [&] {
         if (!box.refresh()) return false;
         const Words &now = box.get();
         wrong += !now.whole() || now.word[0] <= before;
         before = now.word[0];
         ++seen;
         return before == last;
       });
  CHECK_EQ(wrong, 0);
  CHECK_GT(seen, 0);
  CHECK_FALSE(box.refresh());
}

TEST_CASE("a queue returns all values in order, and refuses a value when it is full") {
  Queue<Words, 64> queue;
  uint64_t before = 0, wrong = 0;
  race(
      [&](uint64_t k) {
        while (!queue.push(Words::of(k))) std::this_thread::yield();
      },
      [&] {
        Words now;
        if (!queue.pop(now)) return false;
        wrong += !now.whole() || now.word[0] != before + 1;
        before = now.word[0];
        return before == last;
      });
  CHECK_EQ(wrong, 0);
  for (int k = 0; k < 64; ++k) CHECK(queue.push({}));
  CHECK_FALSE(queue.push({}));
}

TEST_CASE("a trace returns values whole and in order, and counts lost ones") {
  Trace<Words, 64> trace;
  uint64_t before = 0, wrong = 0, lost = 0, seen = 0;
  race([&](uint64_t k) { trace.push(Words::of(k)); },
       [&] {
         Words now;
         if (!trace.pop(now, lost)) return false;
         ++seen;
         wrong += !now.whole() || now.word[0] != seen + lost || now.word[0] <= before;
         before = now.word[0];
         return before == last;
       });
  CHECK_EQ(wrong, 0);
  CHECK_EQ(seen + lost, last);
}

TEST_CASE("an unread trace keeps the newest values") {
  Trace<Words, 64> trace;
  for (uint64_t k = 1; k <= 200; ++k) trace.push(Words::of(k));
  Words now;
  uint64_t lost = 0;
  REQUIRE(trace.pop(now, lost));
  CHECK_EQ(lost, 200 - 63);  // the oldest slot may be written to at any time
  CHECK_EQ(now.word[0], lost + 1);
}
