// nlohmann's own document as the judge of ours, which is built from its events: what it takes and what it
// reads, ours takes and reads, but for what a strict reader refuses.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "shared/json/document.h"

namespace woodlouse::json {
namespace {

using Oracle = nlohmann::json;

const std::vector<std::string> kTexts = {
    R"({"type":"join","protocol":1,"name":"Zo\u00eb","fields":["x","id"],"state_hz":20})",
    R"([1,-2,0,-0,0.5,-1.25e-3,1E+2,123456789012345678901234567890,5e-324,1e-400,1.7976931348623157e308])",
    R"( { "a" : [ ] , "b" : { } , "c" : [ [ null , true ] , false ] } )",
    R"("h\u00e9llo \"you\" \ud83d\udc1e \b\f\n\r\t\/\\ Zoë 木虱 🐞")",
    R"([18446744073709551615,-9223372036854775808,9223372036854775808,1e22,0.1])",
};

std::string mutated(std::mt19937_64& random) {
  static const std::vector<std::string> kPieces = {"0",
                                                   "-1",
                                                   "1.0",
                                                   "1e999",
                                                   "1e-999",
                                                   "-0",
                                                   "null",
                                                   "tru",
                                                   "NaN",
                                                   "{",
                                                   "}",
                                                   "[",
                                                   "]",
                                                   ",",
                                                   ":",
                                                   "\"",
                                                   "\\",
                                                   "\\u0000",
                                                   "\\ud800",
                                                   "\\udc1e",
                                                   "\xff",
                                                   "\xc2",
                                                   "\xed\xa0\x80",
                                                   "\xf4\x90\x80\x80",
                                                   "\xef\xbb\xbf",
                                                   "\"k\":",
                                                   "\"\"",
                                                   "{}",
                                                   "\n",
                                                   "\t",
                                                   "\x7f",
                                                   "\v",
                                                   "e5",
                                                   ".5",
                                                   "+",
                                                   "1e",
                                                   "0x1",
                                                   "/**/"};
  std::string text = kTexts[random() % kTexts.size()];
  for (std::size_t edits = random() % 4; edits > 0 && !text.empty(); --edits) {
    const std::size_t at = random() % text.size();
    switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(1 + random() % 255);
        break;  // the oracle takes a NUL for the end
      case 1:
        text.erase(at, 1 + random() % 6);
        break;
      case 2:
        text.insert(at, kPieces[random() % kPieces.size()]);
        break;
      default:
        text.replace(at, 1 + random() % 3, kPieces[random() % kPieces.size()]);
        break;
    }
  }
  return text;
}

bool same(Value ours, const Oracle& theirs) {
  switch (ours.kind()) {
    case Kind::kNull:
      return theirs.is_null();
    case Kind::kBoolean:
      return theirs.is_boolean() && theirs.get<bool>() == ours.boolean();
    case Kind::kString:
      return theirs.is_string() && theirs.get_ref<const std::string&>() == ours.text();
    case Kind::kFraction:
      return theirs.is_number_float() && theirs.get<double>() == ours.number();
    case Kind::kInteger:
      if (!theirs.is_number() || theirs.get<double>() != ours.number()) return false;
      if (theirs.is_number_unsigned() && ours.unsigned_integer() != theirs.get<std::uint64_t>()) return false;
      return !theirs.is_number_integer() || theirs.is_number_unsigned() ||
             ours.integer() == theirs.get<std::int64_t>();
    case Kind::kArray: {
      bool is_same = theirs.is_array() && theirs.size() == ours.size();
      std::size_t index = 0;
      if (is_same) ours.for_each([&](Value child) { return is_same = same(child, theirs[index++]); });
      return is_same;
    }
    case Kind::kObject: {
      bool is_same = theirs.is_object() && theirs.size() == ours.size();
      ours.for_each([&](Value child) {
        const auto found = is_same ? theirs.find(std::string(child.key())) : theirs.end();
        return is_same = is_same && found != theirs.end() && same(child, *found);
      });
      return is_same;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("of mutated texts those are taken that another reader takes, and read as it reads them") {
  std::mt19937_64 random(11);
  int taken = 0;
  int refused = 0;
  for (int round = 0; round < 60000; ++round) {
    const std::string text = mutated(random);
    INFO(text);
    const Oracle theirs = Oracle::parse(text, nullptr, false);
    const auto ours = parse(text, {100, 1000});
    const bool is_twin = !ours && ours.error().fault == Fault::kDuplicateKey;  // the oracle lets them pass
    if (is_twin) continue;
    REQUIRE(ours.has_value() != theirs.is_discarded());
    ++(ours ? taken : refused);
    if (ours) REQUIRE(same(ours->root(), theirs));
    if (!ours) REQUIRE(ours.error().offset <= text.size());
  }
  CHECK(taken > 5000);
  CHECK(refused > 5000);
}

}  // namespace woodlouse::json
