// Orders of convergence, verdicts, tables.
#include "tests/verification/study.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace mvs::core::verification {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
// An error below it is rounding, or the tenth digit of a table, and has no order.
constexpr double floor_of_error = 1e-8;

bool same_series(const Row &a, const Row &b) {
  return a.name == b.name && a.x == b.x;
}

std::string number(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

std::string quoted(const std::string &text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

std::ofstream open_to_write(const std::filesystem::path &path) {
  std::ofstream out(path);
  if (!out) throw std::runtime_error("cannot write " + path.string());
  return out;
}

void write_rows(const Study &study, const std::filesystem::path &path) {
  std::ofstream out = open_to_write(path);
  out << "case,x,level,value,exact,relative_error,observed_order\n";
  for (size_t k = 0; k < study.rows.size(); ++k) {
    const Row &r = study.rows[k];
    out << quoted(r.name) << ',' << number(r.x) << ',' << number(r.level) << ',' << number(r.value)
        << ',' << number(r.exact) << ',' << number(r.error()) << ',' << number(order_at(study, k))
        << '\n';
  }
}

std::string in_words(double order) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", order);
  return text;
}

}  // namespace

double Row::error() const {
  return std::abs(value - exact) / (scale > 0 ? scale : std::abs(exact));
}

double order_at(const Study &study, size_t k) {
  const Row &fine = study.rows[k];
  for (size_t before = k; before-- > 0;) {
    const Row &coarse = study.rows[before];
    if (!same_series(coarse, fine)) continue;
    if (fine.level <= 0 || std::max(fine.error(), coarse.error()) < floor_of_error) return nan;
    return std::log(coarse.error() / fine.error()) / std::log(coarse.level / fine.level);
  }
  return nan;
}

bool is_finest(const Study &study, size_t k) {
  for (size_t after = k + 1; after < study.rows.size(); ++after) {
    if (same_series(study.rows[after], study.rows[k])) return false;
  }
  return true;
}

double worst_error(const Study &study) {
  double worst = 0;
  for (size_t k = 0; k < study.rows.size(); ++k) {
    // NaN is the worst
    if (is_finest(study, k) && !(study.rows[k].error() <= worst)) worst = study.rows[k].error();
  }
  return worst;
}

std::pair<double, double> order_range(const Study &study) {
  std::pair<double, double> range{nan, nan};
  for (size_t k = 0; k < study.rows.size(); ++k) {
    const double order = is_finest(study, k) ? order_at(study, k) : nan;
    if (std::isnan(order)) continue;
    range = {std::fmin(range.first, order), std::fmax(range.second, order)};
  }
  return range;
}

std::vector<std::string> faults(const Study &study) {
  std::vector<std::string> found;
  const bool asks_order = study.order_high > 0;
  for (size_t k = 0; k < study.rows.size(); ++k) {
    if (!is_finest(study, k)) continue;
    const Row &r = study.rows[k];
    const std::string which = study.name + ", " + r.name + " at " + number(r.x) + ": ";
    if (study.tolerance > 0 && !(r.error() <= study.tolerance)) {
      found.push_back(which + "error " + number(r.error()) + ", allowed " +
                      number(study.tolerance));
    }
    const double order = order_at(study, k);
    if (asks_order && !std::isnan(order) &&
        !(order >= study.order_low && order <= study.order_high)) {
      found.push_back(which + "order " + in_words(order) + ", expected " +
                      in_words(study.order_low) + " to " + in_words(study.order_high));
    }
  }
  if (asks_order && std::isnan(order_range(study).first) && !study.rows.empty()) {
    found.push_back(study.name + ": no order was observed");
  }
  return found;
}

void write_tables(const std::vector<Study> &studies, const std::filesystem::path &folder) {
  std::filesystem::create_directories(folder);
  std::ofstream index = open_to_write(folder / "studies.csv");
  index << "name,title,quantity,x,level,source,expects,tolerance,order_low,order_high,worst_error,"
           "order_least,order_most,verdict\n";
  for (const Study &s : studies) {
    if (s.rows.empty()) continue;
    write_rows(s, folder / (s.name + ".csv"));
    const auto [least, most] = order_range(s);
    const bool asks = s.tolerance > 0 || s.order_high > 0;
    for (const std::string &text :
         {s.name, s.title, s.quantity, s.x, s.level, s.source, s.expects}) {
      index << quoted(text) << ',';
    }
    index << number(s.tolerance) << ',' << number(s.order_low) << ',' << number(s.order_high) << ','
          << number(worst_error(s)) << ',' << number(least) << ',' << number(most) << ','
          << (!faults(s).empty() ? "fails"
              : asks             ? "holds"
                                 : "reported")
          << '\n';
  }
}

std::string as_text(const Study &s) {
  std::ostringstream out;
  const auto [least, most] = order_range(s);
  out << s.name << ": " << s.title << ", " << s.rows.size() << " rows; largest error "
      << number(worst_error(s));
  if (s.tolerance > 0) out << " (allowed " << number(s.tolerance) << ')';
  if (!std::isnan(least)) {
    out << "; order " << in_words(least);
    if (most > least) out << " to " << in_words(most);
  }
  for (const std::string &fault : faults(s)) out << "\n  FAILS: " << fault;
  return out.str();
}

bool long_runs() {
  const char *lengthy = std::getenv("MVS_TEST_LONG");
  return lengthy != nullptr && *lengthy != 0;
}

}  // namespace mvs::core::verification
