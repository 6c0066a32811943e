#include "client/scene_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace woodlouse::client {
namespace {

constexpr std::size_t kShortTrail = 30;  // points
constexpr double kStill = 0.05;          // [m/s] below it a louse's body points along its heading

terrain::SurfaceSample ground_under(const RoomView& room, core::Vec2 position) {
  if (room.map() == nullptr) return {};
  const terrain::Rectangle& domain = room.map()->terrain->domain();
  return room.map()->terrain->sample(std::clamp(position.x, domain.x_min, domain.x_max),
                                     std::clamp(position.y, domain.y_min, domain.y_max));
}

core::Vec2 direction_of_travel(const LouseSample& louse) {
  const double speed = std::hypot(louse.velocity.x, louse.velocity.y);
  return speed > kStill ? (1.0 / speed) * louse.velocity : louse.heading;
}

std::vector<core::Vec2> trail_of(const RoomView& room, std::uint32_t id, TrailLength length) {
  const Trail* trail = room.trail(id);
  if (trail == nullptr || length == TrailLength::kOff) return {};
  const auto& points = trail->points();
  const std::size_t skip =
      length == TrailLength::kShort && points.size() > kShortTrail ? points.size() - kShortTrail : 0;
  return {points.begin() + static_cast<std::ptrdiff_t>(skip), points.end()};
}

LouseMark mark(const RoomView& room, std::uint32_t id, const Present& louse, TrailLength trails) {
  const terrain::SurfaceSample ground = ground_under(room, louse.sample.position);
  LouseMark result;
  result.id = id;
  result.name = louse.name;
  result.kind = louse.is_bot ? LouseKind::kBot : LouseKind::kPlayer;
  result.is_you = louse.is_you;
  result.position = louse.sample.position;
  const core::Vec2 travel = direction_of_travel(louse.sample);
  result.heading = louse.is_you && room.pilot() != nullptr ? room.pilot()->steering().heading() : travel;
  result.attitude = physics::attitude(travel, {ground.zx, ground.zy});
  result.speed = speed_in_space(ground, louse.sample.velocity);
  result.trail = trail_of(room, id, trails);
  return result;
}

int rank_of(const std::vector<ScoreRow>& scores, std::uint32_t id) {
  const auto row = std::find_if(scores.begin(), scores.end(), [id](const ScoreRow& r) { return r.id == id; });
  return row == scores.end() ? 0 : static_cast<int>(row - scores.begin()) + 1;
}

void fill_louse_numbers(const RoomView& room, std::uint32_t id, TimePoint now, HudNumbers& hud) {
  const auto louse = room.lice().find(id);
  if (louse == room.lice().end()) return;
  const LouseSample& sample = louse->second.sample;
  const terrain::SurfaceSample ground = ground_under(room, sample.position);
  hud.speed = speed_in_space(ground, sample.velocity);
  hud.slope_degrees = slope_degrees(ground, direction_of_travel(sample));
  hud.distance = sample.distance;
  hud.height = ground.z;
  if (room.pilot() == nullptr) return;
  const Steering& steering = room.pilot()->steering();
  hud.thrust = steering.braking(now) ? -1.0 : steering.pushing(now) ? 1.0 : 0.0;
  hud.push_seconds = steering.seconds_left(now);
  hud.cruise = steering.cruising();
}

HudNumbers numbers(const RoomView& room, const std::vector<ScoreRow>& scores, std::uint32_t shown,
                   const FrameFacts& facts) {
  HudNumbers hud;
  fill_louse_numbers(room, shown, facts.now, hud);
  if (const auto rtt = room.rtt_seconds()) hud.rtt_ms = *rtt * 1e3;
  hud.tick_hz = room.measured_tick_hz();
  if (hud.tick_hz == 0.0 && room.welcome() != nullptr) hud.tick_hz = room.welcome()->tick_hz;
  hud.fps = facts.fps;
  hud.players = static_cast<int>(scores.size());
  hud.bots = static_cast<int>(std::count_if(scores.begin(), scores.end(),
                                            [](const ScoreRow& r) { return r.kind == LouseKind::kBot; }));
  hud.rank = rank_of(scores, shown);
  return hud;
}

Mode mode_of(const Session& session, const Interface& interface) {
  if (interface.overlay == Overlay::kQuitQuestion) return Mode::kQuitQuestion;
  if (session.connection().phase() != Connection::Phase::kJoined) return Mode::kConnectionLost;
  if (interface.chatting) return Mode::kChatEntry;
  switch (interface.overlay) {
    case Overlay::kHelp:
      return Mode::kHelp;
    case Overlay::kScoreboard:
      return Mode::kScoreboard;
    default:
      return Mode::kPlay;
  }
}

}  // namespace

double slope_degrees(const terrain::SurfaceSample& ground, core::Vec2 direction) {
  return std::atan(ground.zx * direction.x + ground.zy * direction.y) * (180.0 / std::numbers::pi);
}

double speed_in_space(const terrain::SurfaceSample& ground, core::Vec2 v) {
  return std::hypot(v.x, v.y, ground.zx * v.x + ground.zy * v.y);
}

std::vector<ScoreRow> score_rows(const RoomView& room) {
  std::vector<ScoreRow> rows;
  for (const auto& [id, louse] : room.lice()) {
    const double speed = speed_in_space(ground_under(room, louse.sample.position), louse.sample.velocity);
    rows.push_back({id, louse.name, louse.is_bot ? LouseKind::kBot : LouseKind::kPlayer, louse.is_you,
                    louse.sample.distance, speed});
  }
  std::stable_sort(rows.begin(), rows.end(),
                   [](const ScoreRow& a, const ScoreRow& b) { return a.distance > b.distance; });
  return rows;
}

std::uint32_t followed(const RoomView& room, std::uint32_t chosen) {
  if (chosen != 0 && room.lice().contains(chosen)) return chosen;
  const auto leader = std::max_element(
      room.lice().begin(), room.lice().end(),
      [](const auto& a, const auto& b) { return a.second.sample.distance < b.second.sample.distance; });
  return leader == room.lice().end() ? 0 : leader->first;
}

std::uint32_t next_louse(const RoomView& room, std::uint32_t id) {
  if (room.lice().empty()) return 0;
  const auto next = room.lice().upper_bound(id);
  return next == room.lice().end() ? room.lice().begin()->first : next->first;
}

Scene build_scene(const Session& session, const Interface& interface, const ChatEntry& entry,
                  const FrameFacts& facts) {
  const RoomView& room = session.room();
  Scene scene;
  scene.look = facts.look;
  scene.view = interface.view;
  scene.zoom = interface.zoom;
  scene.mode = mode_of(session, interface);
  scene.labels = interface.labels;
  scene.key_up_known = facts.key_up_known;
  const auto own =
      std::find_if(room.lice().begin(), room.lice().end(), [](const auto& l) { return l.second.is_you; });
  const std::uint32_t own_id = room.welcome() != nullptr  ? room.welcome()->id
                               : own != room.lice().end() ? own->first
                                                          : 0;
  scene.spectating = own_id == 0;
  scene.follow_id = followed(room, interface.follow_id);
  if (room.welcome() != nullptr) scene.room = room.welcome()->room;
  if (room.map() != nullptr) {
    scene.map_name = room.map()->definition.name;
    scene.terrain = room.map()->terrain;
  }
  for (const auto& [id, louse] : room.lice()) scene.lice.push_back(mark(room, id, louse, interface.trails));
  scene.scores = score_rows(room);
  const std::uint32_t shown = scene.spectating ? scene.follow_id : own_id;
  scene.hud = numbers(room, scene.scores, shown, facts);
  for (const Utterance& line : room.roster().chat()) scene.chat.push_back({line.from, line.text});
  scene.chat_entry = entry.text();
  scene.notice = room.notice_line();
  if (scene.mode == Mode::kConnectionLost) {
    scene.lost = {session.connection().reason(), session.connection().retry_seconds(facts.now),
                  session.connection().attempts()};
  }
  return scene;
}

}  // namespace woodlouse::client
