// Append-only log of records: append() returns after the record is on the disk, and a crash loses
// at most the record being written.
//
// A record is one line: `mvsj LENGTH CHECKSUM TEXT`, with the bytes of TEXT in decimal and its
// checksum in 32 hexadecimal digits.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "formats/file/posix_file.h"

namespace mvs::core {

// The content of a journal.
struct JournalRecords {
  std::vector<std::string> texts;
  size_t bytes = 0;   // up to the end of the last whole record
  size_t read = 0;    // of the file
  bool torn = false;  // whether an incomplete record follows
};

// Throws MVS_E_FORMAT if a damaged record is followed by others, or the file is not a journal.
JournalRecords read_journal(std::string_view bytes);

// Returns the line of a record.
std::string journal_line(std::string_view text);

class Journal {
 public:
  // Creates a file with its first record; MVS_E_STATE if it exists. If this fails, no file remains.
  static Journal create(const std::string &path, std::string_view first);
  // Opens a file for appending after its whole records and drops the rest. MVS_E_STATE if another
  // simulator or program has the journal open, or the size of the file is not that of the records.
  static Journal reopen(const std::string &path, const JournalRecords &records);

  // Appends a record. If this fails, throws MVS_E_IO, also if the file was deleted, or MVS_E_STATE
  // if the file would be too long to be read again, and leaves it unchanged.
  void append(std::string_view text);
  // Throws MVS_E_IO if the file was deleted.
  void must_exist() const;
  const std::string &path() const { return path_; }

 private:
  Journal(std::string path, Descriptor file, size_t size)
      : path_(std::move(path)), file_(std::move(file)), size_(size), has_links_(links() > 0) {}
  // The names that the file has; 0 if it was deleted.
  uint64_t links() const;

  std::string path_;
  Descriptor file_;
  size_t size_ = 0;
  bool has_links_;  // false on a file system that does not count them
};

}  // namespace mvs::core
