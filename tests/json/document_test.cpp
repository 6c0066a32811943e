#include "shared/json/document.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "shared/core/random.h"
#include "shared/json/text.h"

namespace woodlouse::json {
namespace {

std::string error_of(std::string_view text, const Limits& limits = {}) {
  const auto document = parse_file(text, "f.json", limits);
  return document ? std::string() : document.error().text();
}

/// Random JSON whose every value stands on a line of its own; tells path and line of each.
class RandomJson {
 public:
  explicit RandomJson(std::uint64_t seed) : random_(seed) {}

  struct Place {
    std::string path;
    std::size_t line;
  };
  std::string text;
  std::vector<Place> places;

  void value(const std::string& path, int depth) {
    line();
    places.push_back({path, line_});
    switch (random_.next() % (depth < 5 ? 6 : 4)) {
      case 0:
        text += "null";
        break;
      case 1:
        text += std::to_string(random_.next() % 1000) + (random_.next() % 2 ? ".5e3" : "");
        break;
      case 2:
        append_string(text, "a \"text\"\nwith [brackets] and 12 \\");
        break;
      case 3:
        text += "true";
        break;
      case 4:
        container(path, depth, true);
        break;
      default:
        container(path, depth, false);
        break;
    }
  }

 private:
  void line() {
    for (std::uint64_t n = 1 + random_.next() % 3; n > 0; --n) {
      text += random_.next() % 2 ? "\r\n" : "\n";
      ++line_;
    }
  }
  void container(const std::string& path, int depth, bool array) {
    text += array ? "[" : "{";
    const std::uint64_t count = random_.next() % 5;
    for (std::uint64_t k = 0; k < count; ++k) {
      if (k != 0) text += ",";
      const std::string name = "k" + std::to_string(k);
      if (!array) {
        append_string(text, name);
        text += ":";
      }
      const std::string dot = path.empty() ? "" : ".";
      value(array ? path + "[" + std::to_string(k) + "]" : path + dot + name, depth + 1);
    }
    text += array ? "]" : "}";
  }

  core::Random random_;
  std::size_t line_ = 1;
};

void collect(const Value& value, std::vector<RandomJson::Place>& places) {
  places.push_back({value.path(), value.line()});
  for (const Value& child : value.children()) collect(child, places);
}

}  // namespace

TEST_CASE("every value of a random document knows its path and its line") {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomJson json(seed);
    json.value("", 0);
    const auto document = parse_file(json.text, "f.json", {10, 100000});
    REQUIRE(document);
    std::vector<RandomJson::Place> found;
    collect(document->root(), found);
    REQUIRE(found.size() == json.places.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      CHECK(found[k].path == json.places[k].path);
      CHECK(found[k].line == json.places[k].line);
    }
  }
}

TEST_CASE("every double written as text reads back to the same bits") {
  core::Random random(7);
  for (int k = 0; k < 200000; ++k) {
    const auto value = std::bit_cast<double>(random.next());
    if (!std::isfinite(value)) continue;
    const std::string text = double_text(value);
    const auto document = parse_file(text, "n", {});
    REQUIRE(document);
    const double read = document->root().number();
    REQUIRE(std::bit_cast<std::uint64_t>(read) == std::bit_cast<std::uint64_t>(value));
  }
  CHECK(double_text(-0.0) == "-0.0");
  CHECK(double_text(0.0) == "0");
}

TEST_CASE("integers of 64 bits are read exactly and fractions are none") {
  const std::string text = "[18446744073709551615, -9223372036854775808, 1.0, 1e3, 18446744073709551616, -0]";
  const auto document = parse_file(text, "n", {});
  REQUIRE(document);
  const auto values = document->root().children();
  CHECK(values[0].unsigned_integer() == std::numeric_limits<std::uint64_t>::max());
  CHECK(values[1].integer() == std::numeric_limits<std::int64_t>::min());
  CHECK_FALSE(values[2].unsigned_integer());
  CHECK_FALSE(values[3].unsigned_integer());
  CHECK_FALSE(values[4].unsigned_integer());
  CHECK(std::signbit(values[5].number()));
}

TEST_CASE(
    "a list or object can be cut out of its text, and a part of a file counts its lines from where it "
    "stood") {
  const std::string text = " {\"a\": [1, {\"b\":\n[]} ] ,\n\"c\":-1.50}\n";
  const auto document = parse_file(text, "n", {}, 41);
  REQUIRE(document);
  CHECK(document->root().raw() == text.substr(1, text.size() - 2));
  CHECK(document->root().find("a")->raw() == "[1, {\"b\":\n[]} ]");
  CHECK(document->root().find("c")->raw() == "-1.50");
  CHECK(document->root().find("c")->line() == 43);
  CHECK(parse_file("[\n1,]", "n", {}, 7).error().text().find("n:8: not JSON") == 0);
}

TEST_CASE("duplicate keys, deep nesting and too many values are errors with their line") {
  CHECK(error_of("{\"a\":1,\n\"b\":{\"c\":1,\n\"c\":2}}") ==
        "f.json:3: b.c: stands twice (keep one of them)");
  CHECK(error_of("{\"a\":1,\n\"a\":2}") == "f.json:2: a: stands twice (keep one of them)");
  CHECK(error_of("[{\"a\":1},\n{\"a\":1}]").empty());
  CHECK(error_of("[\n[\n[\n[]]]]", {3, 100}) == "f.json:4: nested more than 3 deep");
  CHECK(error_of("[[[]]]", {3, 100}).empty());
  CHECK(error_of("[1,2,\n3]", {3, 3}) == "f.json:2: more than 3 values");
  CHECK(error_of("[1,2]", {3, 3}).empty());
}

TEST_CASE("what is not JSON is an error with its line") {
  const auto begins = [](std::string_view text, std::string_view wanted) {
    INFO(error_of(text));
    CHECK(error_of(text).substr(0, wanted.size()) == wanted);
  };
  begins("", "f.json:1: not JSON: ");
  begins("\n\n{", "f.json:3: not JSON: ");
  begins("{\"a\":\n nan}", "f.json:2: not JSON: ");
  begins("{\"a\":\n 01}", "f.json:2: not JSON: ");
  begins("[1,\n1e999]", "f.json:2: not JSON: ");
  begins("[\"\xff\"]", "f.json:1: not JSON: ");
  begins("[1]\n\n]", "f.json:3: not JSON: ");
  begins(std::string(100000, '['), "f.json:1: nested more than 8 deep");
}

TEST_CASE("a fault is told with its kind, its place and what stands there") {
  struct Case {
    std::string text;
    Fault fault;
    std::size_t offset;
    std::string detail;
  };
  using namespace std::string_literals;
  const std::vector<Case> cases = {
      {"", Fault::kNotJson, 0, "unexpected end of input"},
      {"{\"a\" 1}", Fault::kNotJson, 6, "expected ':'"},
      {"{\"a\":1,}", Fault::kNotJson, 7, "unexpected '}'"},
      {"[1 2]", Fault::kNotJson, 4, "expected ']'"},
      {"[1]\0[2]"s, Fault::kNotJson, 3, "a NUL byte"},
      {"[-]", Fault::kNotJson, 2, "expected digit after '-'"},
      {"[-01]", Fault::kNotJson, 4, "expected ']'"},
      {"[1e999]", Fault::kNotJson, 6, "the number 1e999 is too large for a double"},
      {"[\"a\xff\"]", Fault::kNotJson, 3, "ill-formed UTF-8"},
      {"[\"a\tb\"]", Fault::kNotJson, 3, "control character"},
      {"[\"\\ud800x\"]", Fault::kNotJson, 8, "surrogate"},
      {"[\"abc", Fault::kNotJson, 4, "missing closing quote"},
      {"{\"a\":1,\"b\":2,\"\\u0061\":3,\"b\":4}", Fault::kDuplicateKey, 22, "a"},
      {"{\"a\":1, \"a\":2}", Fault::kDuplicateKey, 12, "a"},
      {"[[[[]]]]", Fault::kTooDeep, 3, "nested more than 3 deep"},
      {"[1,2,3,4,5]", Fault::kTooManyValues, 9, "more than 5 values"},
  };
  for (const Case& wanted : cases) {
    INFO(wanted.text);
    const auto document = parse(wanted.text, {3, 5});
    REQUIRE_FALSE(document);
    CHECK(document.error().fault == wanted.fault);
    CHECK(document.error().offset == wanted.offset);
    CHECK(document.error().detail.find(wanted.detail) != std::string::npos);
  }
}

TEST_CASE("numbers too near to 0 for a double are 0, those too large are refused, however they are written") {
  const auto number = [](const std::string& text) {
    const auto document = parse(text, {});
    return document ? document->root().number() : std::numeric_limits<double>::quiet_NaN();
  };
  const std::string zeros(400, '0');
  CHECK(number("1e-400") == 0.0);
  CHECK(std::signbit(number("-1e-400")));
  CHECK(number("0." + zeros + "1") == 0.0);
  CHECK(number("0e99999999999999999999") == 0.0);
  CHECK(number("1" + zeros + "e-400") == 1.0);
  CHECK(number("0." + zeros + "1e401") == 1.0);
  CHECK(number("1e-99999999999999999999") == 0.0);
  for (const std::string text : {"1e309", "-1e400", "1e99999999999999999999", "123456e304"}) {
    INFO(text);
    CHECK(std::isnan(number(text)));
  }
  CHECK(std::isnan(number("1" + zeros)));
  CHECK(std::isnan(number("1" + zeros + ".0e-10")));
}

TEST_CASE("a mark of the byte order is passed over at the beginning and nowhere else") {
  CHECK(error_of("\xef\xbb\xbf[1]").empty());
  CHECK_FALSE(error_of("[\xef\xbb\xbf 1]").empty());
}

}  // namespace woodlouse::json
