// Pyramid of weighted means, read back from the coarsest raster to the finest.
#include "measure/tenting/fill_gaps.h"

#include <algorithm>
#include <cstdint>

namespace mvs::core {
namespace {

constexpr int sweeps = 4;  // at each raster: fills a gap of any width nearly harmonically

struct Level {
  size_t across;
  std::vector<double> weight, sum;
};

// The sums over the four cells below each cell of a raster, with at most a weight of 1.
// sum_of(cell) is the value of a cell times its weight.
template <typename SumOf>
Level coarser(size_t fine_across, const std::vector<double> &weights, SumOf sum_of) {
  const size_t across = fine_across / 2;
  Level level{across, std::vector<double>(across * across), std::vector<double>(across * across)};
  for (size_t row = 0; row < across; ++row) {
    for (size_t column = 0; column < across; ++column) {
      const size_t a = 2 * row * fine_across + 2 * column, b = a + fine_across;
      const double weight = (weights[a] + weights[a + 1]) + (weights[b] + weights[b + 1]);
      const double sum = (sum_of(a) + sum_of(a + 1)) + (sum_of(b) + sum_of(b + 1));
      level.weight[row * across + column] = std::min(weight, 1.0);
      level.sum[row * across + column] = weight > 1 ? sum / weight : sum;
    }
  }
  return level;
}

// The bilinear interpolation of a raster at the centre of a cell of the next finer one.
double interpolate(const std::vector<double> &values, size_t across, size_t row, size_t column) {
  const auto beside = [&](size_t fine) {
    const size_t own = fine / 2;
    return fine % 2 == 0 ? (own == 0 ? 0 : own - 1) : std::min(own + 1, across - 1);
  };
  const size_t r = row / 2, c = column / 2, r2 = beside(row), c2 = beside(column);
  const double near = 0.75 * values[r * across + c] + 0.25 * values[r * across + c2];
  const double far = 0.75 * values[r2 * across + c] + 0.25 * values[r2 * across + c2];
  return 0.75 * near + 0.25 * far;
}

// The cells of a raster that have gaps, with their weights and sums.
struct Gaps {
  std::vector<uint32_t> cells;
  std::vector<double> weight, sum;
};

// Sets the values of gaps from the next coarser raster, then sweeps: each value becomes the mean of
// its neighbours as far as the cell has none of its own (Jacobi's method for the Laplace equation).
void fill(const Gaps &gaps, size_t across, const std::vector<double> &coarse,
          std::vector<double> &values) {
  for (size_t k = 0; k < gaps.cells.size(); ++k) {
    const size_t cell = gaps.cells[k];
    const double around = interpolate(coarse, across / 2, cell / across, cell % across);
    values[cell] = gaps.sum[k] + (1 - gaps.weight[k]) * around;
  }
  std::vector<double> next(gaps.cells.size());
  const size_t last = across - 1;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (size_t k = 0; k < gaps.cells.size(); ++k) {
      const size_t cell = gaps.cells[k], row = cell / across, column = cell % across;
      const double beside = values[column > 0 ? cell - 1 : cell] +
                            values[column < last ? cell + 1 : cell],
                   above = values[row > 0 ? cell - across : cell] +
                           values[row < last ? cell + across : cell];
      next[k] = gaps.sum[k] + 0.25 * (1 - gaps.weight[k]) * (beside + above);
    }
    for (size_t k = 0; k < gaps.cells.size(); ++k) values[gaps.cells[k]] = next[k];
  }
}

}  // namespace

void fill_gaps(const std::vector<double> &weight, size_t across, const std::vector<uint32_t> &cells,
               std::vector<double> &values) {
  std::vector<Level> levels;
  levels.push_back(coarser(across, weight, [&](size_t c) { return weight[c] * values[c]; }));
  while (levels.back().across > 1) {
    const Level &fine = levels.back();
    levels.push_back(coarser(fine.across, fine.weight, [&](size_t c) { return fine.sum[c]; }));
  }
  const Level &top = levels.back();
  std::vector<double> found = {top.weight[0] > 0 ? top.sum[0] / top.weight[0] : 0.0};
  for (size_t k = levels.size() - 1; k-- > 0;) {
    const Level &level = levels[k];
    Gaps gaps;
    for (uint32_t cell = 0; cell < level.weight.size(); ++cell) {
      if (!(level.weight[cell] < 1)) continue;
      gaps.cells.push_back(cell);
      gaps.weight.push_back(level.weight[cell]);
      gaps.sum.push_back(level.sum[cell]);
    }
    std::vector<double> finer = level.sum;
    fill(gaps, level.across, found, finer);
    found = std::move(finer);
  }
  Gaps gaps{cells, {}, {}};
  for (const uint32_t cell : cells) {
    gaps.weight.push_back(weight[cell]);
    gaps.sum.push_back(weight[cell] * values[cell]);
  }
  fill(gaps, across, found, values);
}

}  // namespace mvs::core
