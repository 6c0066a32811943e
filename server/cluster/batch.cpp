#include "server/cluster/batch.h"

#include <algorithm>
#include <cassert>
#include <istream>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/protocol/messages.h"
#include "shared/replay/byte_stream.h"
#include "shared/replay/zstd_input.h"
#include "shared/replay/zstd_packer.h"

namespace woodlouse::server {
namespace {

using core::joined;

constexpr json::Limits kLineLimits{4, 8 + 8 * kMostRoomsOfShard};
constexpr std::size_t kMostUnpacked = std::size_t{33} << 20;  // a line of a recording, and some more
static_assert(kMostUnpacked > 2 * kMostWholeBytes);

std::string text_of(const json::Fields& fields, std::string_view key, std::size_t most,
                    json::Problems& problems) {
  const auto value = fields.demand(key);
  return value ? json::text_in(*value, 1, most, problems).value_or("") : "";
}

/// As many words of 16 hex digits.
template <std::size_t kWords>
std::array<std::uint64_t, kWords> words_of(const json::Fields& fields, std::string_view key,
                                           json::Problems& problems) {
  std::array<std::uint64_t, kWords> words{};
  const auto value = fields.demand(key);
  const auto text = value ? json::text_in(*value, 16 * kWords, 16 * kWords, problems) : std::nullopt;
  for (std::size_t k = 0; text && k < kWords; ++k) {
    const auto word = json::unsigned_text(std::string_view(*text).substr(16 * k, 16), 16);
    if (!word) {
      problems.add(*value, "is to be hex digits");
      break;
    }
    words[k] = *word;
  }
  return words;
}

template <std::size_t kWords>
std::string hex_of(const std::array<std::uint64_t, kWords>& words) {
  std::string text;
  for (const std::uint64_t word : words) text += core::to_hex(word);
  return text;
}

/// Of what a newer build may say more.
constexpr std::initializer_list<std::string_view> kAnyMembers{};

/// read(fields, problems) of the object that the line is. known: the members that it may have.
template <typename Read>
auto read_object(std::string_view line, const std::string& place,
                 std::initializer_list<std::string_view> known, const Read& read)
    -> core::Expected<decltype(read(std::declval<const json::Fields&>(), std::declval<json::Problems&>()))> {
  const auto document = json::parse_file(line, place, kLineLimits, 1);
  if (!document) return tl::unexpected(document.error());
  if (!document->root().is(json::Kind::kObject)) return core::fail(place, "a line is no object");
  json::Problems problems(place);
  const json::Fields fields = known.size() == 0 ? json::Fields(document->root(), problems)
                                                : json::Fields(document->root(), known, problems);
  auto value = read(fields, problems);
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return value;
}

RoomPlace read_place(const json::Value& value, json::Problems& problems) {
  if (!value.is(json::Kind::kObject)) {
    problems.add(value, "is to be an object");
    return {};
  }
  const json::Fields fields(value, {"room", "header", "keyframe", "tick"}, problems);
  RoomPlace place;
  place.room = text_of(fields, "room", kMostRoomBytes, problems);
  place.header = fields.integer("header", 0, kMostCount);
  place.keyframe = fields.integer("keyframe", 0, kMostCount);
  place.tick = fields.integer("tick", 0, kMostCount);
  return place;
}

core::Expected<BatchHead> read_head(std::string_view line, const std::string& place) {
  return read_object(line, place, {"batch", "epoch", "host", "nonce", "behavior", "rooms", "part", "parts"},
                     [](const json::Fields& fields, json::Problems& problems) {
                       BatchHead head;
                       head.number = fields.integer("batch", 0, kMostCount);
                       head.writer.epoch = fields.integer("epoch", 0, kMostCount);
                       head.writer.host = text_of(fields, "host", kMostHostBytes, problems);
                       head.writer.nonce = words_of<2>(fields, "nonce", problems);
                       head.behavior = static_cast<int>(fields.integer("behavior", 0, 1'000'000));
                       const auto rooms = fields.demand("rooms");
                       if (rooms && (!rooms->is(json::Kind::kArray) || rooms->size() > kMostRoomsOfShard))
                         problems.add(*rooms, "is to be a list of no more rooms than a shard has");
                       else if (rooms)
                         rooms->for_each([&](const json::Value& value) {
                           head.rooms.push_back(read_place(value, problems));
                           return true;
                         });
                       if (!fields.find("parts")) return head;
                       head.parts = static_cast<std::uint32_t>(fields.integer("parts", 2, kMostParts));
                       head.part = static_cast<std::uint32_t>(
                           fields.integer("part", 0, std::max<std::uint32_t>(head.parts, 1) - 1));
                       return head;
                     });
}

/// All of it; nothing where it is longer than it may be.
core::Expected<std::string> unpacked(std::string_view packed, const std::string& place) {
  // Most batches are of a few KB: to clear a file's buffers would take longer than to unpack one.
  constexpr std::size_t kBufferBytes = 16384;
  replay::ZstdInput buffer(std::make_unique<replay::BytesStream>(std::make_shared<const std::string>(packed)),
                           kBufferBytes);
  std::istream in(&buffer);
  std::string text;
  char part[kBufferBytes];
  while (in.read(part, sizeof part) || in.gcount() > 0) {
    text.append(part, static_cast<std::size_t>(in.gcount()));
    if (text.size() > kMostUnpacked) return core::fail(place, "unpacks to more than a batch may have");
  }
  if (buffer.is_cut_off() || !buffer.fault().empty() || text.empty() || text.back() != '\n')
    return core::fail(place, buffer.fault().empty() ? "is no whole batch" : buffer.fault());
  return text;
}

}  // namespace

std::string pack(const BatchHead& head, std::string_view lines) {
  const bool is_whole = head.part + 1 == head.parts;
  assert(head.part < head.parts && (!is_whole || lines.empty() || lines.back() == '\n'));
  assert(head.rooms.size() <= kMostRoomsOfShard && !head.writer.host.empty());
  std::string text;
  json::ObjectText line(text);
  line.integer("batch", head.number)
      .integer("epoch", head.writer.epoch)
      .text("host", head.writer.host)
      .text("nonce", hex_of(head.writer.nonce))
      .integer("behavior", head.behavior)
      .objects("rooms", head.rooms, [](json::ObjectText& object, const RoomPlace& place) {
        object.text("room", place.room)
            .integer("header", place.header)
            .integer("keyframe", place.keyframe)
            .integer("tick", place.tick);
      });
  if (head.parts > 1) line.integer("part", head.part).integer("parts", head.parts);
  line.end_line();
  text += lines;
  if (!is_whole) text += '\n';
  return replay::FramePacker::whole_frame(text);
}

std::vector<std::string> pack_in_parts(const BatchHead& head, const std::vector<RoomPlace>& before,
                                       std::string_view lines) {
  assert(head.parts == 1);
  std::vector<std::string> packed;
  if (lines.size() <= kMostWholeBytes) {
    packed.push_back(pack(head, lines));
    if (packed.front().size() <= kMostMessageBytes) return packed;
    packed.clear();
  }
  if (lines.size() > kMostParts * kPartBytes) return packed;
  BatchHead part = head;
  part.parts = static_cast<std::uint32_t>((lines.size() + kPartBytes - 1) / kPartBytes);
  for (; part.part < part.parts; ++part.part, ++part.number) {
    part.rooms = part.part + 1 == part.parts ? head.rooms : before;
    packed.push_back(pack(part, lines.substr(part.part * kPartBytes, kPartBytes)));
    assert(packed.back().size() <= kMostMessageBytes);
  }
  return packed;
}

std::optional<std::string_view> WholeBatches::take(const Batch& batch) {
  const BatchHead& head = batch.head;
  const bool goes_on = head.part != 0 && head.part == next_ && head.parts == last_.parts &&
                       head.writer == last_.writer && head.number == last_.number + 1;
  last_ = head;
  next_ = 0;
  if (head.parts == 1) return batch.lines;
  if (head.part == 0) lines_.clear();
  if (head.part != 0 && !goes_on) return std::nullopt;
  lines_ += batch.lines;
  if (head.part + 1 == head.parts) return lines_;
  next_ = head.part + 1;
  return std::nullopt;
}

core::Expected<Batch> unpack(std::string_view packed, const std::string& place) {
  if (packed.empty())
    return core::fail(place, "is gone from the log", "NATS gives out nothing whose checksum is wrong");
  auto text = unpacked(packed, place);
  if (!text) return tl::unexpected(text.error());
  const std::size_t end = text->find('\n');
  assert(end != std::string::npos);
  auto head = read_head(std::string_view(*text).substr(0, end), place);
  if (!head) return tl::unexpected(head.error());
  std::string lines = text->substr(end + 1);
  if (head->part + 1 != head->parts) {
    if (lines.empty()) return core::fail(place, "is a part of nothing");
    lines.pop_back();  // the newline that each message ends with
  }
  if (head->parts > 1 && lines.size() > kPartBytes)
    return core::fail(place, "is a longer part than there is");
  return Batch{std::move(*head), std::move(lines)};
}

void append_room(std::string& out, std::string_view room) {
  json::ObjectText line(out);
  line.text("room", room);
  line.end_line();
}

void append_claim(std::string& out, const Claim& claim) {
  json::ObjectText line(out);
  line.integer("claim", claim.louse)
      .text("name", claim.name)
      .text("role", protocol::to_text(claim.role))
      .text("token", hex_of(claim.token));
  if (claim.muted_until != 0) line.integer("muted_until", claim.muted_until);
  line.end_line();
}

void append_closed(std::string& out, std::string_view room) {
  json::ObjectText line(out);
  line.text("closed", room);
  line.end_line();
}

core::Expected<BatchLine> read_batch_line(std::string_view line, const std::string& place) {
  if (line.starts_with(R"({"room":)"))
    return read_object(line, place, {"room"}, [](const json::Fields& fields, json::Problems& problems) {
      return BatchLine(RoomLine{text_of(fields, "room", kMostRoomBytes, problems)});
    });
  if (line.starts_with(R"({"closed":)"))
    return read_object(line, place, {"closed"}, [](const json::Fields& fields, json::Problems& problems) {
      return BatchLine(ClosedLine{text_of(fields, "closed", kMostRoomBytes, problems)});
    });
  if (!line.starts_with(R"({"claim":)")) return RecordedLine{line};
  return read_object(line, place, kAnyMembers, [](const json::Fields& fields, json::Problems& problems) {
    Claim claim;
    claim.louse = static_cast<match::PlayerId>(fields.integer("claim", 0, UINT32_MAX));
    claim.name = text_of(fields, "name", protocol::kMaxNameBytes, problems);
    const auto role = fields.demand("role");
    const auto known = role ? json::choice_of(*role, protocol::role_from_text) : std::nullopt;
    if (role && (!known || *known == protocol::Role::kSpectator))
      problems.add(*role, "is to be player or bot");
    claim.role = known.value_or(protocol::Role::kPlayer);
    claim.token = words_of<4>(fields, "token", problems);
    if (fields.find("muted_until")) claim.muted_until = fields.integer("muted_until", 1, kMutedForGood);
    return BatchLine(std::move(claim));
  });
}

}  // namespace woodlouse::server
