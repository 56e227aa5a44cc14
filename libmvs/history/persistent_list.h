// A persistent (immutable, structurally shared) singly linked list: push and pop return new lists
// in O(1), and an undo level costs only its own item.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace mvs::core {

template <typename T>
class PersistentList {
 public:
  bool empty() const { return cell_ == nullptr; }
  size_t size() const { return cell_ ? cell_->size : 0; }
  const T &top() const { return cell_->value; }
  // Returns the list without its top item.
  PersistentList popped() const { return PersistentList(cell_->below); }
  // Returns the list with one more item on top.
  PersistentList pushed(T value) const {
    return PersistentList(std::make_shared<Cell>(std::move(value), cell_, size() + 1));
  }
  // Returns all items, from the bottom to the top; the pointers are valid while this list is.
  std::vector<const T *> items() const {
    std::vector<const T *> all(size());
    size_t k = all.size();
    for (const Cell *c = cell_.get(); c; c = c->below.get()) all[--k] = &c->value;
    return all;
  }

  PersistentList() = default;

 private:
  struct Cell {
    Cell(T value_in, std::shared_ptr<Cell> below_in, size_t size_in)
        : value(std::move(value_in)), below(std::move(below_in)), size(size_in) {}
    Cell(const Cell &) = delete;
    Cell &operator=(const Cell &) = delete;
    // iterative, because the destructor of thousands of cells would recurse as deep
    ~Cell() {
      std::shared_ptr<Cell> next = std::move(below);
      while (next && next.use_count() == 1) next = std::shared_ptr<Cell>(std::move(next->below));
    }
    T value;
    std::shared_ptr<Cell> below;
    size_t size;
  };

  explicit PersistentList(std::shared_ptr<Cell> cell) : cell_(std::move(cell)) {}

  std::shared_ptr<Cell> cell_;
};

}  // namespace mvs::core
