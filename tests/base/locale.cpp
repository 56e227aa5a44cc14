// Numbers in sentences and files have a decimal point in every locale of the host.
#include <doctest/doctest.h>
#include <locale.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/chars.h"
#include "base/error.h"

using namespace mvs::core;

namespace {

// A locale with a decimal comma: one that is installed, or one that is compiled for this test; null
// where the sources of locales are missing as well.
locale_t comma_locale() {
  if (const locale_t installed = newlocale(LC_ALL_MASK, "de_DE.UTF-8", nullptr)) return installed;
  std::string made = std::filesystem::temp_directory_path() / "mvs_locale_XXXXXX";
  if (!::mkdtemp(made.data())) return nullptr;
  const std::string compile =
      "localedef -i de_DE -f UTF-8 " + made + "/de_DE.UTF-8 >/dev/null 2>&1";
  locale_t found = nullptr;
  if (std::system(compile.c_str()) == 0) {
    ::setenv("LOCPATH", made.c_str(), 1);
    found = newlocale(LC_ALL_MASK, "de_DE.UTF-8", nullptr);
    ::unsetenv("LOCPATH");
  }
  std::filesystem::remove_all(made);
  return found;
}

}  // namespace

TEST_CASE("numbers_have_a_point_in_a_locale_with_a_comma") {
  const locale_t comma = comma_locale();
  if (!comma) {
    MESSAGE("skipped: no locale de_DE.UTF-8, and none can be made (package locales)");
    return;
  }
  const locale_t before = uselocale(comma);
  char text[8];
  std::snprintf(text, sizeof text, "%.1f", 1.5);
  const std::string by_host = text, ours = format("%.1f of %g", 1.5, 0.25);
  double read = 0;
  const bool is_read = double_from_chars("1.5", read);
  const bool is_kept = uselocale(before) == comma;
  freelocale(comma);
  CHECK(by_host == "1,5");
  CHECK(ours == "1.5 of 0.25");
  CHECK(is_read);
  CHECK(read == 1.5);
  CHECK(is_kept);
}
