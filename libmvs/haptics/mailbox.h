// Lock-free single-producer single-consumer channels: newest value, queue, overwriting trace.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>

namespace mvs::core {

// The newest value, by triple buffering: the writer owns one slot, the reader one, and an atomic
// exchange hands over the third.
template <typename Value>
class Mailbox {
 public:
  void post(const Value &value) {
    place_[writing_] = value;
    writing_ = shared_.exchange(writing_ | is_new, std::memory_order_acq_rel) & ~is_new;
  }

  // Takes the newest value if there is one since the last call; returns whether there was.
  bool refresh() {
    if (!(shared_.load(std::memory_order_relaxed) & is_new)) return false;
    reading_ = shared_.exchange(reading_, std::memory_order_acq_rel) & ~is_new;
    return true;
  }
  // Returns the value of the last refresh(); a Value{} before the first.
  const Value &get() const { return place_[reading_]; }

 private:
  static constexpr uint32_t is_new = 4;
  std::array<Value, 3> place_ = {};
  uint32_t writing_ = 0, reading_ = 1;
  std::atomic<uint32_t> shared_{2};
};

// Bounded ring buffer: values in order; push() returns false if it is full.
template <typename Value, uint32_t Size>
class Queue {
 public:
  bool push(const Value &value) {
    const uint32_t end = end_.load(std::memory_order_relaxed);
    if (end - start_.load(std::memory_order_acquire) == Size) return false;
    place_[end % Size] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }

  bool pop(Value &value) {
    const uint32_t start = start_.load(std::memory_order_relaxed);
    if (start == end_.load(std::memory_order_acquire)) return false;
    value = place_[start % Size];
    start_.store(start + 1, std::memory_order_release);
    return true;
  }

 private:
  static_assert((Size & (Size - 1)) == 0, "counters wrap around");
  std::array<Value, Size> place_ = {};
  std::atomic<uint32_t> start_{0}, end_{0};
};

// The last `Size` values: the writer overwrites, and the reader counts the values it lost. Values
// are stored as atomic words, readable during a write; the reader discards a torn value.
template <typename Value, uint64_t Size>
class Trace {
 public:
  void push(const Value &value) {
    const uint64_t end = end_.load(std::memory_order_relaxed);
    std::array<uint64_t, words> bits;
    std::memcpy(bits.data(), &value, sizeof value);
    Place &place = places_[end % Size];
    // release: a reader that sees a word of this value also sees the previous value complete
    for (size_t k = 0; k < words; ++k) place[k].store(bits[k], std::memory_order_release);
    end_.store(end + 1, std::memory_order_release);
  }

  // Takes the next value; returns false if the trace is empty. Adds the number of overwritten
  // values to `lost`.
  bool pop(Value &value, uint64_t &lost) {
    for (;;) {
      const uint64_t end = end_.load(std::memory_order_acquire);
      if (next_ == end) return false;
      skip_to(end, lost);
      std::array<uint64_t, words> bits;
      const Place &place = places_[next_ % Size];
      for (size_t k = 0; k < words; ++k) bits[k] = place[k].load(std::memory_order_acquire);
      // the writer may be writing the slot of value `end_`
      if (end_.load(std::memory_order_acquire) - next_ >= Size) continue;
      std::memcpy(static_cast<void *>(&value), bits.data(), sizeof value);
      ++next_;
      return true;
    }
  }

 private:
  static_assert(std::is_trivially_copyable_v<Value> && sizeof(Value) % 8 == 0);
  static constexpr size_t words = sizeof(Value) / 8;
  using Place = std::array<std::atomic<uint64_t>, words>;

  void skip_to(uint64_t end, uint64_t &lost) {
    if (end - next_ < Size) return;
    const uint64_t first = end - Size + 1;
    lost += first - next_;
    next_ = first;
  }

  std::unique_ptr<Place[]> places_ = std::make_unique<Place[]>(Size);
  std::atomic<uint64_t> end_{0};
  uint64_t next_ = 0;
};

}  // namespace mvs::core
