#include "client/watch/player.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/drawing/compose.h"
#include "client/play/modes/course_builder.h"

namespace woodlouse::client {
namespace {

EventSign sign_of(replay::MarkKind kind) {
  switch (kind) {
    case replay::MarkKind::kJoin:
      return EventSign::kJoined;
    case replay::MarkKind::kLeave:
      return EventSign::kLeft;
    case replay::MarkKind::kRespawn:
      return EventSign::kRespawned;
    case replay::MarkKind::kChat:
      return EventSign::kChat;
  }
  return EventSign::kChat;
}

/// The first tick that shows what a mark's step did.
std::uint64_t shown_at(const replay::Mark& mark) { return mark.tick + 1; }

/// The thrust that acts, as the panel of the game shows it.
void fill_thrust_numbers(const state::Louse& louse, double tick_hz, HudNumbers& hud) {
  if (louse.thrust_kind == state::ThrustKind::kNone) return;
  const bool is_along = louse.thrust_kind == state::ThrustKind::kAlongHeading;
  hud.thrust = is_along ? louse.thrust.x : std::hypot(louse.thrust.x, louse.thrust.y);
  hud.cruise = louse.thrust_ticks == state::kHeld && hud.thrust != 0.0;
  if (!hud.cruise) hud.push_seconds = louse.thrust_ticks / tick_hz;
}

}  // namespace

Screening::Screening(RecordingView& recording, std::string name, std::optional<View> view, bool has_oblique)
    : recording_(recording),
      name_(std::move(name)),
      clock_(recording.archive().first_tick(), recording.archive().last_tick(),
             recording.archive().header().tick_hz) {
  interface_.view = view.value_or(View::kMap);
  interface_.has_chosen = view.has_value();
  interface_.has_oblique = has_oblique;
  std::vector<EventMark> marks;
  for (const replay::Mark& mark : recording.archive().marks()) {
    const std::uint64_t tick = std::clamp(shown_at(mark), clock_.first(), clock_.last());
    marks.push_back({recording.archive().seconds_at(tick - clock_.first()), sign_of(mark.kind)});
  }
  marks_ = std::make_shared<const std::vector<EventMark>>(std::move(marks));
}

std::optional<Action> Screening::on_key(const Key& key) {
  const auto meant = on_replay_key(key, interface_.overlay);
  if (!meant) return std::nullopt;
  if (const auto* order = std::get_if<ReplayOrder>(&*meant)) {
    if (order->command == ReplayCommand::kLeave) return Action::kConfirm;
    damage_.clear();
    perform(*order);
    return std::nullopt;
  }
  const Action action = std::get<Action>(*meant);
  return interface_.apply(action) ? std::nullopt : std::optional(action);
}

void Screening::perform(const ReplayOrder& order) {
  switch (order.command) {
    case ReplayCommand::kPlayPause:
      return clock_.toggle();
    case ReplayCommand::kSkipBack:
      return clock_.skip(-kSkipSeconds);
    case ReplayCommand::kSkipForth:
      return clock_.skip(kSkipSeconds);
    case ReplayCommand::kTickBack:
      return clock_.step(-1);
    case ReplayCommand::kTickForth:
      return clock_.step(1);
    case ReplayCommand::kSlower:
      return clock_.slower();
    case ReplayCommand::kFaster:
      return clock_.faster();
    case ReplayCommand::kJump:
      return clock_.jump(order.tenths / 10.0);
    case ReplayCommand::kBeginning:
      return clock_.jump(0.0);
    case ReplayCommand::kEnd:
      return clock_.jump(1.0);
    case ReplayCommand::kFollowNext:
      return follow(next_louse(recording_.sight(), followed(recording_.sight(), interface_.follow_id)));
    case ReplayCommand::kFollowPrevious:
      return follow(previous_louse(recording_.sight(), followed(recording_.sight(), interface_.follow_id)));
    case ReplayCommand::kNextEvent:
      return go_to_next_event();
    case ReplayCommand::kPreviousEvent:
      return go_to_previous_event();
    case ReplayCommand::kLeave:
      return;
  }
}

void Screening::follow(std::uint32_t id) {
  interface_.follow_id = id;
  interface_.view = View::kFollow;
  interface_.has_chosen = true;
}

void Screening::go_to_next_event() {
  const auto marks = recording_.archive().marks();
  const auto next = std::partition_point(marks.begin(), marks.end(), [this](const replay::Mark& mark) {
    return shown_at(mark) <= clock_.tick();
  });
  if (next != marks.end()) clock_.go_to(shown_at(*next));
}

void Screening::go_to_previous_event() {
  // While it plays on, the event that was just gone to is no longer the previous one.
  const std::uint64_t margin = clock_.is_playing() ? recording_.archive().header().tick_hz : 0;
  const auto marks = recording_.archive().marks();
  const auto after = std::partition_point(
      marks.begin(), marks.end(),
      [this, margin](const replay::Mark& mark) { return shown_at(mark) + margin < clock_.tick(); });
  clock_.go_to(after == marks.begin() ? clock_.first() : shown_at(*std::prev(after)));
}

void Screening::update(core::Time now) {
  recording_.measure(interface_.error ? followed(recording_.sight(), interface_.follow_id) : 0);
  clock_.update(now);
  const auto shown = recording_.show(clock_.tick());
  if (shown) return;
  damage_ = shown.error().text();
  clock_.go_to(recording_.tick());
  if (clock_.is_playing()) clock_.toggle();
}

Scene Screening::scene(const FrameFacts& facts) const {
  Scene scene = picture(recording_.sight(), interface_, facts);
  scene.mode = interface_.overlay == Overlay::kHelp         ? Mode::kHelp
               : interface_.overlay == Overlay::kScoreboard ? Mode::kScoreboard
                                                            : Mode::kPlay;
  scene.spectating = true;
  fill_louse_numbers(recording_.sight(), scene.follow_id, scene);
  if (const state::Louse* louse = recording_.louse(scene.follow_id))
    fill_thrust_numbers(*louse, recording_.archive().header().tick_hz, scene.hud);
  scene.hud.asks_error = interface_.error;
  scene.hud.error = recording_.error();
  scene.course =
      course_of({recording_.sight(), scene.follow_id, sample_of(recording_.sight(), scene.follow_id), false,
                 nullptr, scene.hud.rank, up_in_picture(scene.view, scene.look)});
  scene.chat = recording_.chat();
  scene.replay = bar();
  const RecordingProof& proof = recording_.proof();
  scene.proof = StateProof{proof.proven(), proof.total(), proof.hash(), std::nullopt,
                           recording_.archive().is_cut_off()};
  scene.notice = damage_;
  if (proof.difference()) {
    scene.proof->differs = proof.difference()->tick;
    scene.notice = to_text(*proof.difference());
  }
  return scene;
}

ReplayBar Screening::bar() const {
  return {name_, clock_.is_playing(), clock_.seconds(), clock_.total_seconds(), clock_.speed(), marks_};
}

}  // namespace woodlouse::client
