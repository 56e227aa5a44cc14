// The file of a journal: long records, and a disk that is full when it is created.
#include "formats/file/journal.h"

#include <sys/resource.h>

#include <csignal>

#include "tests/formats/disk.h"

using namespace mvs::core;

// The first record repeats the history of each checkpoint, so that it can be long.
TEST_CASE("a_record_of_any_length_is_read_again") {
  const std::string text(size_t{65} << 20, 'x');
  const JournalRecords records = read_journal(journal_line(text) + journal_line("{}"));
  REQUIRE(records.texts.size() == 2);
  CHECK(records.texts[0] == text);
  CHECK_FALSE(records.torn);
  const JournalRecords cut = read_journal(journal_line("{}") + "mvsj 18446744073709551615 0 {}\n");
  CHECK(cut.texts.size() == 1);
  CHECK(cut.torn);
}

TEST_CASE("a_journal_whose_file_was_deleted_takes_no_record") {
  const Folder folder;
  const std::string path = folder.file("a.journal"), other = folder.file("other.journal");
  Journal journal = Journal::create(path, "{}");
  journal.append("{}");
  CHECK(::rename(path.c_str(), other.c_str()) == 0);
  journal.append("{}");  // a file that was renamed is still there
  CHECK(read_journal(read_whole_file(other)).texts.size() == 3);
  CHECK(::unlink(other.c_str()) == 0);
  CHECK(contains(failure(MVS_E_IO, [&] { journal.append("{}"); }), "was deleted"));
  CHECK(contains(failure(MVS_E_IO, [&] { journal.must_exist(); }), "was deleted"));
}

// Two that append to one file would overwrite each other's records.
TEST_CASE("a_journal_is_open_once") {
  const Folder folder;
  const std::string path = folder.file("a.journal");
  {
    Journal first = Journal::create(path, "{}");
    const JournalRecords records = read_journal(read_whole_file(path));
    CHECK(contains(failure(MVS_E_STATE, [&] { Journal::reopen(path, records); }), "is open in"));
    first.append("{}");
    CHECK(read_journal(read_whole_file(path)).texts.size() == 2);
  }
  const JournalRecords records = read_journal(read_whole_file(path));
  Journal::reopen(path, records).append("{}");  // closed again
  CHECK(contains(failure(MVS_E_STATE, [&] { Journal::reopen(path, records); }), "has changed"));
  CHECK(read_journal(read_whole_file(path)).texts.size() == 3);
}

TEST_CASE("a_journal_that_cannot_begin_leaves_no_file") {
  const Folder folder;
  const std::string path = folder.file("a.journal");
  const int code = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {1000, 1000};
    if (::setrlimit(RLIMIT_FSIZE, &small) != 0) return 2;
    try {
      Journal::create(path, std::string(100000, 'n'));
    } catch (const Error &error) {
      return error.code == MVS_E_IO ? 0 : 3;
    }
    return 4;
  });
  CHECK(code == 0);
  CHECK(folder.entries() == 0);
  Journal::create(path, "{}");
  CHECK(read_journal(read_whole_file(path)).texts.size() == 1);
  CHECK(contains(failure(MVS_E_STATE, [&] { Journal::create(path, "{}"); }), "is there already"));
}
