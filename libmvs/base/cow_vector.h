// Copy-on-write vector: copies share a buffer until one changes, so that snapshots are cheap.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <type_traits>
#include <utility>
#include <vector>

namespace mvs::core {

// Has the interface of std::vector. Reading never copies; the first change to a copy does. Hot
// loops read through a const reference: a non-const operator[] or begin() counts as a change.
// Copies may live in different threads; one object belongs to one thread at a time.
template <typename T>
class CowVector {
 public:
  using value_type = T;
  using Vector = std::vector<T>;

  CowVector() = default;
  CowVector(Vector items) : block_(items.empty() ? nullptr : new Block(std::move(items))) {}
  CowVector(std::initializer_list<T> items) : CowVector(Vector(items)) {}
  CowVector(const CowVector &other) : block_(other.block_) {
    if (block_) block_->owners.fetch_add(1, std::memory_order_relaxed);
  }
  CowVector(CowVector &&other) noexcept : block_(std::exchange(other.block_, nullptr)) {}
  CowVector &operator=(CowVector other) noexcept {
    std::swap(block_, other.block_);
    return *this;
  }
  ~CowVector() { drop(); }

  const Vector &get() const { return block_ ? block_->items : nothing(); }
  operator const Vector &() const { return get(); }
  size_t size() const { return get().size(); }
  bool empty() const { return size() == 0; }
  const T &operator[](size_t i) const { return get()[i]; }
  const T &front() const { return get().front(); }
  const T &back() const { return get().back(); }
  const T *data() const { return get().data(); }
  auto begin() const { return get().begin(); }
  auto end() const { return get().end(); }

  // Returns the items for changes. From then on this object owns them alone.
  Vector &edit() {
    if (!block_) {
      block_ = new Block(Vector());
    } else if (block_->owners.load(std::memory_order_acquire) != 1) {
      Block *copy = new Block(block_->items);
      drop();
      block_ = copy;
    }
    return block_->items;
  }
  T &operator[](size_t i) { return edit()[i]; }
  T &front() { return edit().front(); }
  T &back() { return edit().back(); }
  T *data() { return edit().data(); }
  auto begin() { return edit().begin(); }
  auto end() { return edit().end(); }
  void push_back(T item) { edit().push_back(std::move(item)); }
  void resize(size_t size) { edit().resize(size); }
  void reserve(size_t size) { edit().reserve(size); }
  void resize(size_t size, const T &item) { edit().resize(size, item); }
  void assign(size_t size, const T &item) { edit().assign(size, item); }
  template <typename Iterator>
  void assign(Iterator first, Iterator last) {
    edit().assign(first, last);
  }
  void clear() { *this = CowVector(); }
  void pop_back() { edit().pop_back(); }
  template <typename... Arguments>
  auto insert(Arguments &&...arguments) {
    return edit().insert(std::forward<Arguments>(arguments)...);
  }
  template <typename... Arguments>
  auto erase(Arguments &&...arguments) {
    return edit().erase(std::forward<Arguments>(arguments)...);
  }

  // Shares the buffer of `other` if it holds the same items, bit for bit. Returns whether it does.
  bool share_with(const CowVector &other) {
    if (block_ == other.block_) return true;
    if (!same_bits(get(), other.get())) return false;
    *this = other;
    return true;
  }
  // Returns whether a change would copy nothing.
  bool is_alone() const { return !block_ || block_->owners.load(std::memory_order_acquire) == 1; }
  // Returns the address of the buffer: equal for vectors that share it, null for an empty one.
  const void *buffer() const { return block_; }

  friend bool operator==(const CowVector &a, const CowVector &b) {
    return a.block_ == b.block_ || a.get() == b.get();
  }

 private:
  struct Block {
    explicit Block(Vector items_in) : items(std::move(items_in)) {}
    std::atomic<uint32_t> owners{1};
    Vector items;
  };

  static const Vector &nothing() {
    static const Vector empty;
    return empty;
  }
  // Compares numbers by their bits (-0.0 is not 0.0), other types by their operator ==.
  static bool same_bits(const Vector &a, const Vector &b) {
    if (a.size() != b.size()) return false;
    if constexpr (std::has_unique_object_representations_v<T> || is_numbers<T>) {
      return a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
    } else {
      return a == b;
    }
  }
  // Floating-point numbers and Eigen's fixed vectors of them: no padding.
  template <typename U>
  static constexpr bool is_numbers = std::is_floating_point_v<U> || requires {
    typename U::Scalar;
  };

  void drop() {
    if (block_ && block_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) delete block_;
    block_ = nullptr;
  }

  Block *block_ = nullptr;
};

}  // namespace mvs::core
