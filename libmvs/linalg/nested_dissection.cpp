// Recursive halves, and their separators.
#include "linalg/nested_dissection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "linalg/direct_solver.h"

namespace mvs::core {
namespace {

// Nodes of the smallest part that is divided. 50 to 400 give the same work within 5 % (26,000
// nodes).
constexpr size_t smallest_divided = 100;

class Dissection {
 public:
  Dissection(const std::vector<Edge> &pairs, const std::vector<Vec3> &place);
  std::vector<uint32_t> order();

 private:
  enum Side : uint8_t { first, second, outside };
  struct Step {
    uint32_t node, next;
  };

  void link(const std::vector<Edge> &pairs);
  void divide(size_t begin, size_t end);
  Vec3 longest(size_t begin, size_t end) const;
  void halve(size_t begin, size_t end);
  void match(size_t begin, size_t end);
  bool augment(uint32_t from);
  void order_part(size_t begin, size_t end);

  const std::vector<Vec3> &place_;
  std::vector<uint32_t> start_, to_;  // the neighbours of each node
  std::vector<uint32_t> node_;        // in elimination order, as far as it is known
  std::vector<uint8_t> side_;         // in the part that is divided
  std::vector<uint32_t> mate_;        // across the plane
  std::vector<uint32_t> seen_, local_, sorted_[3];
  std::vector<std::pair<double, uint32_t>> along_;
  std::vector<Step> path_;
  uint32_t pass_ = 0;
};

Dissection::Dissection(const std::vector<Edge> &pairs, const std::vector<Vec3> &place)
    : place_(place),
      side_(place.size(), outside),
      mate_(place.size(), none),
      seen_(place.size(), 0),
      local_(place.size(), none) {
  node_.resize(place.size());
  for (uint32_t i = 0; i < node_.size(); ++i) node_[i] = i;
  link(pairs);
}

void Dissection::link(const std::vector<Edge> &pairs) {
  start_.assign(place_.size() + 1, 0);
  for (const Edge &p : pairs) {
    for (const uint32_t i : p) ++start_[i + 1];
  }
  for (size_t i = 0; i < place_.size(); ++i) start_[i + 1] += start_[i];
  to_.resize(start_.back());
  std::vector<uint32_t> at(start_.begin(), start_.end() - 1);
  for (const Edge &p : pairs) {
    to_[at[p[0]]++] = p[1];
    to_[at[p[1]]++] = p[0];
  }
  // each neighbour once
  uint32_t kept = 0;
  for (size_t i = 0; i < place_.size(); ++i) {
    const auto from = to_.begin() + start_[i], end = to_.begin() + at[i];
    std::sort(from, end);
    const auto last = std::unique(from, end);
    start_[i] = kept;
    kept = static_cast<uint32_t>(std::copy(from, last, to_.begin() + kept) - to_.begin());
  }
  start_.back() = kept;
}

std::vector<uint32_t> Dissection::order() {
  divide(0, node_.size());
  return std::move(node_);
}

// Orders the nodes begin .. end: one half, the other half, their separator.
void Dissection::divide(size_t begin, size_t end) {
  if (end - begin < smallest_divided) {
    order_part(begin, end);
    return;
  }
  halve(begin, end);
  match(begin, end);
  for (auto &list : sorted_) list.clear();
  for (size_t k = begin; k < end; ++k) {
    const uint32_t a = node_[k], b = mate_[a];
    if (side_[a] == first && b != none) side_[seen_[b] == pass_ ? b : a] = outside;
  }
  for (size_t k = begin; k < end; ++k) sorted_[side_[node_[k]]].push_back(node_[k]);
  const size_t middle = begin + sorted_[first].size(), last = middle + sorted_[second].size();
  auto to = node_.begin() + static_cast<std::ptrdiff_t>(begin);
  for (const auto &list : sorted_) to = std::copy(list.begin(), list.end(), to);
  for (size_t k = begin; k < end; ++k) {
    side_[node_[k]] = outside;
    mate_[node_[k]] = none;
  }
  divide(begin, middle);
  divide(middle, last);
}

// Returns the axis along which the nodes extend most.
Vec3 Dissection::longest(size_t begin, size_t end) const {
  Vec3 mean = Vec3::Zero();
  for (size_t k = begin; k < end; ++k) mean += place_[node_[k]];
  mean /= static_cast<double>(end - begin);
  Mat3 moments = Mat3::Zero();
  for (size_t k = begin; k < end; ++k) {
    const Vec3 d = place_[node_[k]] - mean;
    moments += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Mat3>(moments).eigenvectors().col(2);
}

void Dissection::halve(size_t begin, size_t end) {
  const Vec3 direction = longest(begin, end);
  along_.clear();
  for (size_t k = begin; k < end; ++k) {
    along_.emplace_back(direction.dot(place_[node_[k]]), node_[k]);
  }
  const size_t half = along_.size() / 2;
  std::nth_element(along_.begin(), along_.begin() + static_cast<std::ptrdiff_t>(half),
                   along_.end());
  for (size_t k = 0; k < along_.size(); ++k) side_[along_[k].second] = k < half ? first : second;
}

// Finds a maximum matching of the edges across by augmenting paths. The last pass, which finds no
// path, has seen all nodes that can be reached from an unmatched one: of each matched pair the
// second is in the separator if it was seen, else the first (Koenig).
void Dissection::match(size_t begin, size_t end) {
  for (bool found = true; found;) {
    ++pass_;
    found = false;
    for (size_t k = begin; k < end; ++k) {
      const uint32_t a = node_[k];
      if (side_[a] == first && mate_[a] == none && augment(a)) found = true;
    }
  }
}

// Finds an augmenting path from an unmatched node, and flips the matching along it.
bool Dissection::augment(uint32_t from) {
  path_.assign(1, {from, start_[from]});
  while (!path_.empty()) {
    Step &step = path_.back();
    if (step.next == start_[step.node + 1]) {
      path_.pop_back();
      continue;
    }
    const uint32_t b = to_[step.next++];
    if (side_[b] != second || seen_[b] == pass_) continue;
    seen_[b] = pass_;
    if (mate_[b] != none) {
      path_.push_back({mate_[b], start_[mate_[b]]});
      continue;
    }
    for (const Step &s : path_) {
      mate_[s.node] = to_[s.next - 1];
      mate_[to_[s.next - 1]] = s.node;
    }
    return true;
  }
  return false;
}

void Dissection::order_part(size_t begin, size_t end) {
  if (begin == end) return;
  std::vector<uint32_t> part(node_.begin() + static_cast<std::ptrdiff_t>(begin),
                             node_.begin() + static_cast<std::ptrdiff_t>(end));
  for (uint32_t k = 0; k < part.size(); ++k) local_[part[k]] = k;
  std::vector<Edge> pairs;
  for (uint32_t k = 0; k < part.size(); ++k) {
    for (uint32_t at = start_[part[k]]; at < start_[part[k] + 1]; ++at) {
      const uint32_t other = local_[to_[at]];
      if (other != none && other < k) pairs.push_back({other, k});
    }
  }
  const auto order = fill_reducing_order(static_cast<uint32_t>(part.size()), pairs);
  for (size_t k = 0; k < part.size(); ++k) node_[begin + k] = part[order[k]];
  for (const uint32_t node : part) local_[node] = none;
}

}  // namespace

std::vector<uint32_t> nested_dissection_order(const std::vector<Edge> &pairs,
                                              const std::vector<Vec3> &place) {
  return Dissection(pairs, place).order();
}

double elimination_work(const std::vector<uint32_t> &order, const std::vector<Edge> &pairs) {
  const auto n = static_cast<uint32_t>(order.size());
  std::vector<uint32_t> rank(n), start(n + 1, 0), before(pairs.size());
  for (uint32_t k = 0; k < n; ++k) rank[order[k]] = k;
  const auto later = [&](const Edge &p) { return std::max(rank[p[0]], rank[p[1]]); };
  for (const Edge &p : pairs) ++start[later(p) + 1];
  for (uint32_t r = 0; r < n; ++r) start[r + 1] += start[r];
  std::vector<uint32_t> at(start.begin(), start.end() - 1);
  for (const Edge &p : pairs) before[at[later(p)]++] = std::min(rank[p[0]], rank[p[1]]);
  // row r has an entry in the columns from those of its pairs up the elimination tree
  std::vector<uint32_t> parent(n, none), seen(n), count(n, 1);
  for (uint32_t r = 0; r < n; ++r) {
    seen[r] = r;
    for (uint32_t k = start[r]; k < start[r + 1]; ++k) {
      for (uint32_t c = before[k]; seen[c] != r; c = parent[c]) {
        if (parent[c] == none) parent[c] = r;
        ++count[c];
        seen[c] = r;
      }
    }
  }
  double sum = 0;
  for (const double c : count) sum += c * c;
  return sum;
}

}  // namespace mvs::core
