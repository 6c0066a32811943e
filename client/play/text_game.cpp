#include "client/play/text_game.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "client/play/own_error.h"
#include "client/terminal/terminal_guard.h"

namespace woodlouse::client {
namespace {

using std::chrono::steady_clock;

state::Mode mode_of_play(const RoomView& room) {
  const protocol::Welcome* const welcome = room.welcome();
  if (welcome == nullptr) return state::Mode::kRoam;
  return state::mode_from_text(welcome->mode).value_or(state::Mode::kRoam);
}

}  // namespace

TextGame::TextGame(boost::asio::io_context& context, Session& session, int keys, Write write,
                   const Manner& manner, std::function<bool()> server_alive)
    : context_(context),
      session_(session),
      write_(std::move(write)),
      server_alive_(std::move(server_alive)),
      timer_(context),
      bindings_(manner.keys),
      steer_(manner.steer),
      teacher_(manner.data) {
  if (keys < 0) return;
  keys_.emplace(
      context, KeySource{keys, {}, {}},
      [this](const TerminalInput& input) {
        if (const Key* key = std::get_if<Key>(&input)) on_key(*key);
        if (const Paste* paste = std::get_if<Paste>(&input); paste != nullptr && chatting_)
          chat_.paste(paste->text);
      },
      [this] {
        finish({kExitIo, "woodlouse: the terminal is gone\n"});
      });
}

Outcome TextGame::run() {
  if (!keys_) TerminalGuard::speak_without_terminal();
  if (keys_) {
    keys_->start();
    tell_keys();
  }
  state_told_ = steady_clock::now();
  update();
  context_.restart();
  while (!outcome_) context_.run_one();
  if (keys_) keys_->stop();
  timer_.cancel();
  context_.poll();  // what was already on its way here, while there still is a here
  return *outcome_;
}

void TextGame::finish(Outcome outcome) {
  if (!outcome_) outcome_ = std::move(outcome);
}

void TextGame::say(const std::string& line) {
  if (!outcome_ && !write_(line)) finish({kExitIo, "woodlouse: nobody reads the output any more\n"});
}

void TextGame::update() {
  if (outcome_) return;
  const core::Time now = steady_clock::now();
  session_.update(now);
  tell_connection();
  tell_silence(now);
  tell_news();
  tell_ground(now);
  tell_proof();
  teach();
  tell_podium();
  tell_error(now);
  if (now - state_told_ >= kStateEvery && !is_silence_told_ &&
      session_.connection().phase() == Connection::Phase::kJoined) {
    state_told_ = now;
    std::vector<std::string> standing = words::goal(session_.room());
    const auto lines = words::room(session_.room());
    const bool only_own =
        session_.room().pilot() != nullptr && keys_;  // the others on Tab: a reader reads slowly
    for (std::size_t i = 0; i < lines.size() && !(only_own && i == 1); ++i) standing.push_back(lines[i]);
    for (const std::string& line : standing)  // what is as it was is not told again
      if (std::find(standing_told_.begin(), standing_told_.end(), line) == standing_told_.end()) say(line);
    standing_told_ = std::move(standing);
    if (const std::uint64_t keys = session_.room().verifier().verified(); keys > 0)
      say("state ok, " + std::to_string(keys) + (keys == 1 ? " key" : " keys") + " verified");
    if (const std::uint64_t ticks = session_.room().follower().proven();
        ticks > 0 && !session_.room().follower().difference())
      say("state ok, " + std::to_string(ticks) + " ticks proven");
  }
  if (outcome_) return;
  timer_.expires_after(kUpdate);
  timer_.async_wait([this](boost::system::error_code error) {
    if (!error) update();
  });
}

void TextGame::tell_connection() {
  const Connection& connection = session_.connection();
  if (session_.failure()) {
    finish({kExitUnreachable, "woodlouse: " + session_.failure()->text() + "\n"});
  } else if (session_.is_trying() && server_alive_ && !server_alive_()) {
    finish({kExitUnreachable, "woodlouse: the server started here has ended\n"});
  } else if (connection.losses() != losses_told_) {
    losses_told_ = connection.losses();
    say("connection lost: " + connection.closing().reason + "; coming back");
  }
}

void TextGame::tell_silence(core::Time now) {
  const bool is_silent = session_.room().silence(now).has_value();
  if (is_silent == std::exchange(is_silence_told_, is_silent)) return;
  if (is_silent) return say("no word from the server: what was told last is no longer known");
  if (!session_.is_trying()) say("the server speaks again");
}

/// Of your own louse, as it is thought to be now.
void TextGame::tell_ground(core::Time now) {
  const RoomView& room = session_.room();
  const auto own = room.pilot() != nullptr ? room.lice().find(room.pilot()->id()) : room.lice().end();
  if (own == room.lice().end() || room.map() == nullptr || is_silence_told_) return;
  const std::string news = ground_.news(*room.map(), mode_of_play(room), own->second.sample.position, now);
  if (!news.empty()) say(news);
}

/// Asked for: everything of the ground.
void TextGame::read_ground() {
  const RoomView& room = session_.room();
  const auto own = room.pilot() != nullptr ? room.lice().find(room.pilot()->id()) : room.lice().end();
  if (own == room.lice().end() || room.map() == nullptr) return say("there is no louse of yours");
  const core::Vec2 place = own->second.sample.position;
  const std::string rim = words::rim_at(*room.map(), mode_of_play(room), place, 1e6);
  say(words::slope_at(*room.map(), place) + (rim.empty() ? "; the map has no end" : "; " + rim));
}

void TextGame::tell_news() {
  const Roster& roster = session_.room().roster();
  const std::size_t fresh = std::min(roster.lines_said() - lines_told_, roster.chat().size());
  for (std::size_t i = roster.chat().size() - fresh; i < roster.chat().size(); ++i) {
    const Utterance& line = roster.chat()[i];
    say(line.from.empty() ? line.text : line.from + " says: " + line.text);
  }
  lines_told_ = roster.lines_said();
  const std::string& notice = session_.room().notice_line();
  if (notice != notice_told_ && !notice.empty()) say(notice);
  notice_told_ = notice;
}

void TextGame::tell_podium() {
  const Sight sight = session_.room().sight();
  const protocol::Game* const game = sight.ruling.game;
  if (game == nullptr || game->phase != protocol::GamePhase::kPodium || game->round == podium_told_) return;
  podium_told_ = game->round;
  for (const std::string& line : words::podium(session_.room())) say(line);
}

/// While it is asked for.
void TextGame::tell_error(core::Time now) {
  const auto reading = own_error(session_.room(), asks_error_);
  if (!reading || now - error_told_ < kErrorEvery) return;
  error_told_ = now;
  say(words::error(*reading));
}

void TextGame::ask_error(core::Time now) {
  if (!has_error(session_.room())) return say(words::no_error(session_.room()));
  asks_error_ = !asks_error_;
  error_told_ = now;
  say(asks_error_ ? "how far steps err is told every 10 seconds" : "how far steps err is told no more");
}

void TextGame::teach() {
  if (!teacher_.observe(session_.room().sight(), steady_clock::now())) return;
  KeyLabels labels = bindings_.keys().labels();
  labels.compass = steer_ == SteerBy::kCompass;
  const core::Vec2 towards = words::way_to_goal(session_.room()).value_or(core::Vec2{0.0, 1.0});
  for (const GoalLine& line : teacher_.lines(labels, towards, Winds::kSpoken)) say(plain_text(line));
}

void TextGame::tell_proof() {
  if (const auto& of_tick = session_.room().follower().difference();
      of_tick && !std::exchange(is_difference_told_, true))
    say(to_text(*of_tick));
  const auto& difference = session_.room().verifier().difference();
  if (!difference) return;
  say(to_text(*difference));
  finish({});
}

void TextGame::on_key(const Key& key) {
  if (session_.is_trying() && !chatting_ && is_leaving(key, bindings_.keys())) return finish({});
  if (!chatting_ && !asked_ && key.code == KeyCode::kEscape && teacher_.dismiss()) return say("no lesson");
  if (chatting_ && !control_action(key)) {
    const ChatEntry::Outcome outcome = chat_.type(key);
    if (outcome == ChatEntry::Outcome::kTyping) return;
    if (outcome == ChatEntry::Outcome::kCancel)
      say("chat cancelled");
    else if (session_.is_trying())
      say("not said: the connection is lost");
    else
      session_.room().say(chat_.text());
    chatting_ = false;
    chat_.clear();
  } else if (const auto action = bindings_.on_key(key, asked_ ? Overlay::kQuitQuestion : Overlay::kNone)) {
    const core::Time now = steady_clock::now();
    if (key.action != KeyAction::kRelease && !bindings_.release_seen()) repeat_delay_.observe(key, now);
    perform(*action);
    driving_told_until_ = now + repeat_delay_.pulse();
  }
}

void TextGame::tell_keys() {
  const RoomView& room = session_.room();
  const bool is_here = std::any_of(room.lice().begin(), room.lice().end(),
                                   [](const auto& louse) { return louse.second.is_you; });
  const bool plays = room.welcome() != nullptr ? room.welcome()->id != 0 : is_here;
  say(words::keys(bindings_.keys().labels(), steer_, plays));
  std::string rules;
  for (const std::string& line : words::rules(room)) rules += (rules.empty() ? "" : " ") + line;
  if (!rules.empty()) say(rules);
}

/// What the keys have come to; a key that repeats is told once.
void TextGame::tell_driving(Action action, core::Time now) {
  const Steering& steering = session_.room().pilot()->steering();
  if (action == Action::kCruise) return say(steering.cruising() ? "cruise on" : "cruise off");
  std::string told;
  if (steering.braking(now))
    told = "brake";
  else if (steering.pushing(now))
    told = "push " + words::compass(steering.heading());
  else if (action == Action::kTurnLeft || action == Action::kTurnRight)
    told = "heading " + words::compass(steering.heading());
  if (told.empty() || (told == driving_told_ && now < driving_told_until_)) return;
  driving_told_ = told;
  say(told);
}

void TextGame::perform(Action action) {
  Pilot* const pilot = session_.room().pilot();
  const core::Time now = steady_clock::now();
  const Handling handling{steer_, {0.0, 1.0}, repeat_delay_.pulse(), bindings_.release_seen()};
  if (pilot != nullptr && drive(action, handling, pilot->steering(), now)) return tell_driving(action, now);
  switch (action) {
    case Action::kSteer:
      if (pilot == nullptr) break;
      steer_ = steer_ == SteerBy::kHeading ? SteerBy::kCompass : SteerBy::kHeading;
      pilot->steering().reset();
      say(steer_ == SteerBy::kCompass ? "steering by the compass: the keys push north, west, south and east"
                                      : "steering by the heading: the keys push along it and turn it");
      break;
    case Action::kView:
      read_ground();
      break;
    case Action::kError:
      ask_error(now);
      break;
    case Action::kHelp:
      tell_keys();
      break;
    case Action::kRespawn:
      session_.room().respawn();
      break;
    case Action::kGhost:
      if (pilot != nullptr) say(session_.room().own_game().ghosts().cycle());
      break;
    case Action::kGate:
      session_.room().set_gate(now);
      break;
    case Action::kScoreboard:
      for (const std::string& line : words::room(session_.room())) say(line);
      if (const auto count = session_.room().roster().spectators(); count > 0)
        say(std::to_string(count) + (count == 1 ? " watches" : " watch"));
      break;
    case Action::kChat:
      chatting_ = true;
      say("chat: type, Enter sends, Escape cancels");
      break;
    case Action::kAskQuit:
      asked_ = true;
      say("quit? Y or Q leaves, any other key stays");
      break;
    case Action::kConfirm:
      finish({});
      break;
    case Action::kClose:
      asked_ = false;
      say("staying");
      break;
    case Action::kQuitNow:
      finish({kExitInterrupted, ""});
      break;
    default:
      break;
  }
}

}  // namespace woodlouse::client
