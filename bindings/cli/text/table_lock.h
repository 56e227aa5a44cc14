// A table that several programs may not write at the same time.
#pragma once

#include <string>

namespace cli {

// Locks a file (flock) while it exists; the lock also ends with the process. The file is created
// if it does not exist.
class TableLock {
 public:
  // Throws mvs::Error if another process has locked it, or if it cannot be opened.
  explicit TableLock(const std::string &path);
  ~TableLock();
  TableLock(const TableLock &) = delete;
  TableLock &operator=(const TableLock &) = delete;

  // Locks the open file that is about to take the place of the locked one.
  void take_over(int file);
  // The file stays, also if this object created it.
  void keep() { created_.clear(); }

 private:
  int file_ = -1;
  std::string created_;  // removed with this object; "" for a file that was there
};

}  // namespace cli
