#include "text/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <system_error>

#include "valve/host.h"

namespace cli {
namespace {

using Status = struct stat;

const char *remedy_of(int error) {
  switch (error) {
    case EISDIR:
      return "; give the name of a file";
    case ENOENT:
    case ENOTDIR:
      return "; create the folder first";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; choose another folder, or get the right to write there (chmod, chown)";
    case ELOOP:
      return "; remove the link, which leads back to itself";
    case ENOSPC:
    case EDQUOT:
      return "; free space on the disk";
    default:
      return "";
  }
}

std::string folder_of(const std::string &path) {
  const size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, std::max<size_t>(slash, 1));
}

// realpath() resolves links to a file that exists, readlink() those to a new one.
std::string follow_links(const std::string &path, const std::string &part) {
  constexpr int most_links = 40;  // as Linux
  std::string file = path;
  for (int k = 0; k < most_links; ++k) {
    const std::unique_ptr<char, decltype(&std::free)> found(::realpath(file.c_str(), nullptr),
                                                            &std::free);
    if (found) return found.get();
    if (errno == ELOOP) break;
    char target[4096];
    const ssize_t length = ::readlink(file.c_str(), target, sizeof target);
    if (length < 0) return file;
    std::string next(target, static_cast<size_t>(length));
    if (!next.starts_with('/')) next.insert(0, folder_of(file).append("/"));
    file = std::move(next);
  }
  fail_to_write(path, part, "write", file, ELOOP);
}

// "/." also refuses a file that stands in the place of a folder.
bool is_writable_folder(const std::string &folder) {
  return ::access((folder + "/.").c_str(), W_OK | X_OK) == 0;
}

// A VTM file has its blocks in a folder of the same name, which is made first.
void demand_block_folder(const std::string &path) {
  const std::string folder = path.substr(0, path.size() - 4);
  Status found;
  if (::stat(folder.c_str(), &found) != 0) {
    if (is_writable_folder(folder_of(folder))) return;
    fail_to_write(path, "", "create folder", folder, errno);
  }
  if (!S_ISDIR(found.st_mode)) fail_to_write(path, "", "create folder", folder, EEXIST);
  if (!is_writable_folder(folder)) fail_to_write(path, "", "write into folder", folder, errno);
}

}  // namespace

void fail_to_write(const std::string &path, const std::string &part, const std::string &verb,
                   const std::string &what, int error) {
  fail(MVS_E_IO, part,
       path + ": cannot " + verb + " " + (what == path ? "it" : what) + ": " +
           std::generic_category().message(error) + remedy_of(error));
}

OutputTarget output_target(const std::string &path, const std::string &part) {
  OutputTarget target;
  target.file = follow_links(path, part);
  target.folder = folder_of(target.file);
  Status old;
  if (::stat(target.file.c_str(), &old) != 0) return target;
  if (S_ISDIR(old.st_mode)) fail_to_write(path, part, "write", target.file, EISDIR);
  if (!S_ISREG(old.st_mode)) {
    fail(MVS_E_IO, part,
         path + ": cannot write " + target.file + ": it is a device or pipe, no file");
  }
  if (::access(target.file.c_str(), W_OK) != 0) {
    fail_to_write(path, part, "write", target.file, errno);
  }
  target.mode = old.st_mode & 07777;
  return target;
}

void demand_writable(const std::string &path) {
  if (path.empty()) return;
  const OutputTarget target = output_target(path);
  if (is_writable_folder(target.folder)) return;
  fail_to_write(path, "", "write into folder", target.folder, errno);
}

void demand_writable_valve(const std::string &path) {
  if (path.empty()) return;
  std::string small = path;
  std::transform(small.begin(), small.end(), small.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  const auto ends_with_one_of = [&](std::initializer_list<const char *> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [&](const char *ending) { return small.ends_with(ending); });
  };
  if (ends_with_one_of({".inp"})) {
    fail(MVS_E_UNSUPPORTED, "format",
         path + ": Abaqus input is read, not written: save as .obj, .h5 or .feb");
  }
  if (!ends_with_one_of({".obj", ".h5", ".vtkhdf", ".vtp", ".vtm", ".feb"})) {
    fail(MVS_E_ARGUMENT, "path",
         path +
             ": the ending names no known format: known endings are .obj, .h5, .vtkhdf, .vtp, .vtm "
             "and .feb, or name the format");
  }
  if (ends_with_one_of({".vtm"})) demand_block_folder(path);
  demand_writable(path);
}

void demand_apart(const std::vector<Output> &outputs, const std::vector<std::string> &inputs) {
  const auto file_of = [](const std::string &path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(output_target(path).file));
  };
  for (auto later = outputs.begin(); later != outputs.end(); ++later) {
    if (later->path.empty()) continue;
    for (auto former = outputs.begin(); former != later; ++former) {
      if (former->path.empty() || file_of(former->path) != file_of(later->path)) continue;
      fail(MVS_E_ARGUMENT, "output",
           later->path + ": is the output for " + former->what +
               " as well: give another file for " + later->what);
    }
    for (const std::string &in : inputs) {
      std::error_code unknown;  // of a file that is not there
      if (in.empty() || !std::filesystem::equivalent(later->path, in, unknown)) continue;
      fail(MVS_E_ARGUMENT, "output",
           later->path + ": is the input " + in +
               " as well, which would be lost: give another output");
    }
  }
}

}  // namespace cli
