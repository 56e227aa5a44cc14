// Decimal point in the calling thread during the lifetime of an object.
#pragma once
#include <clocale>
#if !defined(_WIN32)
#include <locale.h>
#endif

namespace driver {

// Vendors' libraries read their files with strtod and scanf, which in a German locale stop at the
// point of "0.5", so that the first numbers of a device are zero. uselocale changes only the
// calling thread, setlocale would change the application.
class DecimalPoint {
 public:
#if defined(_WIN32)
  DecimalPoint() : before_(_configthreadlocale(_ENABLE_PER_THREAD_LOCALE)) {
    std::setlocale(LC_NUMERIC, "C");
  }
  ~DecimalPoint() {
    _configthreadlocale(before_);
  }

 private:
  int before_;
#else
  DecimalPoint() {
    const locale_t copy = duplocale(uselocale(locale_t(0)));
    ours_ = newlocale(LC_NUMERIC_MASK, "C", copy);
    if (!ours_ && copy) freelocale(copy);
    if (ours_) before_ = uselocale(ours_);
  }
  ~DecimalPoint() {
    if (!ours_) return;
    uselocale(before_);
    freelocale(ours_);
  }

 private:
  locale_t ours_ = locale_t(0), before_ = locale_t(0);
#endif

 public:
  DecimalPoint(const DecimalPoint &) = delete;
  DecimalPoint &operator=(const DecimalPoint &) = delete;
};

// The decimal point of the application's locale.
inline const char *decimal_point() {
  return std::localeconv()->decimal_point;
}

}  // namespace driver
