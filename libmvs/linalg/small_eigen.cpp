// Bisection on a tridiagonal matrix; shifted QR iterations on a complex Hessenberg one.
#include "linalg/small_eigen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"

namespace mvs::core {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon();
// Each eigenvalue takes two or three iterations; LAPACK gives up after thirty.
constexpr int most_qr_iterations = 60;

// std::complex multiplies and divides by functions of the compiler's library, whose bits differ.
struct Complex {
  double re = 0, im = 0;

  Complex operator+(const Complex &o) const { return {re + o.re, im + o.im}; }
  Complex operator-(const Complex &o) const { return {re - o.re, im - o.im}; }
  Complex operator*(const Complex &o) const {
    return {re * o.re - im * o.im, re * o.im + im * o.re};
  }
  Complex operator*(double s) const { return {s * re, s * im}; }
  Complex conjugate() const { return {re, -im}; }
  double norm2() const { return re * re + im * im; }
  double size() const { return std::sqrt(norm2()); }
};

Complex operator/(const Complex &a, const Complex &b) {
  return (a * b.conjugate()) * (1 / b.norm2());
}

// The square root with a real part that is not negative.
Complex square_root(const Complex &z) {
  const double size = z.size();
  if (size == 0) return {};
  const double half = std::sqrt((size + std::abs(z.re)) / 2), other = z.im / (2 * half);
  if (z.re >= 0) return {half, other};
  return {std::abs(other), z.im < 0 ? -half : half};
}

class ComplexMatrix {
 public:
  explicit ComplexMatrix(size_t n) : n_(n), value_(n * n) {}
  Complex &operator()(size_t r, size_t c) { return value_[r * n_ + c]; }
  const Complex &operator()(size_t r, size_t c) const { return value_[r * n_ + c]; }
  size_t size() const { return n_; }

 private:
  size_t n_;
  std::vector<Complex> value_;
};

// A unitary rotation [c, s; -s*, c] that turns (a, b) into (r, 0).
struct Rotation {
  double c = 1;
  Complex s;

  static Rotation of(const Complex &a, const Complex &b) {
    const double whole = std::sqrt(a.norm2() + b.norm2()), size = a.size();
    if (b.norm2() == 0) return {};
    if (size == 0) return {0, b.conjugate() * (1 / b.size())};
    return {size / whole, (a * (1 / size)) * b.conjugate() * (1 / whole)};
  }
  void turn(Complex &a, Complex &b) const {
    const Complex first = a * c + s * b;
    b = b * c - s.conjugate() * a;
    a = first;
  }
  // Multiplies two columns by the conjugate transpose, from the right.
  void turn_columns(Complex &a, Complex &b) const {
    const Complex first = a * c + s.conjugate() * b;
    b = b * c - s * a;
    a = first;
  }
};

void turn_rows(ComplexMatrix &m, const Rotation &by, size_t row, size_t first) {
  for (size_t c = first; c < m.size(); ++c) by.turn(m(row, c), m(row + 1, c));
}
void turn_columns(ComplexMatrix &m, const Rotation &by, size_t column, size_t end) {
  for (size_t r = 0; r < end; ++r) by.turn_columns(m(r, column), m(r, column + 1));
}

// A = Q T Q^*, T upper triangular.
struct Schur {
  ComplexMatrix t, q;
};

// Reduces to Hessenberg form: rotations of neighbouring rows remove each column from below.
void make_hessenberg(Schur &schur) {
  const size_t n = schur.t.size();
  for (size_t c = 0; c + 2 < n; ++c) {
    for (size_t r = n - 1; r > c + 1; --r) {
      const Rotation by = Rotation::of(schur.t(r - 1, c), schur.t(r, c));
      turn_rows(schur.t, by, r - 1, c);
      schur.t(r, c) = {};
      turn_columns(schur.t, by, r - 1, n);
      turn_columns(schur.q, by, r - 1, n);
    }
  }
}

// The eigenvalue of the lower right 2 x 2 block of rows `last` - 1 and `last` that is closer to its
// last number (Wilkinson's shift).
Complex shift_of(const ComplexMatrix &t, size_t last) {
  const Complex a = t(last - 1, last - 1), d = t(last, last);
  const Complex half = (a - d) * 0.5, product = t(last - 1, last) * t(last, last - 1);
  const Complex root = square_root(half * half + product);
  const Complex plus = half + root, minus = half - root;
  const Complex larger = plus.norm2() > minus.norm2() ? plus : minus;
  return larger.norm2() == 0 ? d : d - product / larger;
}

bool negligible(ComplexMatrix &t, size_t row) {
  const double beside = t(row - 1, row - 1).size() + t(row, row).size();
  if (t(row, row - 1).size() > unit_roundoff * beside) return false;
  t(row, row - 1) = {};
  return true;
}

void qr_iteration(Schur &schur, size_t first, size_t last, const Complex &shift) {
  const size_t n = schur.t.size();
  for (size_t k = first; k <= last; ++k) schur.t(k, k) = schur.t(k, k) - shift;
  std::vector<Rotation> rotations;
  for (size_t k = first; k < last; ++k) {
    rotations.push_back(Rotation::of(schur.t(k, k), schur.t(k + 1, k)));
    turn_rows(schur.t, rotations.back(), k, k);
    schur.t(k + 1, k) = {};
  }
  for (size_t k = first; k < last; ++k) {
    turn_columns(schur.t, rotations[k - first], k, k + 2);
    turn_columns(schur.q, rotations[k - first], k, n);
  }
  for (size_t k = first; k <= last; ++k) schur.t(k, k) = schur.t(k, k) + shift;
}

Schur schur_of(const SmallMatrix &matrix) {
  const size_t n = matrix.n;
  Schur schur{ComplexMatrix(n), ComplexMatrix(n)};
  for (size_t r = 0; r < n; ++r) {
    schur.q(r, r) = {1, 0};
    for (size_t c = 0; c < n; ++c) schur.t(r, c) = {matrix(r, c), 0};
  }
  make_hessenberg(schur);
  int iterations = 0;
  for (size_t last = n - 1; last > 0;) {
    if (negligible(schur.t, last)) {
      --last;
      iterations = 0;
      continue;
    }
    size_t first = last - 1;
    while (first > 0 && !negligible(schur.t, first)) --first;
    MVS_MUST(++iterations < most_qr_iterations, MVS_E_INTERNAL, "eigenvalues",
             "the QR algorithm did not converge");
    // an exceptional shift where the iteration runs in a circle
    const bool circles = iterations % 10 == 0;
    const Complex shift = circles ? schur.t(last, last) + Complex{schur.t(last, last - 1).size(), 0}
                                  : shift_of(schur.t, last);
    qr_iteration(schur, first, last, shift);
  }
  return schur;
}

// The unit eigenvector of T's k-th diagonal number, times Q.
std::vector<Complex> eigenvector(const Schur &schur, size_t k) {
  const size_t n = schur.t.size();
  const double least = unit_roundoff * (schur.t(k, k).size() + std::numeric_limits<double>::min());
  std::vector<Complex> y(n);
  y[k] = {1, 0};
  for (size_t r = k; r-- > 0;) {
    Complex sum;
    for (size_t c = r + 1; c <= k; ++c) sum = sum + schur.t(r, c) * y[c];
    Complex apart = schur.t(k, k) - schur.t(r, r);
    if (apart.size() < least) apart = {least, 0};  // equal eigenvalues
    y[r] = sum / apart;
  }
  std::vector<Complex> v(n);
  double square = 0;
  for (size_t r = 0; r < n; ++r) {
    for (size_t c = 0; c <= k; ++c) v[r] = v[r] + schur.q(r, c) * y[c];
    square += v[r].norm2();
  }
  for (Complex &number : v) number = number * (1 / std::sqrt(square));
  return v;
}

// The number of eigenvalues of a tridiagonal matrix below a value: of negative pivots of the matrix
// less the value (Sylvester's law of inertia).
size_t count_below(const std::vector<double> &diagonal, const std::vector<double> &beside,
                   double value, double least) {
  size_t count = 0;
  double pivot = 1;
  for (size_t k = 0; k < diagonal.size(); ++k) {
    pivot = diagonal[k] - value - (k == 0 ? 0 : beside[k - 1] * beside[k - 1] / pivot);
    if (std::abs(pivot) < least) pivot = -least;
    count += pivot < 0;
  }
  return count;
}

// Solves (T - value) x = b in place, T - value positive definite.
void solve_tridiagonal(const std::vector<double> &diagonal, const std::vector<double> &beside,
                       double value, std::vector<double> &b) {
  const size_t n = diagonal.size();
  std::vector<double> pivot(n);
  for (size_t k = 0; k < n; ++k) {
    pivot[k] = diagonal[k] - value;
    if (k == 0) continue;
    const double ratio = beside[k - 1] / pivot[k - 1];
    pivot[k] -= ratio * beside[k - 1];
    b[k] -= ratio * b[k - 1];
  }
  for (size_t k = n; k-- > 0;) {
    if (k + 1 < n) b[k] -= beside[k] * b[k + 1];
    b[k] /= pivot[k];
  }
}

}  // namespace

SmallestEigen smallest_eigen(const std::vector<double> &diagonal,
                             const std::vector<double> &beside) {
  const size_t n = diagonal.size();
  // circles of Gershgorin
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t k = 0; k < n; ++k) {
    const double radius =
        (k > 0 ? std::abs(beside[k - 1]) : 0) + (k + 1 < n ? std::abs(beside[k]) : 0);
    low = std::min(low, diagonal[k] - radius);
    high = std::max(high, diagonal[k] + radius);
  }
  const double least = unit_roundoff * (std::max(std::abs(low), std::abs(high)) +
                                        std::numeric_limits<double>::min());
  low -= least;
  high += least;
  while (high - low > 2 * least) {
    const double middle = low + (high - low) / 2;
    (count_below(diagonal, beside, middle, least) > 0 ? high : low) = middle;
  }
  // a little below the eigenvalue the matrix is positive definite and inverse iteration is exact to
  // rounding after a few solutions
  SmallestEigen found{high, std::vector<double>(n, 1.0)};
  for (int iteration = 0; iteration < 4; ++iteration) {
    solve_tridiagonal(diagonal, beside, low - 8 * static_cast<double>(n) * least, found.vector);
    double square = 0;
    for (const double number : found.vector) square += number * number;
    for (double &number : found.vector) number /= std::sqrt(square);
  }
  return found;
}

LeftmostEigen leftmost_eigen(const SmallMatrix &matrix) {
  const Schur schur = schur_of(matrix);
  size_t k = 0;
  for (size_t i = 1; i < matrix.n; ++i) {
    if (schur.t(i, i).re < schur.t(k, k).re) k = i;
  }
  LeftmostEigen found;
  found.real = schur.t(k, k).re;
  const double turn = schur.t(k, k).im < 0 ? -1 : 1;
  found.imaginary = turn * schur.t(k, k).im;
  for (const Complex &number : eigenvector(schur, k)) {
    found.vector_real.push_back(number.re);
    found.vector_imaginary.push_back(turn * number.im);
  }
  return found;
}

}  // namespace mvs::core
