// Fixtures: a folder for a test, failures with their sentence, work in a child process.
#pragma once

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "tests/formats/samples.h"

namespace mvs::core {

// A folder that exists for the length of a test.
struct Folder {
  std::filesystem::path path;
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "mvs-test-XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path); }
  std::string file(const std::string &name) const { return (path / name).string(); }
  size_t entries() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(path), {}));
  }
};

template <typename Work>
std::string failure(mvs_result code, Work work) {
  try {
    work();
  } catch (const Error &error) {
    CHECK(error.code == code);
    return error.what();
  }
  return "no failure";
}

inline bool contains(const std::string &text, const char *word) {
  CAPTURE(text);
  return text.find(word) != std::string::npos;
}

// Runs `work` in a child process; its return value is the exit code.
template <typename Work>
int in_child(Work work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace mvs::core
