// Log of the Abaqus reader: ignored features with line and count, assumptions, and counts.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/abaqus/cards.h"
#include "formats/formats.h"

namespace mvs::core {

class InpNotes {
 public:
  // Reports a feature that a valve does not have. Repetitions of a sentence are counted.
  void left_out(int32_t line, const std::string &sentence);
  // Reports an assumption about data that the file lacks or defines differently.
  [[gnu::format(printf, 2, 3)]] void chosen(const char *pattern, ...);
  // Reports a conversion without assumptions, with counts.
  [[gnu::format(printf, 2, 3)]] void counted(const char *pattern, ...);
  // Reports all unused cards and parameters.
  void left_over(const std::vector<InpCard> &cards);

  // Returns ignored features in the order of lines, then assumptions, then counts.
  std::vector<Note> list() const;

 private:
  struct LeftOut {
    int32_t line;
    std::string sentence;
    size_t count;
  };
  std::vector<LeftOut> left_out_;
  std::map<std::string, size_t> known_;  // indices into left_out_
  std::vector<std::string> chosen_, counted_;
};

}  // namespace mvs::core
