// Journal records: append with fdatasync, strict reader.
#include "formats/file/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/error.h"
#include "formats/formats.h"
#include "formats/text/checksum.h"
#include "formats/text/line.h"

namespace mvs::core {
namespace {

constexpr std::string_view mark = "mvsj ";

[[noreturn]] void fail_journal(const char *verb, const std::string &path, int error) {
  fail_io(verb, "the journal " + path, error, "journal");
}

// Takes the word before the next blank, and the blank; returns an empty word without a blank.
std::string_view take_word(std::string_view &rest) {
  const size_t end = rest.find(' ');
  if (end == std::string_view::npos) return {};
  const std::string_view word = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return word;
}

// Takes the record at the start of `rest`; returns false if no whole record is there.
bool take_record(std::string_view &rest, std::string &text) {
  std::string_view r = rest;
  if (!r.starts_with(mark)) return false;
  r.remove_prefix(mark.size());
  uint64_t length = 0;
  if (!parse_whole(take_word(r), length)) return false;
  const std::string_view checksum = take_word(r);
  if (length >= r.size() || r[length] != '\n') return false;
  if (checksum_digits(r.substr(0, length)) != checksum) return false;
  text = r.substr(0, length);
  rest = r.substr(length + 1);
  return true;
}

struct stat status_of(const Descriptor &file, const std::string &path) {
  struct stat found;
  if (::fstat(file.number(), &found) != 0) fail_journal("read", path, errno);
  return found;
}

// Locks the file for one open journal, until its descriptor is closed; file systems without locks
// are left alone.
void lock_for_one(const Descriptor &file, const std::string &path) {
  if (::flock(file.number(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  fail(MVS_E_STATE, "journal",
       "the journal %s is open in another simulator or program: close it there first",
       shown_path(path).c_str());
}

}  // namespace

JournalRecords read_journal(std::string_view bytes) {
  JournalRecords records;
  std::string_view rest = bytes;
  std::string text;
  while (take_record(rest, text)) records.texts.push_back(std::move(text));
  records.bytes = bytes.size() - rest.size();
  records.read = bytes.size();
  records.torn = !rest.empty();
  // a crash cuts only the last line; bytes after its line end show another damage
  const size_t end = rest.find('\n');
  MVS_MUST(end == std::string_view::npos || end + 1 == rest.size(), MVS_E_FORMAT, "journal",
           "record %zu of the journal is damaged, and others follow it: restore the file from a "
           "copy, or cut it off at byte %zu",
           records.texts.size() + 1, records.bytes);
  MVS_MUST(!records.texts.empty(), MVS_E_FORMAT, "journal",
           "the file is not a journal of libmvs: it does not begin with a whole record");
  return records;
}

std::string journal_line(std::string_view text) {
  return format("%s%zu %s ", mark.data(), text.size(), checksum_digits(text).c_str()) +
         std::string(text) + "\n";
}

Journal Journal::create(const std::string &path, std::string_view first) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  MVS_MUST(file.number() >= 0 || errno != EEXIST, MVS_E_STATE, "journal",
           "the journal %s is there already: recover it, or move it away",
           shown_path(path).c_str());
  if (file.number() < 0) fail_journal("create", path, errno);
  try {
    lock_for_one(file, path);
    sync_folder(folder_of(path));
    Journal journal(path, std::move(file), 0);
    journal.append(first);
    return journal;
  } catch (...) {
    ::unlink(path.c_str());
    throw;
  }
}

Journal Journal::reopen(const std::string &path, const JournalRecords &records) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0) fail_journal("open", path, errno);
  lock_for_one(file, path);
  MVS_MUST(static_cast<size_t>(status_of(file, path).st_size) == records.read, MVS_E_STATE,
           "journal", "the journal %s has changed since it was read: recover it again",
           shown_path(path).c_str());
  const off_t whole = static_cast<off_t>(records.bytes);
  if (::ftruncate(file.number(), whole) != 0) fail_journal("cut", path, errno);
  return {path, std::move(file), records.bytes};
}

uint64_t Journal::links() const {
  return status_of(file_, path_).st_nlink;
}

void Journal::must_exist() const {
  MVS_MUST(!has_links_ || links() > 0, MVS_E_IO, "journal",
           "the journal %s was deleted while it was open, and its records are lost: save the "
           "session, close the journal, and open another",
           shown_path(path_).c_str());
}

void Journal::append(std::string_view text) {
  must_exist();
  const std::string line = journal_line(text);
  MVS_MUST(line.size() <= max_file_bytes - size_, MVS_E_STATE, "journal",
           "the journal %s would have more than %zu bytes, which libmvs does not read: save the "
           "session, close the journal, and open another",
           shown_path(path_).c_str(), max_file_bytes);
  size_t written = 0;
  while (written < line.size()) {
    const ssize_t count = ::pwrite(file_.number(), line.data() + written, line.size() - written,
                                   static_cast<off_t>(size_ + written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    written += static_cast<size_t>(count);
  }
  if (written < line.size() || ::fdatasync(file_.number()) != 0) {
    const int error = errno;
    // best effort: the reader drops a half-written record
    [[maybe_unused]] const int cut = ::ftruncate(file_.number(), static_cast<off_t>(size_));
    fail_journal("write", path_, error);
  }
  size_ += line.size();
}

}  // namespace mvs::core
