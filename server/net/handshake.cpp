#include "server/net/handshake.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "shared/core/joined.h"
#include "shared/core/stable_hash.h"
#include "shared/match/match.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/whereabouts.h"

namespace woodlouse::server {
namespace {

namespace code = protocol::code;
using protocol::ErrorMessage;

template <typename T, typename... Us>
constexpr bool kIsOneOf = (std::is_same_v<T, Us> || ...);

ErrorMessage error(std::string_view code, std::string text) {
  return {std::string(code), std::move(text), false, {}};
}

std::optional<ErrorMessage> judge_join(Handshake::State state) {
  if (state == Handshake::State::kGreeting) return std::nullopt;
  return error(code::kAlreadyJoined, "join: this connection has joined; open another one to play twice");
}

template <typename Message>
std::optional<ErrorMessage> judge_other(Handshake::State state) {
  if constexpr (kIsOneOf<Message, protocol::Ping, protocol::Pong, protocol::List, protocol::Leave>) {
    return std::nullopt;
  } else {
    if (state == Handshake::State::kGreeting)
      return error(code::kNotJoined,
                   R"(join first: {"type":"join","protocol":1,"role":"player","name":"you"})");
    if constexpr (kIsOneOf<Message, protocol::Input, protocol::Respawn, protocol::Skip>)
      if (state == Handshake::State::kSpectating)
        return error(code::kNoLouse, "a spectator has no louse; join as player or bot to steer one");
    return std::nullopt;
  }
}

}  // namespace

std::optional<ErrorMessage> Handshake::why_not(const protocol::ClientMessage& message) {
  assert(state_ != State::kLeaving);
  strikes_ = 0;
  return std::visit(
      [this](const auto& m) {
        using Message = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<Message, protocol::Join>)
          return judge_join(state_);
        else
          return judge_other<Message>(state_);
      },
      message);
}

void Handshake::take(const protocol::ClientMessage& message) {
  if (const auto* join = std::get_if<protocol::Join>(&message))
    state_ = join->role == protocol::Role::kSpectator ? State::kSpectating : State::kPlaying;
  if (std::holds_alternative<protocol::Leave>(message)) state_ = State::kLeaving;
}

ErrorMessage Handshake::judge(const protocol::DecodeError& failure) {
  strikes_ = failure.is_json ? 0 : strikes_ + 1;
  const bool hopeless = strikes_ >= kMaxStrikes || failure.code == code::kBadProtocol;
  ErrorMessage answer{failure.code, failure.text, hopeless, {}};
  if (strikes_ >= kMaxStrikes) answer.text += "; " + std::to_string(kMaxStrikes) + " such lines running";
  return answer;
}

std::vector<std::string> HostNews::now(const Source& source) {
  return tell(source ? source() : std::vector<std::string>{});
}

std::optional<std::vector<std::string>> HostNews::since(const Source& source) {
  if (!source) return std::nullopt;
  std::vector<std::string> hosts = source();
  const bool has_room = told_.size() < std::min(hosts.size(), protocol::kMaxHosts);
  const auto is_there = [&hosts](const std::string& told) {
    return std::find(hosts.begin(), hosts.end(), told) != hosts.end();
  };
  if (!has_room && std::all_of(told_.begin(), told_.end(), is_there)) return std::nullopt;
  return tell(std::move(hosts));
}

std::vector<std::string> HostNews::tell(std::vector<std::string> hosts) {
  if (hosts.size() > protocol::kMaxHosts) hosts.resize(protocol::kMaxHosts);
  return told_ = std::move(hosts);
}

protocol::Hello hello_of(std::uint64_t session, std::string_view server, std::vector<std::string> rooms,
                         const protocol::Limits& limits, std::vector<std::string> hosts) {
  protocol::Hello hello;
  hello.behavior = match::kBehavior;
  hello.server = server;
  hello.session = core::to_hex(session);
  hello.rooms = std::move(rooms);
  hello.features = {"quantized", "exact",   "fields",   "delta", "get_map", "resume",
                    "rules",     "records", "rotation", "view",  "inputs"};
  hello.limits = limits;
  assert(hosts.size() <= protocol::kMaxHosts);
  hello.hosts = std::move(hosts);
  return hello;
}

std::string where_http_is(std::string_view line, std::string_view web_url) {
  constexpr std::string_view kMethods[] = {"GET ",    "HEAD ",    "POST ",   "PUT ",
                                           "DELETE ", "OPTIONS ", "CONNECT "};
  const auto begins = [line](std::string_view method) { return line.starts_with(method); };
  if (std::none_of(std::begin(kMethods), std::end(kMethods), begins)) return {};
  if (line.find(" HTTP/") == std::string_view::npos) return {};
  if (web_url.empty()) return "; this port speaks no HTTP, and no other does: start the server with --web";
  return core::joined({"; this port speaks no HTTP: open ", web_url});
}

protocol::ErrorMessage room_moved(const std::string& asked, std::string address) {
  constexpr std::uint32_t kAskAgainMs = 50;
  if (address.empty())
    return {std::string(code::kMoved),
            core::joined({"join.room: \"", asked, "\" is about to go on: join again"}), false, kAskAgainMs};
  ErrorMessage moved =
      error(code::kMoved, core::joined({"join.room: \"", asked, "\" is at ", address, " now"}));
  moved.fatal = true;
  moved.address = std::move(address);
  return moved;
}

protocol::ErrorMessage unknown_room(const std::string& asked, const std::vector<std::string>& rooms) {
  std::string names;
  for (const std::string& name : rooms) names += ' ' + name;
  return error(code::kUnknownRoom, "join.room: no room \"" + asked + "\"; there are:" + names);
}

protocol::ErrorMessage no_moderator() {
  return error(code::kNoRight, "moderate: you joined with no moderator's token");
}

}  // namespace woodlouse::server
