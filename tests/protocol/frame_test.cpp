// Rows: write_value writes them, decode_server reads them.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "shared/core/stable_hash.h"
#include "shared/protocol/codec.h"

using namespace woodlouse::protocol;

namespace {

void begin_key(std::string& out, std::uint64_t tick) {
  out += R"({"type":"key","tick":)" + std::to_string(tick) + R"(,"louse":[)";
}

void end_key(std::string& out, std::uint64_t hash) {
  out += R"(],"hash":")" + woodlouse::core::to_hex(hash) + "\"}\n";
}

void begin_delta(std::string& out, std::uint64_t tick, std::uint64_t base) {
  out += R"({"type":"delta","tick":)" + std::to_string(tick) + R"(,"base":)" + std::to_string(base) +
         R"(,"louse":[)";
}

void end_delta(std::string& out, const std::vector<std::uint32_t>& gone) {
  out += R"(],"gone":[)";
  for (std::size_t i = 0; i < gone.size(); ++i) out += (i > 0 ? "," : "") + std::to_string(gone[i]);
  out += "]}\n";
}

void append_rows(std::string& out, const std::vector<double>& values, const std::vector<Column>& columns,
                 Format format) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t column = i % columns.size();
    if (column == 0) out += i == 0 ? "[" : ",[";
    if (column > 0) out += ',';
    char text[kValueRoom];
    out.append(text, write_value(text, values[i], columns[column], format));
    if (column + 1 == columns.size()) out += ']';
  }
}

Frame frame_of(const std::string& line, const std::vector<Column>& columns, Format format) {
  REQUIRE(line.back() == '\n');
  const auto message = decode_server(line, columns, format);
  if (!message) FAIL(message.error().text << " in " << line);
  return std::get<Frame>(*message);
}

/// A double of any exponent, by its bits.
double any_double(std::mt19937_64& random) {
  for (;;) {
    const auto value = std::bit_cast<double>(random());
    if (std::isfinite(value)) return value;
  }
}

}  // namespace

TEST_CASE("a key in exact format comes back bit for bit, any double") {
  std::mt19937_64 random(3);
  const auto& columns = default_columns();
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> values;
    for (std::uint32_t id = 1; id <= 5; ++id) {
      values.push_back(id);
      for (int i = 0; i < 4; ++i) values.push_back(random() % 8 == 0 ? -0.0 : any_double(random));
    }
    const std::uint64_t tick = random() >> 11;
    const std::uint64_t hash = random();
    std::string line;
    begin_key(line, tick);
    append_rows(line, values, columns, Format::kExact);
    end_key(line, hash);
    const Frame frame = frame_of(line, columns, Format::kExact);
    REQUIRE(frame.is_key);
    REQUIRE(frame.tick == tick);
    REQUIRE(frame.base == tick);
    REQUIRE(frame.hash == hash);
    REQUIRE(frame.rows() == 5);
    for (std::size_t i = 0; i < values.size(); ++i) {
      REQUIRE(std::bit_cast<std::uint64_t>(frame.values[i]) == std::bit_cast<std::uint64_t>(values[i]));
    }
  }
}

TEST_CASE("quantized values are off by at most half a quantum, and their multiples by nothing") {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> metres(-1000.0, 1000.0);
  std::vector<Column> columns = {Column::kId};
  for (std::size_t i = 1; i < kColumnCount; ++i) columns.push_back(static_cast<Column>(i));
  for (int round = 0; round < 2000; ++round) {
    std::vector<double> values;
    for (const Column column : columns) {
      const double value = std::abs(metres(random));
      values.push_back(quantum(column) == 1.0 ? std::floor(value) + 1.0 : metres(random));
    }
    std::string line;
    begin_delta(line, 90, 60);
    append_rows(line, values, columns, Format::kQuantized);
    end_delta(line, std::vector<std::uint32_t>{4, 9});
    const Frame frame = frame_of(line, columns, Format::kQuantized);
    REQUIRE_FALSE(frame.is_key);
    REQUIRE(frame.base == 60);
    REQUIRE(frame.gone == std::vector<std::uint32_t>{4, 9});
    REQUIRE_FALSE(frame.hash);
    std::string again;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      REQUIRE(std::abs(frame.values[i] - values[i]) <= 0.5 * quantum(columns[i]));
      const double steps = frame.values[i] / quantum(columns[i]);
      REQUIRE(steps == std::nearbyint(steps));
    }
    begin_delta(again, 90, 60);
    append_rows(again, frame.values, columns, Format::kQuantized);
    end_delta(again, frame.gone);
    REQUIRE(again == line);
  }
}

TEST_CASE("of two multiples of the quantum as near, the even one is written") {
  const auto written = [](double steps) {
    char text[kValueRoom];
    return std::string(text, write_value(text, steps * quantum(Column::kX), Column::kX, Format::kQuantized));
  };
  CHECK(written(0.5) == "0");
  CHECK(written(-0.5) == "0");
  CHECK(written(1.5) == "2");
  CHECK(written(2.5) == "2");
  CHECK(written(-2.5) == "-2");
  CHECK(written(-3.5) == "-4");
  CHECK(written(0.49999999999999994) == "0");
  CHECK(written(123456788.5) == "123456788");
  CHECK(written(9007199254740991.0) == "9007199254740991");
}

TEST_CASE("rows read as docs/protocol.md shows them") {
  std::string quantized;
  append_rows(quantized, {1, 0.5, -1.0, 0.0, 0.25, 2, 1, 1, 0, 0}, default_columns(), Format::kQuantized);
  CHECK(quantized == "[1,512,-1024,0,256],[2,1024,1024,0,0]");
  std::string exact;
  append_rows(exact, {1, 0.1, -1.5, -0.0, 1.0 / 3.0}, default_columns(), Format::kExact);
  CHECK(exact == "[1,0.1,-1.5,-0.0,0.3333333333333333]");
}

TEST_CASE("a delta may leave out gone") {
  const Frame frame = frame_of("{\"type\":\"delta\",\"tick\":3,\"base\":3,\"louse\":[]}\n", default_columns(),
                               Format::kExact);
  CHECK(frame.gone.empty());
  CHECK(frame.rows() == 0);
}

TEST_CASE("a key of all columns in exact format carries what its hash is made of, and no other frame does") {
  const std::string head = R"({"type":"key","tick":7,"louse":[],"hash":"0000000000000001")";
  const auto proof_of_link = [](int tick) {
    return R"(,"previous":"0000000000000002","inputs":"ffffffffffffffff","roster":"0000000000000004",)"
           R"("rules":"0000000000000000","link":)" +
           std::to_string(tick) + R"(,"generator":"000000000000000a"})";
  };
  const std::string proof = proof_of_link(5);
  const Frame proved = frame_of(head + proof + "\n", all_columns(), Format::kExact);
  REQUIRE(proved.proof);
  CHECK(*proved.proof == woodlouse::state::HashLink{2, 0xffff'ffff'ffff'ffff, 4, 0, 5, 10});
  CHECK_FALSE(decode_server(head + proof_of_link(8) + "\n", all_columns(), Format::kExact));
  CHECK_FALSE(frame_of(head + proof + "\n", all_columns(), Format::kQuantized).proof);
  CHECK_FALSE(frame_of(head + "}\n", default_columns(), Format::kExact).proof);
  CHECK_FALSE(decode_server(head + "}\n", all_columns(), Format::kExact));
  const std::string delta = R"({"type":"delta","tick":9,"base":7,"louse":[],"gone":[]})"
                            "\n";
  CHECK_FALSE(frame_of(delta, all_columns(), Format::kExact).proof);
}
