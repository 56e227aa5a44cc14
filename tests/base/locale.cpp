// Numbers in sentences and files have a decimal point in every locale of the host.
#include <doctest/doctest.h>
#include <locale.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "base/chars.h"
#include "base/error.h"
#include "tests/formats/disk.h"

using namespace mvs::core;

namespace {

enum class Outcome : uint8_t { right, no_locale, no_comma, wrong_text, wrong_number, not_restored };

// A locale with a decimal comma: one that is installed, or one that is compiled in a folder; null
// where the sources of locales are missing as well.
locale_t comma_locale(const std::string &folder) {
  if (const locale_t installed = newlocale(LC_ALL_MASK, "de_DE.UTF-8", nullptr)) return installed;
  const std::string made = folder + "/de_DE.UTF-8";
  const int failed = in_child([&] {
    ::close(STDERR_FILENO);
    ::execlp("localedef", "localedef", "-i", "de_DE", "-f", "UTF-8", made.c_str(), nullptr);
    return 1;
  });
  if (failed) return nullptr;
  ::setenv("LOCPATH", folder.c_str(), 1);
  return newlocale(LC_ALL_MASK, "de_DE.UTF-8", nullptr);
}

Outcome outcome_in_a_locale_with_a_comma(const std::string &folder) {
  const locale_t comma = comma_locale(folder);
  if (!comma) return Outcome::no_locale;
  uselocale(comma);
  char text[8];
  std::snprintf(text, sizeof text, "%.1f", 1.5);
  double read = 0;
  if (std::string(text) != "1,5") return Outcome::no_comma;
  if (format("%.1f of %g", 1.5, 0.25) != "1.5 of 0.25") return Outcome::wrong_text;
  if (!double_from_chars("1.5", read) || read != 1.5) return Outcome::wrong_number;
  return uselocale(nullptr) == comma ? Outcome::right : Outcome::not_restored;
}

}  // namespace

// In a child process, whose locale and environment end with it.
TEST_CASE("numbers_have_a_point_in_a_locale_with_a_comma") {
  const Folder folder;
  const auto outcome = static_cast<Outcome>(in_child(
      [&] { return static_cast<int>(outcome_in_a_locale_with_a_comma(folder.path.string())); }));
  if (outcome == Outcome::no_locale) {
    MESSAGE("skipped: no locale de_DE.UTF-8, and none can be made (package locales)");
    return;
  }
  CHECK(outcome == Outcome::right);
}
