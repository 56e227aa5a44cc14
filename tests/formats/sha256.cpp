// SHA-256 against the examples of NIST (FIPS 180-4 and the SHA-2 validation vectors).
#include "formats/text/sha256.h"

#include <doctest/doctest.h>
#include <cstdio>
#include <string>

using namespace mvs::core;

namespace {

std::string hex(const Sha256 &sum) {
  std::string text;
  for (const uint8_t byte : sum.value()) {
    char digits[3];
    std::snprintf(digits, sizeof digits, "%02x", byte);
    text += digits;
  }
  return text;
}

std::string digest(std::string_view bytes) {
  Sha256 sum;
  sum.add(bytes);
  return hex(sum);
}

}  // namespace

TEST_CASE("sha256_gives_the_published_digests") {
  CHECK(digest("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(digest("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  CHECK(digest("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmn"
               "hijklmnoijklmnopjklmnopqklmnopqrlmnopqrsmnopqrstnopqrstu") ==
        "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
  CHECK(digest(std::string(1000000, 'a')) ==
        "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  CHECK(digest("\xbd") == "68325720aabd7c82f30f554b313d0570c95accbb7dc4b5aae11204c08ffe732b");
}

// every length around a block, split at every position
TEST_CASE("sha256_does_not_depend_on_the_pieces") {
  for (size_t size = 0; size <= 130; ++size) {
    std::string bytes(size, '\0');
    for (size_t k = 0; k < size; ++k) bytes[k] = static_cast<char>(k * 37 + size);
    const std::string whole = digest(bytes);
    for (size_t cut = 0; cut <= size; ++cut) {
      Sha256 sum;
      sum.add(std::string_view(bytes).substr(0, cut));
      sum.add(std::string_view(bytes).substr(cut));
      REQUIRE(hex(sum) == whole);
    }
  }
}
