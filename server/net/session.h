// One client's connection, and nothing of the game. Reads lines, judges them by the handshake's rules and the
// rate limiter, passes them to the room's door; writes what the outbox holds, one write in flight. The bytes
// go over a wire and the time comes from a timekeeper: a test stands in for both.
//
// How it ends: a fatal error, `leave`, a timeout, a slow client or the room's bye put a last line into the
// outbox; when that is written the sending side is shut, and what still comes in is read and thrown away
// until the client closes or the linger time is over (closing with unread bytes would reset the connection
// and take the bye with it).
//
// A client that ends its sending side leaves by that: it may read on, and one that has closed altogether
// looks the same. Who leaves gets every answer first: the room says when it has given its own.
#pragma once

#include <spdlog/logger.h>
#include <boost/asio/post.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/access/standing.h"
#include "server/frames/viewer.h"
#include "server/logging/events.h"
#include "server/net/allowance.h"
#include "server/net/handshake.h"
#include "server/net/pulse.h"
#include "server/net/send_rate.h"
#include "server/net/sender.h"
#include "server/net/wire.h"
#include "server/room/directory.h"
#include "server/room/door.h"
#include "server/room/lanes.h"
#include "server/room/subscriber.h"
#include "server/timing/figures.h"
#include "server/timing/live_limits.h"
#include "server/timing/timekeeper.h"
#include "shared/core/stable_hash.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/framing.h"
#include "shared/protocol/messages.h"

namespace woodlouse::server {

/// What all sessions share; outlives them.
struct SessionEnvironment {
  const Directory& directory;
  const LiveLimits& limits;
  TrafficMetrics& traffic;
  Timekeeper& timekeeper;
  std::string_view server_name;  ///< with its version
  std::shared_ptr<spdlog::logger> log;
  std::string web_url{};  ///< where a browser may go; empty: nowhere
  /// Has done what a moderator of that room wants, who: he himself, for the log. Any thread; answered once,
  /// on some thread.
  std::function<void(protocol::Moderate wish, std::string room, std::string who,
                     std::function<void(protocol::ServerMessage)> answered)>
      moderate{};
  Doorman* doorman = nullptr;  ///< what the operator says; null: everybody may
  /// Where a room is that is not here, as `host:port`; empty: it is about to go on somewhere;
  /// nothing: nobody knows it. Any thread; null: no room is.
  std::function<std::optional<std::string>(std::string_view room)> elsewhere{};
  /// What hello and pings name as `hosts`. Any thread; null: nothing.
  HostNews::Source hosts{};
};

class Session final : public Subscriber, private Sender::Owner, public std::enable_shared_from_this<Session> {
 public:
  /// From a fatal error on, or once a goodbye is written.
  static constexpr Duration kLinger = std::chrono::seconds(1);
  static constexpr Duration kShutdownLinger = std::chrono::milliseconds(300);

  /// The wire is of that lane of the server's: what is not said to be of any thread runs there alone.
  Session(SessionId id, std::unique_ptr<Wire> wire, const Lanes& lanes, std::size_t lane,
          std::shared_ptr<AddressAccount> address, const SessionEnvironment& environment);

  /// Others may read what comes and goes. Before it is started.
  void is_read_by_others() { standing_.is_read_by_others(); }

  // One of the two, once; any thread.

  enum class Greeting : std::uint8_t { kAtOnce, kAtOnceOnWeb, kAfterFirstLine };
  /// Says hello and begins to read. closed: called once, on the session's lane, when the wire is closed.
  /// kAfterFirstLine: hello is held back until the client has said a line, whatever it is; who goes without
  /// one hears none.
  void start(std::function<void()> closed, Greeting greeting = Greeting::kAtOnce);
  /// Instead of start(): an error and a bye, no hello.
  void start_refused(protocol::ErrorMessage why, std::function<void()> closed);

  // Any thread:

  /// By what its address is counted, and named in the log.
  [[nodiscard]] const std::string& address() const { return allowance_.address().name(); }
  /// The operator ends it; its louse does not wait for anybody.
  void expel(protocol::ErrorMessage why) {
    boost::asio::post(lane_, [self = shared_from_this(), why = std::move(why)] {
      if (self->state_ == State::kOpen) self->fail(why);
    });
  }

  // Subscriber: any thread.
  [[nodiscard]] std::size_t lane() const override { return lane_number_; }
  void deliver(Line line) override;
  void answer(protocol::ServerMessage message) override {
    boost::asio::post(lane_,
                      [self = shared_from_this(), message = std::move(message)] { self->say(message); });
  }
  void show(const Frame& frame) override;
  void show_again(const Frame& frame) override;
  void follow(const StreamPart& part) override {
    if (lane_.running_in_this_thread()) return follow_here(part);
    boost::asio::post(lane_, [self = shared_from_this(), part] { self->follow_here(part); });
  }
  void deliver_map(Line line) override;
  void deliver_record(Line line) override {
    boost::asio::post(lane_, [self = shared_from_this(), line = std::move(line)]() mutable {
      self->push_record(std::move(line));
    });
  }
  void refuse_join(protocol::ErrorMessage error) override;
  void welcome(protocol::Welcome welcome, std::uint32_t divisor) override;
  void let_go() override {
    boost::asio::post(lane_, [self = shared_from_this()] { self->say_goodbye(); });
  }
  void end(protocol::Bye bye) override {
    boost::asio::post(lane_, [self = shared_from_this(), bye = std::move(bye)] {
      self->say_bye({}, bye, Outbox::Replaceable::kDropped, kShutdownLinger);
    });
  }

 private:
  static constexpr std::size_t kKeptLine = 1024;  ///< bytes of an answer whose memory is used again

  enum class State {
    kOpen,
    kSayingBye,  ///< the last line waits in the outbox or is being written
    kDraining,   ///< our side is shut; waiting for the client's
    kClosed,
  };

  void read() {
    wire_->read_some(incoming_,
                     [self = shared_from_this()](const boost::system::error_code& error, std::size_t size) {
                       self->on_read(error, size);
                     });
  }
  void on_read(const boost::system::error_code& error, std::size_t size);
  /// It may have gone, or only say nothing more.
  void on_input_ended() {
    input_ended_ = true;
    if (state_ == State::kDraining) return close();
    if (is_listening()) on_message(protocol::Leave{}, now());
  }
  /// What comes after a `leave` or while a bye is said is thrown away.
  [[nodiscard]] bool is_listening() const {
    return state_ == State::kOpen && handshake_.state() != Handshake::State::kLeaving;
  }
  void greet() {
    if (std::exchange(is_greeted_, true)) return;
    say(hello_of(id_, environment_.server_name, environment_.directory.names(), *limits_,
                 hosts_.now(environment_.hosts)));
  }
  void take_lines(Time now);
  void on_line(const protocol::LineFramer::Line& line, Time now);
  void on_message(protocol::ClientMessage message, Time now);
  void join(protocol::Join join, Time now);
  void moderate(protocol::Moderate wish) {
    if (!standing_.may_moderate() || !environment_.moderate) return say(no_moderator());
    environment_.moderate(std::move(wish), door_->name(), "session " + core::to_hex(id_) + " of " + address(),
                          [session = weak_from_this()](protocol::ServerMessage message) {
                            if (const auto self = session.lock()) self->answer(std::move(message));
                          });
  }
  void ask(protocol::ClientMessage question, Time now) {
    if (const auto refusal = allowance_.ask(std::move(question))) return say(*refusal);
    pass_on_due(now);
    watch_next(now);
  }
  /// Charged before they are answered: many that are asked in one breath don't pass on one budget.
  void pass_on_due(Time now) {
    while (auto question = allowance_.due(now)) {
      allowance_.charge_answer(sizes_.of(*question), now);
      door_->submit(id_, std::move(*question), now);
    }
  }
  /// And soon; who watches the rooms takes his time.
  [[nodiscard]] bool is_to_join() const {
    return handshake_.state() == Handshake::State::kGreeting && !rooms_.is_on();
  }
  void tell_rooms(Time now) {
    std::string line = protocol::encode(environment_.directory.list());
    allowance_.charge_answer(line.size(), now);
    push(Line(std::move(line)));
    watch_next(now);
  }
  void push_record(Line line) {
    std::size_t& longest = line->starts_with(R"({"type":"ghost")") ? sizes_.ghost : sizes_.records;
    longest = std::max(longest, line->size());
    if (line->size() <= limits_->outbox_bytes / 2) return push(std::move(line));
    say(protocol::ErrorMessage{std::string(protocol::code::kNoRecords),
                               "the answer is more than half of what may wait for you",
                               false,
                               {}});
  }

  void show_here(const Frame& frame);
  /// To each game of a room anew: other lice.
  void begin_viewing(const protocol::Welcome& welcome) {
    viewer_.reset();
    louse_ = welcome.id;
    most_rows_ = welcome.view_rows.value_or(protocol::kEveryRow);
  }
  /// The room need only know whether it is shown all or a part.
  [[nodiscard]] bool is_for_room(const protocol::Look& look) {
    const bool was_whole = std::exchange(view_, look.view).is_whole();
    if (viewer_) viewer_->look(view_);
    return was_whole != view_.is_whole();
  }
  /// What this client sees of it; none: nothing that it could use.
  [[nodiscard]] std::optional<Frame> seen(const Frame& frame) {
    if (!frame.sheet) return frame;
    if (!viewer_) viewer_ = std::make_unique<Viewer>(view_, louse_, most_rows_);
    return viewer_->frame(frame);
  }
  void follow_here(const StreamPart& part) {
    if (state_ != State::kOpen) return;
    if (part.lines) {
      charge(part);
      sender_.outbox().follow(part);
    }
    if (++parts_ % divisor_ == 0 || part.is_last || part.kind == StreamPart::Kind::kKeyframe) sender_.write();
  }
  /// What begins a game was not asked for, and is charged as it comes; a resync is charged before, by the
  /// size of the last one.
  void charge(const StreamPart& part) {
    const std::size_t size = part.lines->size();
    const bool is_header = part.kind == StreamPart::Kind::kHeader;
    const bool is_keyframe = part.kind == StreamPart::Kind::kKeyframe;
    if (is_keyframe) sizes_.key = size;
    if (part.is_answer && part.kind == StreamPart::Kind::kSteps) sizes_.key += size;
    if (is_header || (is_keyframe && has_header_)) allowance_.charge_answer(size, now());
    if (is_header || is_keyframe) has_header_ = is_header;
  }
  /// Where the client has fallen behind in the stream, as if it had sent resync.
  void ask_for_keyframe() {
    if (state_ != State::kOpen || !sender_.outbox().take_wish()) return;
    if (!allowance_.ask(protocol::Resync{})) pass_on_due(now());  // else one is on its way
    watch_next(now());
  }
  void say(const protocol::ServerMessage& message) {
    if (const auto* error = std::get_if<protocol::ErrorMessage>(&message))
      environment_.traffic.refused_lines.add(error->code);
    push(answers_.line([&](std::string& text) { protocol::append(text, message); }));
  }
  void push(Line line);
  void queue(Line line);
  [[nodiscard]] std::shared_ptr<void> keep() override { return shared_from_this(); }
  void on_sent() override { pulse_.sent(now()); }
  void on_all_sent() override;
  void on_broken() override { close(); }
  void tell_pace(SendRate::Change change);

  /// A line.
  void refuse(const protocol::ErrorMessage& error) {
    if (!error.fatal) return say(error);
    environment_.traffic.refused_lines.add(error.code);
    fail(error);
  }
  void fail(std::string_view code, std::string text) {
    fail(protocol::ErrorMessage{std::string(code), std::move(text), true, {}});
  }
  void fail(const protocol::ErrorMessage& error);
  void say_goodbye();
  void say_bye(const std::optional<protocol::ErrorMessage>& error, const protocol::Bye& bye,
               Outbox::Replaceable replaceable, Duration linger);
  void leave_room() {
    if (!door_) return;
    std::exchange(door_, nullptr)->leave(id_, parting_);
    if (is_end_told_) return;
    parting_ == Parting::kLeft ? log(LogEvent::kLeft, "left")
                               : log(LogEvent::kConnectionEnded, "connection ended");
  }
  void close();

  [[nodiscard]] Time now() const { return environment_.timekeeper.now(); }
  void watch(Time until) {
    watch_->set(until, [self = shared_from_this()](bool cancelled) {
      if (!cancelled) self->on_watch();
    });
  }
  void watch_next(Time now);
  void on_watch();
  void check_pulse(Time now);
  void log(LogEvent event, const std::string& what);

  SessionId id_;
  std::unique_ptr<Wire> wire_;
  Lane lane_;
  std::size_t lane_number_;
  const SessionEnvironment& environment_;
  std::shared_ptr<const protocol::Limits> limits_;
  std::function<void()> closed_;

  State state_ = State::kOpen;
  Handshake handshake_;
  std::shared_ptr<Door> door_;  ///< null before the join
  std::array<char, 2048> incoming_{};
  protocol::LineFramer framer_;
  Standing standing_;
  bool is_greeted_ = false;   ///< hello is said
  bool input_ended_ = false;  ///< the client has shut its sending side: nothing is left to read
  Parting parting_ = Parting::kLost;
  Allowance allowance_;

  LinePool answers_{kKeptLine};
  Sender sender_;
  SendRate rate_;
  std::uint32_t divisor_ = 1;
  protocol::View view_;             ///< asked for
  std::unique_ptr<Viewer> viewer_;  ///< since a frame came as a sheet
  std::uint32_t louse_ = 0;         ///< its own; 0: a spectator
  std::size_t most_rows_ = protocol::kEveryRow;
  bool is_web_ = false;      ///< it came by the web port
  std::uint64_t parts_ = 0;  ///< of the stream, so far
  bool has_header_ = false;  ///< and no keyframe behind it yet
  AnswerSizes sizes_;

  std::unique_ptr<Alarm> watch_;
  DirectoryWatch rooms_;
  Pulse pulse_;
  std::int64_t pings_ = 0;
  HostNews hosts_;
  bool is_end_told_ = false;  ///< in the log
  Time handshake_until_;
  std::optional<Time> goes_on_at_;  ///< with lines that came at once with too many; nothing is read till then
  Time linger_until_{};
};

}  // namespace woodlouse::server
