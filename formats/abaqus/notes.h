// What a reader of Abaqus input left out, and what it chose: told line by line, never dropped.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/abaqus/cards.h"
#include "formats/formats.h"

namespace mvs::core {

class InpNotes {
 public:
  // Something of the file has no place in a valve. The same sentence again counts up.
  void left_out(int32_t line, const std::string &sentence);
  // Something that the file does not say, or says otherwise, was chosen: worth a look.
  [[gnu::format(printf, 2, 3)]] void chosen(const char *pattern, ...);
  // How the file's things became those of a valve, without any choice.
  [[gnu::format(printf, 2, 3)]] void counted(const char *pattern, ...);
  // Everything in cards that nobody took.
  void left_over(const std::vector<InpCard> &cards);

  // In the order of the lines; then choices, then counts.
  std::vector<Note> list() const;

 private:
  struct LeftOut {
    int32_t line;
    std::string sentence;
    size_t count;
  };
  std::vector<LeftOut> left_out_;
  std::map<std::string, size_t> known_;  // places in left_out_
  std::vector<std::string> chosen_, counted_;
};

}  // namespace mvs::core
