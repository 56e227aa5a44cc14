// The hash spreads every bit, and separates consecutive words and texts.
#include "base/hash.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <set>
#include <vector>

using namespace mvs::core;

TEST_CASE("every_bit_of_a_word_changes_about_half_of_the_hash") {
  const uint64_t word = 0x0123456789abcdefu;
  Hash base;
  base.add(word);
  int least = 128, most = 0;
  for (int bit = 0; bit < 64; ++bit) {
    Hash other;
    other.add(word ^ (uint64_t{1} << bit));
    int changed = 0;
    for (int lane = 0; lane < 2; ++lane) {
      changed += std::popcount(base.value()[lane] ^ other.value()[lane]);
    }
    least = std::min(least, changed);
    most = std::max(most, changed);
  }
  // 64 of 128 on average, standard deviation 5.7: six of them either way
  CHECK(least >= 64 - 34);
  CHECK(most <= 64 + 34);
}

TEST_CASE("a_million_counted_words_have_distinct_hashes_in_each_lane") {
  std::vector<uint64_t> lane[2];
  for (uint64_t k = 0; k < 1000000; ++k) {
    Hash hash;
    hash.add(k);
    for (int l = 0; l < 2; ++l) lane[l].push_back(hash.value()[l]);
  }
  for (std::vector<uint64_t> &values : lane) {
    std::sort(values.begin(), values.end());
    CHECK(std::adjacent_find(values.begin(), values.end()) == values.end());
  }
}

TEST_CASE("texts_are_separated") {
  const auto hash_of = [](std::string_view a, std::string_view b) {
    Hash hash;
    hash.add(a);
    hash.add(b);
    return hash.value();
  };
  std::set<std::array<uint64_t, 2>> hashes = {hash_of("ab", "c"), hash_of("a", "bc"),
                                              hash_of("", "abc"), hash_of("abc", ""),
                                              hash_of("b", "ac")};
  CHECK(hashes.size() == 5);
}

TEST_CASE("the_order_of_words_counts") {
  Hash ab, ba;
  ab.add(uint64_t{1});
  ab.add(uint64_t{2});
  ba.add(uint64_t{2});
  ba.add(uint64_t{1});
  CHECK(ab.value() != ba.value());
}
