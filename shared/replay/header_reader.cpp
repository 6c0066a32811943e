#include "shared/replay/header_reader.h"

#include "shared/core/joined.h"
#include "shared/replay/line_fields.h"

namespace woodlouse::replay {
namespace {

using core::joined;
using json::Fields;
using json::Problems;

constexpr std::size_t kMaxPathBytes = 4096;

void read_map(const json::Value& value, Header& header, Problems& problems) {
  const Fields fields(value, {"name", "hash", "definition", "file"}, problems);
  header.map_name = fields.text("name", kMaxTextBytes);
  header.map_hash = fields.hash("hash");
  const auto definition = fields.find("definition");
  const auto file = fields.find("file");
  if (definition.has_value() == file.has_value()) {
    problems.add(value, "either a definition or a file is wanted");
  } else if (definition && !definition->is(json::Kind::kObject)) {
    problems.add(*definition, "an object is wanted");
  } else if (definition) {
    header.map_definition = definition->raw();
  } else {
    header.map_file = json::text_in(*file, 1, kMaxPathBytes, problems).value_or("");
  }
}

Parent read_parent(const json::Value& value, Problems& problems) {
  const Fields fields(value, {"file", "tick", "hash"}, problems);
  return {fields.text("file", kMaxTextBytes), fields.integer("tick", 0, kMaxTick), fields.hash("hash")};
}

/// Format, version and behavior first: what another version's other fields mean, this build can't know.
void check_kind(const json::Value& root, Problems& problems) {
  const auto format = root.find("format");
  if (!format || !format->is(json::Kind::kString) || format->text() != kFormat) {
    problems.add(root, "is no recording: it does not begin with \"format\":\"woodlouse-replay\"");
    return;
  }
  const auto check = [&](std::string_view key, int own) {
    const auto value = root.find(key);
    if (!value) return problems.add(root, joined({"\"", key, "\" is missing"}));
    const auto number = value->integer();
    if (number == own) return;
    const std::string theirs = number ? std::to_string(*number) : std::string("something else");
    problems.add(
        *value,
        joined({"recorded with ", key, " ", theirs, ", this program has ", key, " ", std::to_string(own)}),
        "take a program of that one");
  };
  check("version", kFormatVersion);
  check("behavior", match::kBehavior);
}

}  // namespace

Header read_header(const json::Value& root, Problems& problems) {
  Header header;
  check_kind(root, problems);
  if (problems.count() != 0) return header;
  const Fields fields(
      root, {"format", "version", "behavior", "build", "seed", "tick_hz", "mode", "parent", "map"}, problems);
  header.build = fields.text("build", kMaxTextBytes);
  if (const auto seed = fields.demand("seed")) {
    const auto number = seed->is(json::Kind::kString) ? json::unsigned_text(seed->text(), 10) : std::nullopt;
    if (!number) problems.add(*seed, "a whole number of 64 bits as text is wanted");
    header.seed = number.value_or(0);
  }
  header.tick_hz = static_cast<std::uint32_t>(fields.integer("tick_hz", 1, 1000));
  if (const auto value = fields.find("mode")) {
    const auto mode = json::choice_of(*value, state::mode_from_text);
    if (!mode) problems.add(*value, "is no mode of play that this build knows");
    header.mode = mode.value_or(state::Mode::kRoam);
  }
  if (const auto value = fields.find("parent")) header.parent = read_parent(*value, problems);
  if (const auto value = fields.demand("map")) read_map(*value, header, problems);
  return header;
}

}  // namespace woodlouse::replay
