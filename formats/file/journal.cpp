// Journal records: append with fdatasync, strict reader.
#include "formats/file/journal.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr std::string_view mark = "mvsj ";
constexpr size_t longest_record = size_t{64} << 20;

[[noreturn]] void fail_journal(const char *verb, const std::string &path, int error) {
  fail_io(verb, "the journal " + path, error, "journal");
}

uint32_t crc32(std::string_view text) {
  uint32_t crc = 0xffffffffu;
  for (const char c : text) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

// Reads a number and the blank after it; returns false on another text.
template <typename Number>
bool take_number(std::string_view &rest, Number &number, int base) {
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number, base);
  if (error != std::errc() || end == rest.data() + rest.size() || *end != ' ') return false;
  rest.remove_prefix(static_cast<size_t>(end - rest.data()) + 1);
  return true;
}

// Takes the record at the start of `rest`; returns false if no whole record is there.
bool take_record(std::string_view &rest, std::string &text) {
  std::string_view r = rest;
  size_t length = 0;
  uint32_t crc = 0;
  if (!r.starts_with(mark)) return false;
  r.remove_prefix(mark.size());
  if (!take_number(r, length, 10) || !take_number(r, crc, 16)) return false;
  if (length > longest_record || r.size() < length + 1 || r[length] != '\n') return false;
  if (crc32(r.substr(0, length)) != crc) return false;
  text = r.substr(0, length);
  rest = r.substr(length + 1);
  return true;
}

}  // namespace

JournalRecords read_journal(std::string_view bytes) {
  JournalRecords records;
  std::string_view rest = bytes;
  std::string text;
  while (take_record(rest, text)) records.texts.push_back(std::move(text));
  records.bytes = bytes.size() - rest.size();
  records.torn = !rest.empty();
  // a crash cuts only the last line; bytes after its line end show another damage
  const size_t end = rest.find('\n');
  MVS_MUST(end == std::string_view::npos || end + 1 == rest.size(), MVS_E_FORMAT, "journal",
           "record %zu of the journal is damaged, and others follow it: restore the file from a "
           "copy, or cut it off at byte %zu",
           records.texts.size() + 1, records.bytes);
  MVS_MUST(!records.texts.empty(), MVS_E_FORMAT, "journal",
           "this is no journal of libmvs: it does not begin with a whole record");
  return records;
}

std::string journal_line(std::string_view text) {
  return format("%s%zu %08x ", mark.data(), text.size(), crc32(text)) + std::string(text) + "\n";
}

Journal Journal::create(const std::string &path) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  MVS_MUST(file.number() >= 0 || errno != EEXIST, MVS_E_STATE, "journal",
           "the journal %s is there already: recover it, or move it away", path.c_str());
  if (file.number() < 0) fail_journal("create", path, errno);
  sync_folder(folder_of(path));
  return {path, std::move(file), 0};
}

Journal Journal::reopen(const std::string &path, size_t bytes) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.number() < 0) fail_journal("open", path, errno);
  if (::ftruncate(file.number(), static_cast<off_t>(bytes)) != 0) fail_journal("cut", path, errno);
  return {path, std::move(file), bytes};
}

void Journal::append(std::string_view text) {
  const std::string line = journal_line(text);
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
