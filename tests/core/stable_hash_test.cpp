#include "shared/core/stable_hash.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "shared/core/random.h"

using namespace woodlouse::core;

TEST_CASE("the stable hash is XXH64 with seed 0, by its published test values") {
  CHECK(to_hex(stable_hash("")) == "ef46db3751d8e999");
  CHECK(to_hex(stable_hash("a")) == "d24ec4f1a98c6e5b");
  CHECK(to_hex(stable_hash("abc")) == "44bc2cf5ad770999");
}

TEST_CASE("texts hashed side by side have the hashes that each has alone") {
  const std::size_t size = 32 * GENERATE(as<std::size_t>{}, 1, 2, 7, 208);
  const std::size_t count = GENERATE(range<std::size_t>(0, 20));
  Random random(size + count);
  std::string bytes;
  while (bytes.size() < count * size) bytes.push_back(static_cast<char>(random.next()));
  std::vector<const char*> texts;  // anywhere in memory, and in no order
  for (std::size_t i = 0; i < count; ++i) texts.push_back(bytes.data() + (i * 7 % count) * size);
  std::vector<std::uint64_t> hashes(count + 1, 42);
  stable_hashes(texts, size, hashes.data());
  for (std::size_t i = 0; i < count; ++i) CHECK(hashes[i] == stable_hash({texts[i], size}));
  CHECK(hashes[count] == 42);
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
