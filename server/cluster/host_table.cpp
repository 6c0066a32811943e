#include "server/cluster/host_table.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "shared/core/joined.h"
#include "shared/core/random.h"
#include "shared/core/stable_hash.h"
#include "shared/json/document.h"
#include "shared/json/fields.h"
#include "shared/json/object_text.h"
#include "shared/protocol/whereabouts.h"

namespace woodlouse::server {
namespace {

constexpr json::Limits kBeatLimits{4, 32 + 8 * kMostRoomsOfShard};
constexpr std::size_t kMostBeatBytes = 4096 + 512 * kMostRoomsOfShard;

protocol::RoomEntry read_room(const json::Value& value, json::Problems& problems) {
  protocol::RoomEntry room;
  if (!value.is(json::Kind::kObject)) {
    problems.add(value, "is to be an object");
    return room;
  }
  const json::Fields fields(value, problems);
  room.name = fields.text("name", kMostRoomBytes);
  room.map = fields.text("map", kMostRoomBytes);
  room.players = static_cast<std::uint32_t>(fields.integer("players", 0, UINT32_MAX));
  room.bots = static_cast<std::uint32_t>(fields.integer("bots", 0, UINT32_MAX));
  room.spectators = static_cast<std::uint32_t>(fields.integer("spectators", 0, UINT32_MAX));
  return room;
}

bool flag_of(const json::Fields& fields, std::string_view key, json::Problems& problems) {
  const auto value = fields.demand(key);
  if (value && !value->is(json::Kind::kBoolean)) problems.add(*value, "is to be true or false");
  return value && value->is(json::Kind::kBoolean) && value->boolean();
}

}  // namespace

std::string to_text(const Beat& beat) {
  std::string text;
  json::ObjectText line(text);
  line.text("host", beat.host)
      .text("address", beat.address)
      .text("shard", beat.shard)
      .boolean("owns", beat.owns)
      .boolean("leaves", beat.leaves)
      .boolean("ready", beat.ready)
      .hash("process", beat.process)
      .text("writer", beat.writer.host)
      .integer("epoch", beat.writer.epoch)
      .hash("nonce", beat.writer.nonce[0])
      .hash("nonce2", beat.writer.nonce[1])
      .integer("sequence", beat.sequence)
      .integer("silent_ms", beat.silent_ms)
      .text("to", beat.to);
  if (beat.strict) line.boolean("strict", *beat.strict);
  if (beat.rooms)
    line.objects("rooms", *beat.rooms, [](json::ObjectText& object, const protocol::RoomEntry& room) {
      object.text("name", room.name)
          .text("map", room.map)
          .integer("players", room.players)
          .integer("bots", room.bots)
          .integer("spectators", room.spectators);
    });
  line.end();
  return text;
}

core::Expected<Beat> beat_from(std::string_view text) {
  if (text.size() > kMostBeatBytes) return core::fail("a beat", "is longer than one may be");
  const auto document = json::parse_file(text, "a beat", kBeatLimits, 1);
  if (!document) return tl::unexpected(document.error());
  json::Problems problems("a beat");
  if (!document->root().is(json::Kind::kObject)) return core::fail("a beat", "is no object");
  const json::Fields fields(document->root(), problems);
  Beat beat;
  beat.host = fields.text("host", kMostHostBytes);
  beat.address = fields.text("address", protocol::kMaxAddressBytes);
  if (!protocol::parse_host_address(beat.address)) beat.address.clear();  // nobody is sent there
  beat.shard = fields.text("shard", kMostHostBytes);
  beat.owns = flag_of(fields, "owns", problems);
  beat.leaves = flag_of(fields, "leaves", problems);
  beat.ready = flag_of(fields, "ready", problems);
  beat.process = fields.hash("process");
  beat.writer.host = fields.text("writer", kMostHostBytes);
  beat.writer.epoch = fields.integer("epoch", 0, kMostCount);
  beat.writer.nonce = {fields.hash("nonce"), fields.hash("nonce2")};
  beat.sequence = fields.integer("sequence", 0, kMostCount);
  beat.silent_ms = fields.integer("silent_ms", 0, kMostCount);
  beat.to = fields.text("to", kMostHostBytes);
  if (fields.find("strict")) beat.strict = flag_of(fields, "strict", problems);
  const auto rooms = fields.find("rooms");
  if (rooms) beat.rooms.emplace();
  if (rooms && (!rooms->is(json::Kind::kArray) || rooms->size() > kMostRoomsOfShard))
    problems.add(*rooms, "is to be a list of no more rooms than a shard has");
  else if (rooms)
    rooms->for_each([&](const json::Value& value) {
      beat.rooms->push_back(read_room(value, problems));
      return true;
    });
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return beat;
}

std::string to_text(const MoveOrder& order) {
  std::string text;
  json::ObjectText line(text);
  line.text("from", order.from).text("to", order.to);
  line.end();
  return text;
}

core::Expected<MoveOrder> move_order_from(std::string_view text) {
  if (text.size() > kMostBeatBytes) return core::fail("an order", "is longer than one may be");
  const auto document = json::parse_file(text, "an order", kBeatLimits, 1);
  if (!document) return tl::unexpected(document.error());
  json::Problems problems("an order");
  if (!document->root().is(json::Kind::kObject)) return core::fail("an order", "is no object");
  const json::Fields fields(document->root(), {"from", "to"}, problems);
  MoveOrder order{fields.text("from", kMostHostBytes), fields.text("to", kMostHostBytes)};
  if (problems.count() != 0) return tl::unexpected(problems.errors().front());
  return order;
}

bool HostTable::take(Beat beat, Time now) {
  const std::lock_guard lock(mutex_);
  hear(now);
  if (beat.host == own_ && beat.process != process_) twin_at_ = now;
  if (beat.host == own_) return false;
  auto& hosts = beat.shard == shard_ ? hosts_ : strangers_;
  if (hosts.size() >= kMostHosts && !hosts.contains(beat.host)) return false;
  const auto former = hosts.find(beat.host);
  // Of two of one name the owner is believed, till it is silent.
  constexpr Duration kBelieved = std::chrono::seconds(1);
  if (former != hosts.end() && former->second.beat.process != beat.process && former->second.beat.owns &&
      !beat.owns && now - former->second.at < kBelieved)
    return false;
  const bool is_told = beat.rooms || !beat.owns;
  if (!is_told && former != hosts.end() && former->second.beat.process == beat.process)
    beat.rooms = std::move(former->second.beat.rooms);
  const bool is_new = former == hosts.end() || former->second.beat.process != beat.process;
  const std::string host = beat.host;
  hosts.insert_or_assign(host, Known{std::move(beat), now});
  return is_new;
}

bool HostTable::take_edge(Beat beat, Time now) {
  const std::lock_guard lock(mutex_);
  hear(now);
  const std::uint64_t process = beat.process;
  if (process == process_) return false;
  if (edges_.size() >= kMostEdges && !edges_.contains(process)) return false;
  beat.owns = false;  // whatever it says
  beat.rooms.reset();
  return edges_.insert_or_assign(process, Known{std::move(beat), now}).second;
}

void HostTable::hear(Time now) {
  if (now - heard_at_ > kDeafAfter) hears_since_ = now;
  heard_at_ = now;
  std::erase_if(strangers_, [now](const auto& entry) { return now - entry.second.at > kForgottenAfter; });
  const auto is_old = [this, now](const auto& entry) { return is_forgotten(entry.second, now); };
  std::erase_if(hosts_, is_old);
  std::erase_if(edges_, is_old);
}

bool HostTable::is_forgotten(const Known& known, Time now) const {
  const bool is_deaf = now - heard_at_ > kDeafAfter || now - hears_since_ <= kForgottenAfter;
  return !is_deaf && now - known.at > kForgottenAfter;
}

Time HostTable::heard(const Writer& writer) const {
  const std::lock_guard lock(mutex_);
  const auto known = hosts_.find(writer.host);
  if (known == hosts_.end() || !known->second.beat.owns || known->second.beat.writer != writer) return Time{};
  return known->second.at;
}

std::optional<bool> HostTable::is_strict(const Writer& writer) const {
  const std::lock_guard lock(mutex_);
  const auto known = hosts_.find(writer.host);
  if (known == hosts_.end() || !known->second.beat.owns || known->second.beat.writer != writer)
    return std::nullopt;
  return known->second.beat.strict;
}

std::optional<std::string> HostTable::leaves(const Writer& writer) const {
  const std::lock_guard lock(mutex_);
  const auto known = hosts_.find(writer.host);
  if (known == hosts_.end() || known->second.beat.writer != writer || !known->second.beat.leaves)
    return std::nullopt;
  return known->second.beat.to;
}

std::optional<std::size_t> HostTable::place_in_line(Duration silence, Time now) const {
  const std::lock_guard lock(mutex_);
  std::size_t before = 0;
  for (const auto& [host, known] : hosts_) {
    const Beat& beat = known.beat;
    if (beat.owns || beat.leaves || !beat.ready || now - known.at > silence) continue;
    if (std::chrono::milliseconds(beat.silent_ms) + (now - known.at) < silence / 2) return std::nullopt;
    before += host < own_ ? 1 : 0;
  }
  return before;
}

bool HostTable::has_twin(Time now) const {
  const std::lock_guard lock(mutex_);
  return twin_at_ != Time{} && now - twin_at_ < kForgottenAfter;
}

std::uint64_t HostTable::highest_epoch() const {
  const std::lock_guard lock(mutex_);
  std::uint64_t highest = 0;
  for (const auto& [host, known] : hosts_) highest = std::max(highest, known.beat.writer.epoch);
  return highest;
}

std::optional<Beat> HostTable::owner(Time now, Duration within) const {
  const std::lock_guard lock(mutex_);
  std::optional<Beat> found;
  for (const auto& [host, known] : hosts_) {
    if (!known.beat.owns || known.beat.leaves || now - known.at > within) continue;
    if (!found || known.beat.writer.epoch > found->writer.epoch) found = known.beat;
  }
  return found;
}

std::optional<Beat> HostTable::successor(Time now, std::string_view wanted) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [host, known] : hosts_)
    if ((wanted.empty() || host == wanted) && !known.beat.owns && !known.beat.leaves && known.beat.ready &&
        now - known.at < std::chrono::milliseconds(500))
      return known.beat;
  return std::nullopt;
}

std::vector<std::string> HostTable::addresses(Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> found;
  for (const auto& [host, known] : hosts_)
    if (!is_forgotten(known, now) && !known.beat.address.empty()) found.push_back(known.beat.address);
  return found;
}

std::vector<std::string> HostTable::edge_addresses(Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> found;
  for (const auto& [process, known] : edges_)
    if (!is_forgotten(known, now) && known.beat.shard == shard_ && known.beat.ready && !known.beat.leaves &&
        !known.beat.address.empty())
      found.push_back(known.beat.address);
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  // By chance: what goes round would keep step with others who only ask.
  if (!found.empty()) {
    const std::uint64_t chance = core::Random(++turn_).next();
    std::rotate(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(chance % found.size()),
                found.end());
  }
  return found;
}

std::vector<Beat> HostTable::edges(Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<Beat> found;
  for (const auto& [process, known] : edges_)
    if (now - known.at <= kForgottenAfter && known.beat.shard == shard_) found.push_back(known.beat);
  return found;
}

std::vector<Beat> HostTable::hosts(Time now) const {
  const std::lock_guard lock(mutex_);
  std::vector<Beat> found;
  for (const auto& [host, known] : hosts_)
    if (now - known.at <= kForgottenAfter) found.push_back(known.beat);
  return found;
}

std::vector<HostedRoom> HostTable::rooms(Time now) const {
  const std::lock_guard lock(mutex_);
  std::map<std::string_view, const Beat*> owners;  // by shard
  for (const auto* hosts : {&hosts_, &strangers_})
    for (const auto& [host, known] : *hosts) {
      if (!known.beat.owns || now - known.at > kForgottenAfter) continue;
      const Beat*& owner = owners[known.beat.shard];
      if (owner == nullptr || known.beat.writer.epoch > owner->writer.epoch) owner = &known.beat;
    }
  std::vector<HostedRoom> rooms;
  for (const auto& [shard, owner] : owners)
    for (std::size_t k = 0; owner->rooms && k < owner->rooms->size(); ++k) {
      rooms.push_back({owner->shard, (*owner->rooms)[k]});
      rooms.back().room.address = owner->address;
    }
  return rooms;
}

}  // namespace woodlouse::server
