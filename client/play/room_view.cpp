#include "client/play/room_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <variant>

#include "client/play/bell.h"
#include "client/play/modes/goal.h"
#include "client/play/modes/ruling_words.h"
#include "client/play/spoken_words.h"
#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/map/map_text.h"
#include "shared/protocol/codes.h"

namespace woodlouse::client {
namespace {

constexpr double kTrailSpacings = 200.0;  // a trail's points are this part of the map's width apart

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

std::int64_t microseconds(core::Time time) {
  return std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count();
}

}  // namespace

core::Expected<void> RoomView::on_message(const protocol::ServerMessage& message, core::Time now) {
  word_.heard(now);
  return std::visit(
      Overloaded{
          [&](const protocol::Welcome& m) -> core::Expected<void> {
            return take(m, now), core::Expected<void>();
          },
          [&](const protocol::MapMessage& m) -> core::Expected<void> { return take(m); },
          [&](const protocol::Frame& m) -> core::Expected<void> {
            return take(m, now), core::Expected<void>();
          },
          [&](const protocol::Event& m) -> core::Expected<void> {
            return take(m, now), core::Expected<void>();
          },
          [&](const protocol::Pong& m) -> core::Expected<void> {
            return take(m, now), core::Expected<void>();
          },
          [&](const protocol::Ack& m) -> core::Expected<void> {
            if (pilot_) pilot_->acknowledge(m);
            return {};
          },
          [&](const protocol::Ping& m) -> core::Expected<void> {
            outgoing_.emplace_back(protocol::Pong{m.t});
            return {};
          },
          [&](const protocol::Notice& m) -> core::Expected<void> {
            if (m.code == protocol::code::kPaused) word_.paused();
            return roster_.note(m.text), core::Expected<void>();
          },
          [&](const protocol::ErrorMessage& m) -> core::Expected<void> {
            if (m.code != protocol::code::kNoRecords) notice(m.text, now);  // nobody else has asked for them
            return {};
          },
          [&](const protocol::Hello& m) -> core::Expected<void> {
            return own_game_.take(m), core::Expected<void>();
          },
          [&](const protocol::GhostLine& m) -> core::Expected<void> {
            return own_game_.take(m), core::Expected<void>();
          },
          [&](const protocol::Rooms& m) -> core::Expected<void> { return take(m), core::Expected<void>(); },
          [](const auto&) -> core::Expected<void> { return {}; },  // bye: the connection's
      },
      message);
}

void RoomView::take(const protocol::Welcome& welcome, core::Time now) {
  if (was_here_) {
    const auto& difference = follower().difference();
    notice(difference ? "watching by frames now: " + to_text(*difference) : words::what_became(welcome), now);
  }
  if (welcome_) {  // another game of the room, on the same connection
    notice(core::joined({"now: ", welcome.mode, " on ", welcome.map_name}), now);
    if (pilot_) last_seq_ = pilot_->last_seq();
    lice_.clear();
    trails_.clear();
  }
  was_here_ = false;
  welcome_ = welcome;
  const state::Mode before =
      std::exchange(mode_, state::mode_from_text(welcome.mode).value_or(state::Mode::kRoam));
  const bool goes_on = before == mode_ && map_ && map_->hash == welcome.map_hash;
  const protocol::Game* const game = goes_on && view_ ? view_->game() : nullptr;
  tick_hz_ = welcome.tick_hz;
  own_game_.take(welcome);
  roster_.welcome(welcome);
  clock_.emplace(welcome.tick_hz);
  word_.expect(welcome.state_hz);
  view_ = ViewState(welcome.tick_hz, welcome.fields, game != nullptr ? std::optional(*game) : std::nullopt);
  pilot_.reset();
  rate_.begin(welcome.tick_hz, welcome.state_hz);
  if (welcome.stream == protocol::Stream::kInputs) return stream_.begin(welcome.tick_hz, welcome.state_hz);
  if (map_ && map_->hash == welcome.map_hash) {
    begin_piloting();
  } else {
    map_.reset();
    trails_.clear();
    outgoing_.emplace_back(protocol::GetMap{});
  }
}

core::Expected<void> RoomView::take(const protocol::MapMessage& message) {
  auto parsed = message.is_overview && message.knots
                    ? map::parse_overview(message.definition, "the server's map", *message.knots)
                    : map::parse_map(message.definition, "the server's map", {});
  if (!parsed) return tl::unexpected(parsed.error());
  if (welcome_ && (*parsed)->hash != welcome_->map_hash) {
    return core::fail("the server's map",
                      "its hash is " + core::to_hex((*parsed)->hash) + ", the server says " +
                          core::to_hex(welcome_->map_hash),
                      "use a client of the server's version");
  }
  map_ = std::move(*parsed);
  begin_piloting();
  return {};
}

void RoomView::begin_piloting() {
  if (welcome_->id == 0) return;
  const state::Mode mode = map_->definition.modes.has(mode_) ? mode_ : state::Mode::kRoam;
  pilot_.emplace(*map_, welcome_->tick_hz, welcome_->id, mode, last_seq_);
  const map::Modes& modes = map_->definition.modes;
  if (mode == state::Mode::kRace && modes.race && !modes.race->gates.empty())
    pilot_->look_at(0.5 * (modes.race->gates.front().a + modes.race->gates.front().b));
  if (mode == state::Mode::kHill && modes.hill && !modes.hill->places.empty())
    pilot_->look_at(modes.hill->places.front().at);
  own_game_.begin(map_, welcome_->tick_hz, mode);
}

void RoomView::take(const protocol::Frame& frame, core::Time now) {
  if (!welcome_) return;
  verifier_.take(frame);
  goes_on(frame.tick, now);
  clock_->observe(frame.tick, now);
  rate_.observe(frame.tick, now);
  switch (view_->merge(frame)) {
    case ViewState::Merge::kMissingBase:
      if (resync_asked_ && now - *resync_asked_ < kResyncEvery) return;
      resync_asked_ = now;
      outgoing_.emplace_back(protocol::Resync{});
      return;
    case ViewState::Merge::kUnreadable:
      notice("the server's rows have other columns than asked for", now);
      return;
    case ViewState::Merge::kStale:
      return;
    case ViewState::Merge::kTaken:
      break;
  }
  if (!pilot_) return;
  const auto row = view_->newest()->lice.find(pilot_->id());
  if (row != view_->newest()->lice.end()) pilot_->compare(frame.tick, row->second);
}

bool RoomView::follow(std::string_view line, core::Time now) {
  if (!welcome_) return true;
  word_.heard(now);
  if (!stream_.take(line)) {
    notice(to_text(*follower().difference()), now);
    return false;
  }
  const match::Match* const match = stream_.match();
  if (match == nullptr) return true;
  if (map_ != match->shared_map()) {
    map_ = match->shared_map();
    trails_.clear();
  }
  if (stream_.is_on_time()) {
    goes_on(match->tick(), now);
    clock_->observe(match->tick(), now);
    rate_.observe(match->tick(), now);
  }
  if (auto picture = stream_.picture()) view_->show(std::move(*picture));
  return true;
}

/// After a pause everything is timed anew: what was counted on meanwhile never happened.
void RoomView::goes_on(std::uint64_t tick, core::Time now) {
  if (!word_.shown(tick, now)) return;
  clock_.emplace(welcome_->tick_hz);
  rate_.begin_anew();
  if (pilot_) pilot_->begin_anew();
}

void RoomView::take(const protocol::Event& event, core::Time now) {
  if (welcome_ && rings(event, welcome_->id)) ++bells_;
  roster_.event(event);
  if (protocol::is_of_rules(event.kind) && welcome_) {
    const std::string told = describe_ruling(event, welcome_->id, welcome_->tick_hz, sight());
    if (!told.empty()) roster_.note(told);
  }
  if (event.kind == protocol::EventKind::kLeft) trails_.erase(event.id);
  if (welcome_) own_game_.take(event, *welcome_, pilot(), now);
}

void RoomView::take(const protocol::Pong& pong, core::Time now) {
  const double seconds = static_cast<double>(microseconds(now) - pong.t) * 1e-6;
  if (!(seconds >= 0.0 && seconds < 60.0)) return;  // not an answer to a ping of this run
  word_.answered(now -
                 std::chrono::duration_cast<core::Time::duration>(std::chrono::duration<double>(seconds)));
  round_trips_.push_back(seconds);
  if (round_trips_.size() > kRoundTrips) round_trips_.pop_front();
}

void RoomView::take(const protocol::Rooms& rooms) {
  if (!welcome_) return;
  for (const protocol::RoomEntry& room : rooms.rooms)
    if (room.name == welcome_->room) roster_.count_spectators(room.spectators);
}

void RoomView::look(const protocol::View& view) {
  if (!welcome_ || !welcome_->view_rows || view == looked_) return;
  if (welcome_->format == protocol::Format::kExact) return;  // hashes are of everybody
  looked_ = view;
  outgoing_.emplace_back(protocol::Look{view});
}

std::optional<double> RoomView::rtt_seconds() const {
  if (round_trips_.empty()) return std::nullopt;
  return *std::min_element(round_trips_.begin(), round_trips_.end());
}

void RoomView::notice(std::string text, core::Time now) {
  notice_ = std::move(text);
  notice_until_ = now + kNoticeFor;
}

void RoomView::on_lost() {
  was_here_ |= welcome_.has_value();
  if (welcome_) saw_part_ = sees_part();
  welcome_.reset();
  word_ = {};
  clock_.reset();
  if (const auto own = pilot_ ? lice_.find(pilot_->id()) : lice_.end(); own != lice_.end())
    own->second.sample.heading = pilot_->steering().heading();
  pilot_.reset();
  last_seq_ = 0;
  round_trips_.clear();
  pinged_.reset();
  counted_.reset();
  resync_asked_.reset();
  outgoing_.clear();
  looked_ = {};
}

Sight RoomView::sight() const {
  Sight sight{map_.get(), lice_, trails_, pilot()};
  sight.is_part = welcome_ ? sees_part() : saw_part_;
  sight.name_of = [this](std::uint32_t id) {
    const Resident* resident = roster_.find(id);
    return resident != nullptr ? resident->name : core::joined({"#", std::to_string(id)});
  };
  sight.is_bot = [this](std::uint32_t id) {
    const Resident* resident = roster_.find(id);
    return resident != nullptr && resident->role == protocol::Role::kBot;
  };
  const protocol::Game* const game = view_ ? view_->game() : nullptr;
  if (game == nullptr) return sight;
  sight.ruling = {mode_, game, shown_tick_, tick_hz_, own_game_.author_ms()};
  if (sight.ruling.mode == state::Mode::kRoam) sight.ruling.game = nullptr;  // rules that are not known here
  return sight;
}

void RoomView::update(core::Time now) {
  if (!notice_.empty() && now >= notice_until_) notice_.clear();
  if (!welcome_) return;
  const bool asks = word_.is_late(now) && !word_.stands();
  if (!pinged_ || now - *pinged_ >= (asks ? ServerWord::kLate : kPingEvery)) {
    pinged_ = now;
    outgoing_.emplace_back(protocol::Ping{microseconds(now)});
  }
  if (!counted_) counted_ = now;  // the welcome did
  if (now - *counted_ >= kCountEvery) {
    counted_ = now;
    outgoing_.emplace_back(protocol::List{});
  }
  const bool is_known = word_.goes_on(now);
  if (pilot_ && is_known) {
    if (const auto input = pilot_->update(now, *clock_, rtt_seconds().value_or(0.0)))
      outgoing_.emplace_back(*input);
  }
  draw_lice(now);
  if (clock_->running() && is_known) shown_tick_ = clock_->tick(now);
  const auto own = pilot_ ? lice_.find(pilot_->id()) : lice_.end();
  own != lice_.end() ? own_game_.update(*pilot_, own->second.sample, shown_tick_, now) : own_game_.idle();
}

void RoomView::draw_lice(core::Time now) {
  if (!clock_->running()) return;  // what was seen last stays until there is something newer
  lice_.clear();
  const double frame_gap = 2.0 / std::max(1u, welcome_->state_hz);
  const double delay = std::max(std::chrono::duration<double>(kDelay).count(), frame_gap);
  const Ways ways = map_ ? Ways(map_->terrain->domain(), map_->definition.physics.edges) : Ways();
  for (const auto& [id, sample] : view_->at(clock_->tick(now) - delay * clock_->tick_hz(), ways)) {
    lice_[id].sample = sample;
  }
  if (pilot_) {
    const auto& newest = view_->newest()->lice;
    const auto own = newest.find(pilot_->id());
    if (own == newest.end() && mode_ == state::Mode::kHill) {
      lice_.erase(pilot_->id());  // it is out, and the World of the prediction knows nothing of that
    } else if (auto predicted = pilot_->sample()) {  // what the rules say of it only the server knows
      if (own != newest.end()) predicted->standing = own->second.standing;
      lice_[pilot_->id()].sample = *predicted;
    }
  }
  const double width = welcome_->extent[2] - welcome_->extent[0];
  for (auto& [id, louse] : lice_) {
    const Resident* resident = roster_.find(id);
    louse.name = resident != nullptr ? resident->name : core::joined({"#", std::to_string(id)});
    louse.is_bot = resident != nullptr && resident->role == protocol::Role::kBot;
    louse.is_you = id == welcome_->id;
    trails_.try_emplace(id, std::max(width, 1.0) / kTrailSpacings)
        .first->second.add(louse.sample.position, louse.sample.flight_z);
  }
  std::erase_if(trails_, [this](const auto& entry) { return !lice_.contains(entry.first); });
}

void RoomView::set_gate(core::Time now) {
  const auto own = pilot_ ? lice_.find(pilot_->id()) : lice_.end();
  if (own != lice_.end())
    notice(own_game_.set_gate(own->second.sample, pilot_->steering().heading(), now), now);
}

std::vector<protocol::ClientMessage> RoomView::take_outgoing() {
  for (protocol::ClientMessage& message : own_game_.take_outgoing()) outgoing_.push_back(std::move(message));
  return std::exchange(outgoing_, {});
}

}  // namespace woodlouse::client
