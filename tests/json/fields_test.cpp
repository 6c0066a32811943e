// The checks that the wire's reader and the files' both ask.
#include "shared/json/fields.h"

#include <catch2/catch.hpp>
#include <optional>
#include <string>

using namespace woodlouse;
using namespace woodlouse::json;

namespace {

/// A value, and the text that it is read from.
struct Parsed {
  explicit Parsed(const std::string& of)
      : text("{\"v\":" + of + "}"),
        document(parse_file(text, "t", {8, 100}).value()),
        value(*document.root().find("v")) {}
  std::string text;
  Document document;
  Value value;
};

}  // namespace

TEST_CASE("a hash is 16 lower-case hex digits in quotes, and nothing else") {
  CHECK(hash_of(Parsed(R"("00000000deadbeef")").value) == 0xdeadbeefULL);
  CHECK(hash_of(Parsed(R"("ffffffffffffffff")").value) == 0xffff'ffff'ffff'ffffULL);
  for (const char* text :
       {R"("00000000DEADBEEF")", R"("deadbeef")", R"("0x000000deadbeef")", R"("00000000deadbeef0")",
        R"(" 0000000deadbeef")", R"("-000000000000001")", "12", "null", "[]"}) {
    INFO(text);
    CHECK_FALSE(hash_of(Parsed(text).value));
  }
}

TEST_CASE("a pair is two numbers, an integer a whole one of its range") {
  CHECK(pair_of(Parsed("[1,-2.5]").value) == core::Vec2{1.0, -2.5});
  for (const char* text : {"[1]", "[1,2,3]", "[1,\"2\"]", "1", "{}", "[null,1]"})
    CHECK_FALSE(pair_of(Parsed(text).value));
  CHECK(integer_of(Parsed("-3").value, -3, 5) == -3);
  CHECK(integer_of(Parsed("5").value, -3, 5) == 5);
  for (const char* text : {"-4", "6", "1.5", "\"1\"", "1e3"}) {
    INFO(text);
    CHECK_FALSE(integer_of(Parsed(text).value, -3, 5));
  }
}

TEST_CASE("what must be there is reported with its field where it is missing or wrong") {
  const auto document = parse_file(R"({"tick":-1,"hash":"no","name":"four"})", "f.json", {8, 100});
  REQUIRE(document);
  Problems problems("f.json");
  const Fields fields(document->root(), {"tick", "hash", "name", "gone"}, problems);
  CHECK(fields.integer("tick", 2, 9) == 2);
  CHECK(fields.hash("hash") == 0);
  CHECK(fields.text("name", 3).empty());
  CHECK(fields.hash("gone") == 0);
  REQUIRE(problems.count() == 4);
  CHECK_THAT(problems.errors()[0].text(), Catch::Contains("tick"));
  CHECK_THAT(problems.errors()[1].text(), Catch::Contains("16 lower-case hex digits"));
  CHECK_THAT(problems.errors()[2].text(), Catch::Contains("at most 3 bytes"));
  CHECK_THAT(problems.errors()[3].text(), Catch::Contains("\"gone\" is missing"));
}
