// Surfaces and landmarks in files, for C++17. Part of mvs/experimental.hpp.
#ifndef MVS_SURFACE_FILE_HPP
#define MVS_SURFACE_FILE_HPP

#include <mvs/surface_file.h>
#include <mvs/base.hpp>
#include <mvs/snapshot.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mvs {

// A file that was read, owned; mvs/surface_file.h defines it.
class SurfaceFile {
 public:
  explicit SurfaceFile(const std::string &path, mvs_surface_file_options options = {}) {
    options.struct_size = sizeof options;
    must(mvs_surface_file_open(path.c_str(), &options, &held_));
  }
  SurfaceFile(SurfaceFile &&other) noexcept : held_(std::exchange(other.held_, nullptr)) {}
  SurfaceFile &operator=(SurfaceFile &&other) noexcept {
    std::swap(held_, other.held_);
    return *this;
  }
  SurfaceFile(const SurfaceFile &) = delete;
  SurfaceFile &operator=(const SurfaceFile &) = delete;
  ~SurfaceFile() { mvs_surface_file_release(held_); }

  const mvs_surface_file *get() const { return held_; }

  mvs_surface_file_info info() const {
    return filled<mvs_surface_file_info>(mvs_surface_file_get_info, held_);
  }

  // Valid while the file lives.
  View<double> points() const { return View<double>(info().points); }
  View<std::uint32_t> triangles() const { return View<std::uint32_t>(info().triangles); }

  // Names and values are valid while the file lives.
  std::vector<mvs_surface_array> arrays() const {
    std::uint32_t count = 0;
    must(mvs_surface_file_get_array_count(held_, &count));
    std::vector<mvs_surface_array> found;
    for (std::uint32_t k = 0; k < count; ++k) {
      found.push_back(filled<mvs_surface_array>(mvs_surface_file_get_array, held_, k));
    }
    return found;
  }

  // The names of the points: none, or one each.
  std::vector<std::string> names() const {
    std::uint32_t count = 0;
    must(mvs_surface_file_get_name_count(held_, &count));
    std::vector<std::string> found;
    for (std::uint32_t k = 0; k < count; ++k) {
      const char *name = nullptr;
      must(mvs_surface_file_get_name(held_, k, &name));
      found.emplace_back(name);
    }
    return found;
  }

 private:
  mvs_surface_file *held_ = nullptr;
};

}  // namespace mvs

#endif
