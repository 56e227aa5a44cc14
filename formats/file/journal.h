// A file of records that survives a crash: each is on the disk before append() returns.
//
// A record is one line: `mvsj LENGTH CRC32 TEXT`, LENGTH the bytes of TEXT in decimal, CRC32 its
// checksum in 8 hexadecimal digits (the polynomial of zlib and PNG).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/file/posix_file.h"

namespace mvs::core {

// What a journal holds.
struct JournalRecords {
  std::vector<std::string> texts;
  size_t bytes = 0;   // up to the end of the last whole record
  bool torn = false;  // whether a record that was cut short followed
};

// Throws MVS_E_FORMAT where a record is damaged that others follow, or the file is no journal.
JournalRecords read_journal(std::string_view bytes);

// A record as it stands in the file.
std::string journal_line(std::string_view text);

class Journal {
 public:
  // A new file; MVS_E_STATE if there is one.
  static Journal create(const std::string &path);
  // Goes on with a file after its first `bytes`, dropping what follows them.
  static Journal go_on(const std::string &path, size_t bytes);

  // Throws MVS_E_IO, and the file is as before, where the record cannot be written.
  void append(std::string_view text);
  const std::string &path() const { return path_; }

 private:
  Journal(std::string path, Descriptor file, size_t size)
      : path_(std::move(path)), file_(std::move(file)), size_(size) {}

  std::string path_;
  Descriptor file_;
  size_t size_ = 0;
};

}  // namespace mvs::core
