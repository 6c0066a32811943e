// The one object writer, against the parser.
#include "shared/json/object_text.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

using namespace woodlouse;
using namespace woodlouse::json;

TEST_CASE(
    "every kind of member stands in the order it was added, with commas between and none before the first") {
  std::string out = "before ";
  ObjectText text(out);
  text.text("name", "a \"b\"\n").integer("count", -3).number("half", 0.5).boolean("yes", true);
  text.hash("hash", 0xabcULL).pair("place", {1.0, -0.0}).json("given", "[1,{}]");
  text.array("list", std::vector<int>{1, 2}, [](std::string& to, int value) { append_integer(to, value); });
  text.array("none", std::vector<int>{}, [](std::string& to, int value) { append_integer(to, value); });
  text.object("inner", [](ObjectText& inner) { inner.integer("deep", 1).text("er", "x"); });
  text.object("empty", [](ObjectText&) {});
  text.objects("rows", std::vector<int>{7, 8}, [](ObjectText& row, int value) { row.integer("v", value); });
  text.end();
  CHECK(
      out ==
      R"(before {"name":"a \"b\"\n","count":-3,"half":0.5,"yes":true,"hash":"0000000000000abc","place":[1,-0.0],)"
      R"("given":[1,{}],"list":[1,2],"none":[],"inner":{"deep":1,"er":"x"},"empty":{},"rows":[{"v":7},{"v":8}]})");
  CHECK(nlohmann::json::accept(out.substr(7)));
}

TEST_CASE("a message is a line of its own that begins with its type") {
  std::string line;
  ObjectText(line, "list").end_line();
  ObjectText chat(line, "chat");
  chat.text("text", "hi").end_line();
  CHECK(line == "{\"type\":\"list\"}\n{\"type\":\"chat\",\"text\":\"hi\"}\n");
}

TEST_CASE("rows of numbers stand as arrays of their length") {
  const std::vector<double> values = {1.0, 2.5, -3.0, 4.0, 5.0, 6.0};
  std::string three;
  append_rows(three, values, 3);
  const std::vector<std::vector<double>> by_three = {{1.0, 2.5, -3.0}, {4.0, 5.0, 6.0}};
  CHECK(nlohmann::json::parse(three).get<std::vector<std::vector<double>>>() == by_three);
  std::string one;
  append_rows(one, values, 1);
  CHECK(nlohmann::json::parse(one).size() == 6);
  std::string six;
  append_rows(six, values, 6);
  CHECK(nlohmann::json::parse(six).size() == 1);
}
