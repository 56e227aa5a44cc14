// Replaces the global operator new and delete of the process, also for the library.
#include "tests/fault/allocator.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local long until_failure = 0, made_so_far = 0, living = 0;
thread_local bool failed = false;

void *allocate(std::size_t size, std::size_t alignment) noexcept {
  if (until_failure > 0 && --until_failure == 0) {
    failed = true;
    until_failure = 1;  // memory does not come back by asking again
  }
  if (failed) return nullptr;
  ++made_so_far;
  // aligned_alloc wants a multiple of the alignment
  const std::size_t rounded = (size + alignment) / alignment * alignment;
  void *made = alignment > alignof(std::max_align_t) ? std::aligned_alloc(alignment, rounded)
                                                     : std::malloc(rounded);
  if (made) ++living;
  return made;
}

void *allocate_or_throw(std::size_t size, std::size_t alignment) {
  void *made = allocate(size, alignment);
  if (!made) throw std::bad_alloc();
  return made;
}

void release(void *made) noexcept {
  if (made) --living;
  std::free(made);
}

}  // namespace

namespace fault {

void fail_from(long n) {
  until_failure = n;
  made_so_far = 0;
  failed = false;
}
bool has_failed() {
  return failed;
}
long allocations() {
  return made_so_far;
}
long alive() {
  return living;
}

}  // namespace fault

void *operator new(std::size_t size) {
  return allocate_or_throw(size, alignof(std::max_align_t));
}
void *operator new[](std::size_t size) {
  return allocate_or_throw(size, alignof(std::max_align_t));
}
void *operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void *operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept {
  return allocate(size, alignof(std::max_align_t));
}
void operator delete(void *made) noexcept {
  release(made);
}
void operator delete[](void *made) noexcept {
  release(made);
}
void operator delete(void *made, std::size_t) noexcept {
  release(made);
}
void operator delete[](void *made, std::size_t) noexcept {
  release(made);
}
void operator delete(void *made, std::align_val_t) noexcept {
  release(made);
}
void operator delete[](void *made, std::align_val_t) noexcept {
  release(made);
}
void operator delete(void *made, std::size_t, std::align_val_t) noexcept {
  release(made);
}
void operator delete[](void *made, std::size_t, std::align_val_t) noexcept {
  release(made);
}
