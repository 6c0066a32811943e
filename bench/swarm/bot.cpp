#include "bench/swarm/bot.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "bench/swarm/frame_scan.h"
#include "bench/swarm/line_scan.h"
#include "bench/swarm/missed_frames.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::swarm {

using boost::system::error_code;

constexpr double kCostlyWeight = 10.0;  // what get_map and resync weigh, in messages, by docs/protocol.md

Bot::Bot(boost::asio::io_context& context, const Options& options, Profile profile, std::size_t number)
    : options_(options),
      profile_(std::move(profile)),
      random_(options.seed * 0x9E3779B97F4A7C15u + number),
      connection_(context, *this),
      acting_(context) {}

void Bot::start(const std::vector<Tcp::endpoint>& servers) {
  constexpr std::size_t kRetriesInACrowd = 50;
  state_ = State::kJoining;
  servers_ = servers;
  last_tick_.reset();
  held_until_.reset();
  arrival_ = {Clock::now(), {}, {}};
  connection_.open({servers, profile_.from, profile_.stalls, options_.is_crowd ? kRetriesInACrowd : 0});
}

void Bot::begin_measuring() {
  measuring_ = true;
  tally_ = {};
  last_frame_.reset();
  received_before_ = connection_.received();
  sent_before_ = connection_.sent();
}

/// A gap that is still open counts from where it is more than an ordinary one.
void Bot::end_measuring() {
  if (measuring_ && welcome_ && last_frame_ && !profile_.stalls) {
    const auto gap = Clock::now() - *last_frame_;
    if (gap > std::chrono::seconds(2) / std::max(1u, welcome_->state_hz)) tally_.frame_gaps.add(gap);
  }
  measuring_ = false;
  tally_.bytes = connection_.received() - received_before_;
  tally_.bytes_sent = connection_.sent() - sent_before_;
}

Tally Bot::harvest() {
  tally_.bytes = connection_.received() - std::exchange(received_before_, connection_.received());
  tally_.bytes_sent = connection_.sent() - std::exchange(sent_before_, connection_.sent());
  return std::exchange(tally_, {});
}

void Bot::cut(Clock::duration away) {
  if (state_ != State::kJoined) return;
  comeback_ = {welcome_->id, true, false, false};
  state_ = State::kIdle;
  last_frame_.reset();
  awaited_.clear();
  connection_.abort();
  acting_.expires_after(away);
  acting_.async_wait([this](error_code error) {
    if (!error && state_ == State::kIdle) start(servers_);
  });
}

void Bot::leave() {
  if (state_ != State::kJoined || profile_.stalls) return close();
  state_ = State::kLeaving;
  acting_.cancel();
  send(protocol::Leave{});
}

void Bot::close() {
  state_ = State::kClosed;
  acting_.cancel();
  connection_.close();
}

void Bot::lose(std::string reason) {
  if (state_ == State::kClosed) return;
  if (state_ != State::kLeaving) loss_ = std::move(reason);
  close();
}

bool Bot::on_line(std::string_view line, Clock::time_point now) {
  if (const auto tick = scan_frame_tick(line)) {
    take_frame(*tick, now);
  } else if (const auto seq = scan_ack_seq(line)) {
    take_ack(*seq, now);
  } else if (!is_only_counted(line)) {
    static const std::vector<protocol::Column> kNone;
    const auto message =
        protocol::decode_server(without_players(line), welcome_ ? welcome_->fields : kNone, options_.format);
    if (message) {
      take(*message, line, now);
    } else if (message.error().code != protocol::code::kUnknownType) {
      lose("a line out of shape: " + message.error().text);
    }
  }
  return state_ != State::kClosed;
}

void Bot::take_frame(std::uint64_t tick, Clock::time_point now) {
  if (last_tick_ && tick <= *last_tick_) return;
  if (!last_tick_ && welcome_) arrival_.to_first_frame = now - arrival_.connected;
  if (measuring_ && last_tick_ && last_frame_ && welcome_)
    tally_.missed += missed_frames(*last_tick_, tick, welcome_->tick_hz / std::max(1u, welcome_->state_hz));
  last_tick_ = tick;
  if (profile_.task == Task::kFile && state_ == State::kJoined) file_inputs(tick);
  if (!measuring_) return;
  ++tally_.distinct_ticks;
  if (last_frame_) tally_.frame_gaps.add(now - *last_frame_);
  last_frame_ = now;
}

void Bot::take(const protocol::ServerMessage& message, std::string_view line, Clock::time_point now) {
  using namespace protocol;
  if (const auto* hello = std::get_if<Hello>(&message)) {
    limits_ = hello->limits;
    join();
  } else if (const auto* welcome = std::get_if<Welcome>(&message)) {
    take_welcome(*welcome, line, now);
  } else if (const auto* frame = std::get_if<Frame>(&message)) {
    take_frame(frame->tick, now);
  } else if (const auto* ack = std::get_if<Ack>(&message)) {
    take_ack(ack->seq, now);
  } else if (const auto* ping = std::get_if<Ping>(&message)) {
    send(Pong{ping->t});
  } else if (const auto* notice = std::get_if<Notice>(&message)) {
    ++complaints_["notice " + notice->code];
  } else if (const auto* error = std::get_if<ErrorMessage>(&message)) {
    take_error(*error, now);
  } else if (const auto* bye = std::get_if<Bye>(&message)) {
    lose("bye " + bye->code + ": " + bye->text);
  }
}

void Bot::join() {
  protocol::Join join;
  join.role = profile_.role;
  join.name = profile_.name;
  join.room = profile_.room;
  join.format = options_.format;
  if (options_.view_rows != 0) join.view = protocol::View{{}, {}, {}, options_.view_rows};
  if (profile_.task == Task::kAsk) join.state_hz = 1;  // what it asks for is to outweigh what comes anyway
  std::string line = protocol::encode(protocol::ClientMessage(join));
  std::optional<std::string> token;
  if (comeback_.is_cut && welcome_ && !welcome_->resume_token.empty()) token = welcome_->resume_token;
  connection_.send(profile_.resumes ? with_resume(std::move(line), token) : line);
}

void Bot::take_welcome(const protocol::Welcome& welcome, std::string_view line, Clock::time_point now) {
  welcome_ = welcome;
  state_ = State::kJoined;
  arrival_.to_welcome = now - arrival_.connected;
  if (comeback_.is_cut) {
    comeback_.has_same_louse = welcome.id != 0 && welcome.id == comeback_.former_id;
    comeback_.says_resumed = says_resumed(line);
  }
  if (profile_.stalls) return connection_.stop_reading();
  if (profile_.vanishes) {
    connection_.abort();
    return close();
  }
  act_later();
}

void Bot::take_error(const protocol::ErrorMessage& error, Clock::time_point now) {
  ++complaints_["error " + error.code];
  const bool is_joining = state_ == State::kJoining;
  if (is_joining) ++refusals_[error.code];
  if (error.code == protocol::code::kRateLimited && error.retry_after_ms && options_.is_crowd &&
      !error.fatal) {
    held_until_ = now + std::chrono::milliseconds(*error.retry_after_ms);
    was_held_ = true;
    if (!is_joining) return;
    acting_.expires_at(*held_until_);
    return acting_.async_wait([this](error_code cancelled) {
      if (!cancelled && state_ == State::kJoining) join();
    });
  }
  if (error.fatal || is_joining) lose(error.code + ": " + error.text);
}

void Bot::take_ack(std::uint32_t seq, Clock::time_point now) {
  while (!awaited_.empty() && awaited_.front().seq <= seq) {
    const Sent sent = awaited_.front();
    awaited_.pop_front();
    if (sent.seq != seq || !measuring_) continue;
    ++tally_.acks;
    tally_.input_to_ack.add(now - sent.time);
  }
}

void Bot::act_later() {
  std::chrono::duration<double> wait{};
  if (profile_.task == Task::kSteer || profile_.task == Task::kChat) {
    // Between half and one and a half of the interval, so that the bots don't fall into step.
    wait = std::chrono::duration<double>((0.5 + random_.uniform()) / profile_.per_second);
  } else if (profile_.task == Task::kAsk) {
    // Twice as fast as allowed until what may come at once has gone, then as fast as allowed.
    const double weight = options_.ask == "list" ? 1.0 : kCostlyWeight;
    wait = std::chrono::duration<double>((was_held_ ? 1.0 : 0.5) * weight / limits_.messages_per_s);
  } else {
    return;
  }
  auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(wait);
  if (held_until_) until = std::max(until, *held_until_);
  acting_.expires_at(until);
  acting_.async_wait([this](error_code error) {
    if (error || state_ != State::kJoined) return;
    if (!held_until_ || Clock::now() >= *held_until_) act();
    if (state_ == State::kJoined) act_later();
  });
}

void Bot::act() {
  if (profile_.task == Task::kSteer) return send_input(random_input());
  if (profile_.task == Task::kChat)
    return send(protocol::Chat{profile_.name + " says " + std::to_string(++seq_)});
  if (options_.ask == "resync") return send(protocol::Resync{});
  if (options_.ask == "list") return send(protocol::List{});
  send(protocol::GetMap{});
}

/// All bots file for the same ticks: multiples of as many as the limits give the inputs in.
void Bot::file_inputs(std::uint64_t tick) {
  if (held_until_ && Clock::now() < *held_until_) return;
  const std::uint64_t due =
      options_.inputs_per_tick * welcome_->tick_hz / std::max(1u, limits_.messages_per_s) + 1;
  const std::uint64_t most = welcome_->tick_hz * 2 - welcome_->tick_hz / 6;  // 2 s ahead are taken
  const std::uint64_t period = std::min(due, most);
  const std::uint64_t target = (tick / period + 1) * period;
  if (target == filed_for_) return;
  filed_for_ = target;
  for (std::size_t i = 0; i < options_.inputs_per_tick && state_ == State::kJoined; ++i) {
    protocol::Input input = random_input();
    input.tick = target;
    send_input(input);
  }
}

void Bot::send_input(const protocol::Input& input) {
  if (awaited_.size() >= kMaxAwaited) awaited_.pop_front();
  if (measuring_) ++tally_.inputs;
  awaited_.push_back({input.seq, Clock::now()});
  send(input);
}

protocol::Input Bot::random_input() {
  protocol::Input input;
  input.seq = ++seq_;
  const bool is_vector = random_.uniform() < 0.7;
  const double angle = 2.0 * std::numbers::pi * random_.uniform();
  const double strength = random_.uniform();
  input.thrust = is_vector ? state::Thrust{state::ThrustKind::kMapVector,
                                           {strength * std::cos(angle), strength * std::sin(angle)}}
                           : state::Thrust{state::ThrustKind::kAlongHeading, {2.0 * strength - 1.0, 0.0}};
  if (random_.uniform() < 0.5) input.ticks = 1 + static_cast<std::uint32_t>(random_.next() % 60);
  return input;
}

void Bot::send(const protocol::ClientMessage& message) { connection_.send(protocol::encode(message)); }

}  // namespace woodlouse::swarm
