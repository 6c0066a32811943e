#include "server/frames/line.h"

#include <catch2/catch.hpp>

#include <array>
#include <string>

namespace woodlouse::server {
namespace {

Line line_of(LinePool& pool, std::size_t bytes) {
  return pool.line([bytes](std::string& text) { text.append(bytes, 'x'); });
}

TEST_CASE("a pool writes into the memory of a line that nobody holds", "[line]") {
  LinePool pool(1024);
  const char* memory = line_of(pool, 500)->data();
  CHECK(line_of(pool, 400)->data() == memory);
  const Line held = line_of(pool, 300);
  CHECK(held->data() == memory);
  CHECK(line_of(pool, 300)->data() != memory);
  CHECK(*held == std::string(300, 'x'));
}

TEST_CASE("a pool keeps no line that grew past what it keeps", "[line]") {
  LinePool pool(1024);
  line_of(pool, 500);
  CHECK(line_of(pool, 12000)->size() == 12000);
  CHECK(line_of(pool, 10)->capacity() <= 1024);
}

TEST_CASE("a pool of which one line grew away keeps the others", "[line]") {
  LinePool pool(1024);
  const char* memory = nullptr;
  {
    const std::array held = {line_of(pool, 500), line_of(pool, 500), line_of(pool, 500)};
    memory = held[2]->data();
  }
  line_of(pool, 12000);
  CHECK(line_of(pool, 500)->data() == memory);
}

}  // namespace
}  // namespace woodlouse::server
