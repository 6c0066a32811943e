// docs/protocol.md is what people write clients from: its tables and examples are held against the code.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <string>

#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

using namespace woodlouse::protocol;

namespace {

std::string document() {
  std::ifstream file(WOODLOUSE_SOURCE_DIR "/docs/protocol.md");
  REQUIRE(file);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string ends_text(Ends ends) {
  switch (ends) {
    case Ends::kNo:
      return "no";
    case Ends::kRepeated:
      return "third running";
    case Ends::kYes:
      return "yes";
  }
  return {};
}

std::string quantum_text(Column column) {
  const double per_quantum = 1.0 / quantum(column);
  return per_quantum == 1.0 ? "1" : "1/" + std::to_string(static_cast<int>(per_quantum));
}

}  // namespace

TEST_CASE("the table of codes in docs/protocol.md is the one in the code") {
  const std::string text = document();
  for (const CodeEntry& entry : codes()) {
    const std::string row = "| `" + std::string(entry.code) + "` | " + std::string(entry.messages) + " | " +
                            ends_text(entry.ends) + " | " + std::string(entry.meaning) + " |\n";
    INFO(row);
    CHECK(text.find(row) != std::string::npos);
  }
}

TEST_CASE("the table of limits in docs/protocol.md is the one in the code") {
  const std::string text = document();
  std::size_t at = 0;
  for (const LimitField& field : limit_fields()) {
    const std::string row = "| `" + std::string(field.name) + "` | " + std::string(field.unit) + " | " +
                            std::string(field.meaning) + " |\n";
    INFO(row);
    const std::size_t found = text.find(row);
    REQUIRE(found != std::string::npos);
    CHECK(found > at);
    at = found;
  }
}

TEST_CASE("the table of columns in docs/protocol.md has each column with its quantum") {
  const std::string text = document();
  for (std::size_t i = 0; i < kColumnCount; ++i) {
    const auto column = static_cast<Column>(i);
    const std::string row = "| `" + std::string(to_text(column)) + "` | " + quantum_text(column) + " | ";
    INFO(row);
    CHECK(text.find(row) != std::string::npos);
  }
}

TEST_CASE("each example line in docs/protocol.md is one the codec takes") {
  std::istringstream text(document());
  std::string line;
  std::string direction;
  int examples = 0;
  while (std::getline(text, line)) {
    if (line.rfind("```", 0) == 0) direction = line.substr(3);
    if (line.empty() || line[0] != '{') continue;
    INFO(direction << ": " << line);
    if (direction == "client") {
      const auto message = decode_client(line);
      if (!message) FAIL(message.error().text);
      ++examples;
    }
    if (direction == "server") {
      const auto message = decode_server(line, default_columns(), Format::kQuantized);
      if (!message) FAIL(message.error().text);
      ++examples;
    }
  }
  CHECK(examples >= 20);
}
