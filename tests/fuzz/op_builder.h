// Bytes as numbers and as operations: existing parts, values in and out of range.
#pragma once

#include <mvs/op.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mvs/mvs.hpp>
#include <vector>

namespace fuzz {

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

// Builds an operation from its description.
class Builder {
 public:
  Builder(const mvs::Snapshot &valve, Bytes &bytes) : valve_(valve), bytes_(bytes) {}

  const mvs_op *build() {
    const uint32_t index = bytes_.below(mvs_get_op_count());
    mvs_op_info info = mvs::sized<mvs_op_info>();
    mvs::must(mvs_get_op_info(index, &info));
    words_.assign((info.size + 7) / 8, 0);
    put(mvs_op{info.size, info.kind}, 0);
    for (uint32_t f = 0; f < info.fields; ++f) {
      mvs_field_info field = mvs::sized<mvs_field_info>();
      mvs::must(mvs_get_op_field(index, f, &field));
      // an optional field is left out half the time
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

  // Mostly well inside the range, on a logarithmic scale where the range is wide.
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
        return put(
            mvs_array{points_.back()->data(), points_.back()->size() / 3, 3, MVS_TYPE_F64, 0},
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

}  // namespace fuzz
