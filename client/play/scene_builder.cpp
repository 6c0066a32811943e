#include "client/play/scene_builder.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "client/drawing/compose.h"
#include "client/drawing/layout.h"
#include "client/play/modes/course_builder.h"
#include "client/play/modes/goal.h"

namespace woodlouse::client {
namespace {

constexpr std::size_t kShortTrail = 30;  // points
constexpr double kStill = 0.05;          // [m/s] below it a louse's body points along its heading
constexpr double kGoes = 0.3;            // [m/s] below it what lies ahead is what the heading points at

core::Vec2 direction_of_travel(const LouseSample& louse) {
  const double speed = std::hypot(louse.velocity.x, louse.velocity.y);
  return speed > kStill ? (1.0 / speed) * louse.velocity : louse.heading;
}

void lay_trail(const Sight& sight, std::uint32_t id, TrailLength length, LouseMark& mark) {
  const auto trail = sight.trails.find(id);
  if (trail == sight.trails.end() || length == TrailLength::kOff) return;
  const auto& points = trail->second.points();
  const auto& flights = trail->second.flights();
  const auto skip = static_cast<std::ptrdiff_t>(
      length == TrailLength::kShort && points.size() > kShortTrail ? points.size() - kShortTrail : 0);
  mark.trail.assign(points.begin() + skip, points.end());
  mark.trail_flights.assign(flights.begin() + skip, flights.end());
}

LouseMark mark(const Sight& sight, std::uint32_t id, const Present& louse, TrailLength trails) {
  const terrain::SurfaceSample ground = ground_under(sight, louse.sample.position);
  LouseMark result;
  result.id = id;
  result.name = louse.name;
  result.kind = louse.is_bot ? LouseKind::kBot : LouseKind::kPlayer;
  result.is_you = louse.is_you;
  result.position = louse.sample.position;
  const core::Vec2 travel = direction_of_travel(louse.sample);
  if (louse.is_you)  // without a pilot the line is cut: as it pointed then
    result.heading = sight.pilot != nullptr ? sight.pilot->steering().heading() : louse.sample.heading;
  else
    result.heading = travel;
  result.ahead =
      std::hypot(louse.sample.velocity.x, louse.sample.velocity.y) > kGoes ? travel : result.heading;
  if (louse.sample.flight_z != 0.0) result.above = std::max(0.0, louse.sample.flight_z - ground.z);
  // In the air no ground turns it.
  const bool flies = result.above > 0.0;
  result.attitude = physics::attitude(travel, flies ? core::Vec2{} : core::Vec2{ground.zx, ground.zy});
  result.speed = speed_in_space(ground, louse.sample.velocity);
  lay_trail(sight, id, trails, result);
  return result;
}

int rank_of(const std::vector<ScoreRow>& scores, std::uint32_t id) {
  const auto row = std::find_if(scores.begin(), scores.end(), [id](const ScoreRow& r) { return r.id == id; });
  return row == scores.end() ? 0 : row->rank;
}

void fill_steering_numbers(const Steering& steering, core::Time now, HudNumbers& hud) {
  hud.thrust = steering.braking(now) ? -1.0 : steering.pushing(now) ? 1.0 : 0.0;
  hud.push_seconds = steering.seconds_left(now);
  hud.cruise = steering.cruising();
}

void fill_connection_numbers(const RoomView& room, HudNumbers& hud) {
  if (const auto rtt = room.rtt_seconds()) hud.rtt_ms = *rtt * 1e3;
  hud.tick_hz = room.measured_tick_hz();
  if (hud.tick_hz == 0.0 && room.welcome() != nullptr) hud.tick_hz = room.welcome()->tick_hz;
}

/// Of a re-run, which proves more than keys do, or of keys.
std::optional<StateProof> proof_of(const RoomView& room) {
  const follow::Follower& follower = room.follower();
  if (follower.proven() > 0 || follower.difference()) {
    StateProof proof;
    proof.verified = follower.proven();
    if (follower.difference()) proof.differs = follower.difference()->tick;
    return proof;
  }
  const KeyVerifier& verifier = room.verifier();
  if (verifier.verified() == 0 && !verifier.difference()) return std::nullopt;
  StateProof proof;
  proof.verified = verifier.verified();
  proof.hash = verifier.hash();
  if (verifier.difference()) proof.differs = verifier.difference()->tick;
  return proof;
}

Mode mode_of(const Interface& interface) {
  if (interface.overlay == Overlay::kQuitQuestion) return Mode::kQuitQuestion;
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

terrain::SurfaceSample ground_under(const Sight& sight, core::Vec2 position) {
  if (sight.map == nullptr) return {};
  const terrain::Rectangle& domain = sight.map->terrain->domain();
  return sight.map->terrain->sample(std::clamp(position.x, domain.x_min, domain.x_max),
                                    std::clamp(position.y, domain.y_min, domain.y_max));
}

double slope_degrees(const terrain::SurfaceSample& ground, core::Vec2 direction) {
  return std::atan(ground.zx * direction.x + ground.zy * direction.y) * (180.0 / std::numbers::pi);
}

double speed_in_space(const terrain::SurfaceSample& ground, core::Vec2 v) {
  return std::hypot(v.x, v.y, ground.zx * v.x + ground.zy * v.y);
}

std::uint32_t followed(const Sight& sight, std::uint32_t chosen) {
  if (chosen != 0 && sight.lice.contains(chosen)) return chosen;
  const auto leader = std::max_element(
      sight.lice.begin(), sight.lice.end(),
      [](const auto& a, const auto& b) { return a.second.sample.distance < b.second.sample.distance; });
  return leader == sight.lice.end() ? 0 : leader->first;
}

const LouseSample* sample_of(const Sight& sight, std::uint32_t id) {
  const auto louse = sight.lice.find(id);
  return louse == sight.lice.end() ? nullptr : &louse->second.sample;
}

std::uint32_t next_louse(const Sight& sight, std::uint32_t id) {
  if (sight.lice.empty()) return 0;
  const auto next = sight.lice.upper_bound(id);
  return next == sight.lice.end() ? sight.lice.begin()->first : next->first;
}

std::uint32_t previous_louse(const Sight& sight, std::uint32_t id) {
  if (sight.lice.empty()) return 0;
  const auto at = sight.lice.lower_bound(id);
  return at == sight.lice.begin() ? sight.lice.rbegin()->first : std::prev(at)->first;
}

void fill_louse_numbers(const Sight& sight, std::uint32_t id, Scene& scene) {
  const auto louse = sight.lice.find(id);
  if (louse == sight.lice.end()) return;
  const LouseSample& sample = louse->second.sample;
  const terrain::SurfaceSample ground = ground_under(sight, sample.position);
  scene.hud.speed = speed_in_space(ground, sample.velocity);
  const auto shown = std::find_if(scene.lice.begin(), scene.lice.end(),
                                  [id](const LouseMark& mark) { return mark.id == id; });
  assert(shown != scene.lice.end());
  scene.hud.slope_degrees = slope_degrees(ground, shown->ahead);
  scene.hud.distance = sample.distance;
  scene.hud.above = shown->above;
  scene.hud.height = sample.flight_z != 0.0 ? sample.flight_z : ground.z;
  scene.hud.rank = rank_of(scene.scores, id);
}

Scene picture(const Sight& sight, const Interface& interface, const FrameFacts& facts) {
  Scene scene;
  scene.look = facts.look;
  scene.view = interface.view;
  scene.zoom = interface.zoom;
  scene.labels = interface.labels;
  scene.key_up_known = facts.key_up_known;
  scene.follow_id = followed(sight, interface.follow_id);
  if (sight.map != nullptr) {
    scene.map_name = sight.map->definition.name;
    scene.terrain = sight.map->terrain;
    const state::Parameters& physics = sight.map->definition.physics;
    const auto& hill = sight.map->definition.modes.hill;
    const bool falls = sight.ruling.mode == state::Mode::kHill && hill && hill->falls;
    scene.landmarks = {falls ? state::Edges::kOpen : physics.edges,
                       physics.central_gravity > 0.0 ? physics.core_radius : 0.0};
  }
  const bool has_crumbs = sight.ruling.mode == state::Mode::kForage && sight.ruling.game != nullptr;
  const bool hides_trails = has_crumbs && !paints_pixels(facts.look);  // dots of characters, as crumbs are
  for (const auto& [id, louse] : sight.lice)
    scene.lice.push_back(mark(sight, id, louse, hides_trails ? TrailLength::kOff : interface.trails));
  scene.scores = score_rows(sight);
  scene.measured = measured_by(sight);
  scene.hud.fps = facts.fps;
  scene.hud.players = static_cast<int>(scene.scores.size());
  scene.hud.bots = static_cast<int>(std::count_if(
      scene.scores.begin(), scene.scores.end(), [](const ScoreRow& r) { return r.kind == LouseKind::kBot; }));
  return scene;
}

Scene build_scene(const Session& session, const Interface& interface, const ChatEntry& entry,
                  const FrameFacts& facts) {
  const RoomView& room = session.room();
  Scene scene = picture(room.sight(), interface, facts);
  scene.mode = mode_of(interface);
  const auto own =
      std::find_if(room.lice().begin(), room.lice().end(), [](const auto& l) { return l.second.is_you; });
  const std::uint32_t own_id = room.welcome() != nullptr  ? room.welcome()->id
                               : own != room.lice().end() ? own->first
                                                          : 0;
  scene.spectating = own_id == 0;
  if (room.welcome() != nullptr) scene.room = room.welcome()->room;
  fill_louse_numbers(room.sight(), scene.spectating ? scene.follow_id : own_id, scene);
  if (room.sight().is_part) {
    scene.hud.players = static_cast<int>(room.roster().lice());
    scene.hud.bots = static_cast<int>(room.roster().bots());
  }
  if (room.pilot() != nullptr) fill_steering_numbers(room.pilot()->steering(), facts.now, scene.hud);
  fill_connection_numbers(room, scene.hud);
  scene.hud.spectators = static_cast<int>(room.roster().spectators());
  for (const Utterance& line : room.roster().chat()) scene.chat.push_back({line.from, line.text});
  scene.chat_entry = entry.text();
  scene.notice = room.notice_line();
  const core::Vec2 up = up_in_picture(scene.view, scene.look);
  scene.course = course_of({room.sight(), scene.spectating ? scene.follow_id : own_id,
                            sample_of(room.sight(), scene.spectating ? scene.follow_id : own_id),
                            !scene.spectating, &room.own_game().run(), scene.hud.rank, up});
  if (const auto* welcome = room.welcome();
      scene.course.lines.empty() && welcome != nullptr &&
      state::mode_from_text(welcome->mode).value_or(state::Mode::kRoam) != state::Mode::kRoam)
    scene.course.lines = {
        {{welcome->mode, Tone::kStrong}}};  // the first frame will say more, in the same place
  scene.course.splash = room.own_game().run().splash(facts.now);
  scene.course.ghosts = room.own_game().ghost_marks();
  if (const auto gate = room.own_game().gate().mark()) {
    scene.course.gates.push_back(*gate);
    scene.course.target = 0.5 * (gate->a + gate->b);
    scene.course.up = up;
    scene.course.lines.push_back(room.own_game().gate().line(facts.now));
    if (const LouseSample* you = sample_of(room.sight(), own_id))
      scene.course.lines.back().push_back(
          {"  " + way_text(*scene.course.target - you->position, up), Tone::kGoal});
  }
  scene.silence = room.silence(facts.now);
  scene.paused = room.stands() && !scene.silence;
  scene.proof = proof_of(room);
  if (room.verifier().difference()) scene.notice = to_text(*room.verifier().difference());
  if (const auto seconds = session.connection().seconds_left(facts.now))
    scene.lost = {session.connection().closing().reason, *seconds};
  return scene;
}

}  // namespace woodlouse::client
