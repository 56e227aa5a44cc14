// Texts of printf and strtod in the C locale, whatever the host has set: a decimal comma in a file
// or in one of two numbers of a sentence would be wrong.
#pragma once

#include <locale.h>  // uselocale is POSIX, not in <clocale>
#if defined(__APPLE__)
#include <xlocale.h>
#endif

namespace mvs::core {

// The calling thread has the C locale while an object of this class lives.
class ClassicLocale {
 public:
  ClassicLocale() : before_(uselocale(classic())) {}
  ~ClassicLocale() { uselocale(before_); }
  ClassicLocale(const ClassicLocale &) = delete;
  ClassicLocale &operator=(const ClassicLocale &) = delete;

 private:
  // Made once; null leaves the thread's locale as it is.
  static locale_t classic() {
    static const locale_t made = newlocale(LC_ALL_MASK, "C", nullptr);
    return made;
  }
  const locale_t before_;
};

}  // namespace mvs::core
