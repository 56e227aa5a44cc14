// Atomic file replacement: at every moment the target is the old or the new file, and no temporary
// file remains.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "tests/formats/disk.h"

using namespace mvs::core;
namespace fs = std::filesystem;

namespace {

mode_t mode_of(const std::string &path) {
  struct stat status;
  REQUIRE(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

}  // namespace

TEST_CASE("a_file_is_read_back_as_written") {
  const Folder folder;
  const std::string path = folder.file("a.obj");
  for (const size_t size : {size_t{0}, size_t{1}, size_t{65535}, size_t{65536}, size_t{1000003}}) {
    std::string bytes(size, 'x');
    for (size_t k = 0; k < size; ++k) bytes[k] = static_cast<char>(k * 7);
    write_whole_file(path, bytes);
    CHECK(read_whole_file(path) == bytes);
    CHECK(folder.entries() == 1);
  }
}

TEST_CASE("reading_reports_its_reason_of_failure") {
  const Folder folder;
  CHECK(contains(failure(MVS_E_IO, [&] { read_whole_file(folder.file("none")); }),
                 "No such file or directory"));
  CHECK(contains(failure(MVS_E_IO, [&] { read_whole_file(folder.path.string()); }), "directory"));
  CHECK(contains(failure(MVS_E_IO, [&] { read_whole_file("/dev/zero"); }), "device"));
  write_whole_file(folder.file("ten"), "0123456789");
  CHECK(read_whole_file(folder.file("ten"), 10) == "0123456789");
  CHECK(contains(failure(MVS_E_MEMORY, [&] { read_whole_file(folder.file("ten"), 9); }),
                 "has 10 bytes, the limit is 9"));
}

TEST_CASE("reading_from_a_pipe_has_the_size_limit") {
  const Folder folder;
  const std::string path = folder.file("pipe");
  REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
  for (const size_t limit : {size_t{200000}, size_t{1000}}) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGPIPE, SIG_IGN);
      const int pipe = ::open(path.c_str(), O_WRONLY);
      const std::string bytes(200000, 'p');
      for (size_t at = 0; at < bytes.size();) {
        const ssize_t written = ::write(pipe, bytes.data() + at, bytes.size() - at);
        if (written < 0) break;
        at += static_cast<size_t>(written);
      }
      ::_exit(0);
    }
    if (limit == 200000) {
      CHECK(read_whole_file(path, limit) == std::string(200000, 'p'));
    } else {
      CHECK(contains(failure(MVS_E_MEMORY, [&] { read_whole_file(path, limit); }), "the limit"));
    }
    ::waitpid(child, nullptr, 0);
  }
}

TEST_CASE("writing_reports_its_reason_of_failure_and_leaves_no_file") {
  const Folder folder;
  CHECK(contains(failure(MVS_E_IO, [&] { write_whole_file(folder.file("no/a.obj"), "x"); }),
                 "No such file or directory"));
  CHECK(contains(failure(MVS_E_IO, [&] { write_whole_file(folder.path.string(), "x"); }),
                 "directory"));
  CHECK(contains(failure(MVS_E_IO, [&] { write_whole_file("/dev/null", "x"); }), "device"));
  CHECK(contains(failure(MVS_E_IO, [&] { write_whole_file("", "x"); }), "cannot"));
  CHECK(folder.entries() == 0);
}

TEST_CASE("a_full_disk_keeps_the_old_file_and_leaves_no_other") {
  const Folder folder;
  const std::string path = folder.file("a.obj");
  write_whole_file(path, "old");
  // a limit on the size of files makes write() fail as a full disk does
  const int code = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {1000, 1000};
    if (::setrlimit(RLIMIT_FSIZE, &small) != 0) return 2;
    try {
      write_whole_file(path, std::string(100000, 'n'));
    } catch (const Error &error) {
      return error.code == MVS_E_IO ? 0 : 3;
    }
    return 4;
  });
  CHECK(code == 0);
  CHECK(read_whole_file(path) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("without_permission_files_are_neither_read_nor_written") {
  const Folder folder;
  const std::string path = folder.file("a.obj");
  write_whole_file(path, "old");
  fs::permissions(folder.path, fs::perms(0777));
  const auto code_of = [](auto work) {
    try {
      work();
    } catch (const Error &error) {
      return static_cast<int>(-error.code);
    }
    return 0;
  };
  // root has every permission, so the test changes to an unprivileged user first
  const auto as_nobody = [&](auto work) {
    return in_child([&] {
      if (::geteuid() == 0 && ::setuid(65534) != 0) return 99;
      return code_of(work);
    });
  };
  fs::permissions(path, fs::perms(0000));
  CHECK(as_nobody([&] { read_whole_file(path); }) == -MVS_E_IO);
  fs::permissions(path, fs::perms(0444));
  CHECK(as_nobody([&] { write_whole_file(path, "new"); }) == -MVS_E_IO);
  fs::permissions(path, fs::perms(0666));
  fs::permissions(folder.path, fs::perms(0555));
  CHECK(as_nobody([&] { write_whole_file(path, "new"); }) == -MVS_E_IO);
  CHECK(as_nobody([&] { read_whole_file(path); }) == 0);
  fs::permissions(folder.path, fs::perms(0755));
  CHECK(read_whole_file(path) == "old");
  CHECK(folder.entries() == 1);
}

TEST_CASE("the_mode_is_that_of_the_old_file_or_of_the_umask") {
  const Folder folder;
  const std::string path = folder.file("a.obj");
  const mode_t before = ::umask(027);
  write_whole_file(path, "x");
  CHECK(mode_of(path) == 0640);
  fs::permissions(path, fs::perms(0606));
  write_whole_file(path, "y");
  CHECK(mode_of(path) == 0606);
  ::umask(before);
}

TEST_CASE("a_symbolic_link_remains_and_its_file_is_replaced") {
  const Folder folder;
  fs::create_directory(folder.path / "far");
  write_whole_file(folder.file("far/real.obj"), "old");
  fs::create_symlink("far/real.obj", folder.path / "link.obj");
  write_whole_file(folder.file("link.obj"), "new");
  CHECK(fs::is_symlink(folder.path / "link.obj"));
  CHECK(read_whole_file(folder.file("far/real.obj")) == "new");
}

TEST_CASE("a_killed_writer_leaves_the_old_file_or_the_new_one") {
  const Folder folder;
  const std::string path = folder.file("a.obj");
  const std::string texts[] = {std::string(300000, 'a'), std::string(200000, 'b')};
  write_whole_file(path, texts[0]);
  for (int round = 0; round < 20; ++round) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (int k = 0;; ++k) write_whole_file(path, texts[k % 2]);
    }
    ::usleep(static_cast<useconds_t>(2000 + 531 * round));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string text = read_whole_file(path);
    CHECK((text == texts[0] || text == texts[1]));
  }
}

TEST_CASE("of_several_files_none_is_replaced_if_one_cannot_be") {
  const Folder folder;
  write_whole_file(folder.file("a"), "old");
  fs::create_directory(folder.path / "b");
  CHECK(contains(
      failure(MVS_E_IO,
              [&] {
                write_whole_files({{"a", "new"}, {"b", "new"}}, folder.path.string() + "/");
              }),
      "directory"));
  CHECK(read_whole_file(folder.file("a")) == "old");
  CHECK(folder.entries() == 2);
  write_whole_files({{"a", "new"}, {"c", "newer"}}, folder.path.string() + "/");
  CHECK(read_whole_file(folder.file("a")) == "new");
  CHECK(read_whole_file(folder.file("c")) == "newer");
  CHECK(folder.entries() == 3);
}
