// Pools of a session: each distinct sequence is stored once and referred to by number, so that undo
// levels cost only their differences.
#pragma once

#include <array>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/hash.h"
#include "base/types.h"
#include "formats/hdf5/tree.h"

namespace mvs::core {

// Writer: equal contents get equal numbers.
template <typename Value>
class PoolWriter {
 public:
  uint64_t add(const Value *first, size_t count) {
    Hash hash;
    hash.add(uint64_t{count});
    for (size_t k = 0; k < count; ++k) add_bits(hash, first[k]);
    const auto [place, is_new] = known_.try_emplace(hash.value(), ends_.size());
    if (!is_new && same(place->second, first, count)) return place->second;
    values_.insert(values_.end(), first, first + count);
    ends_.push_back(values_.size());
    return ends_.size() - 1;
  }

  void put_into(H5Tree &tree, const std::string &group) {
    tree.arrays[group + "/values"] = {std::move(values_)};
    tree.arrays[group + "/ends"] = {std::move(ends_)};
  }

 private:
  static void add_bits(Hash &hash, double value) { hash.add(value); }
  static void add_bits(Hash &hash, uint64_t value) { hash.add(value); }
  static void add_bits(Hash &hash, uint32_t value) { hash.add(uint64_t{value}); }
  static void add_bits(Hash &hash, uint8_t value) { hash.add(uint64_t{value}); }

  // Compares the contents: equal hashes do not prove equality.
  bool same(uint64_t number, const Value *first, size_t count) const {
    const uint64_t start = number == 0 ? 0 : ends_[number - 1];
    return ends_[number] - start == count &&
           (count == 0 || std::memcmp(&values_[start], first, count * sizeof(Value)) == 0);
  }

  std::vector<Value> values_;
  std::vector<uint64_t> ends_;
  std::map<std::array<uint64_t, 2>, uint64_t> known_;
};

// Reader; the tree must outlive it.
template <typename Value>
class PoolReader {
 public:
  PoolReader(const H5Tree &tree, const std::string &group)
      : group_(group),
        values_(tree.at<Value>(group + "/values")),
        ends_(tree.at<uint64_t>(group + "/ends")) {
    uint64_t last = 0;
    for (const uint64_t end : ends_) {
      MVS_MUST(end >= last && end <= values_.size(), MVS_E_FORMAT, group,
               "array %s/ends of the file does not ascend to the size of its values",
               group.c_str());
      last = end;
    }
    MVS_MUST(last == values_.size(), MVS_E_FORMAT, group,
             "array %s/ends of the file leaves values over", group.c_str());
  }

  std::span<const Value> at(uint64_t number) const {
    MVS_MUST(number < ends_.size(), MVS_E_FORMAT, group_,
             "the file refers to entry %llu of %s, which has %zu",
             static_cast<unsigned long long>(number), group_.c_str(), ends_.size());
    const uint64_t start = number == 0 ? 0 : ends_[number - 1];
    return {values_.data() + start, static_cast<size_t>(ends_[number] - start)};
  }

 private:
  std::string group_;
  const std::vector<Value> &values_;
  const std::vector<uint64_t> &ends_;
};

// The stored type and number of columns of an array element.
template <typename Element>
struct Stored {
  using Value = Element;
  static constexpr size_t columns = 1;
};
template <>
struct Stored<Vec3> {
  using Value = double;
  static constexpr size_t columns = 3;
};
template <>
struct Stored<std::array<double, 2>> {
  using Value = double;
  static constexpr size_t columns = 2;
};
template <>
struct Stored<Tri> {
  using Value = uint32_t;
  static constexpr size_t columns = 3;
};

}  // namespace mvs::core
