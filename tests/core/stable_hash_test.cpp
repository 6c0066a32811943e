#include "shared/core/stable_hash.h"

#include <catch2/catch.hpp>
#include <string>

using namespace woodlouse::core;

TEST_CASE("the stable hash is XXH64 with seed 0, by its published test values") {
  CHECK(to_hex(stable_hash("")) == "ef46db3751d8e999");
  CHECK(to_hex(stable_hash("a")) == "d24ec4f1a98c6e5b");
  CHECK(to_hex(stable_hash("abc")) == "44bc2cf5ad770999");
}

TEST_CASE("hashing in pieces gives the hash of the whole") {
  const std::string text(1000, 'w');
  StableHasher hasher;
  for (std::size_t cut = 0; cut < text.size(); cut += 37) {
    hasher.reset();
    hasher.append(text.data(), cut);
    hasher.append(text.data() + cut, text.size() - cut);
    CHECK(hasher.value() == stable_hash(text));
  }
}
