#include "server/net/handshake.h"

#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "shared/protocol/codes.h"

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
    if constexpr (kIsOneOf<Message, protocol::Input, protocol::Respawn>)
      if (state == Handshake::State::kSpectating)
        return error(code::kNoLouse, "a spectator has no louse; join as player or bot to steer one");
    return std::nullopt;
  }
}

}  // namespace

std::optional<ErrorMessage> Handshake::judge(const protocol::ClientMessage& message) {
  strikes_ = 0;
  return std::visit(
      [this](const auto& m) -> std::optional<ErrorMessage> {
        using Message = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<Message, protocol::Join>) {
          if (auto refusal = judge_join(state_)) return refusal;
          state_ = m.role == protocol::Role::kSpectator ? State::kSpectating : State::kPlaying;
          return std::nullopt;
        } else {
          if (auto refusal = judge_other<Message>(state_)) return refusal;
          if constexpr (std::is_same_v<Message, protocol::Leave>) state_ = State::kLeaving;
          return std::nullopt;
        }
      },
      message);
}

ErrorMessage Handshake::judge(const protocol::DecodeError& failure) {
  strikes_ = failure.is_json ? 0 : strikes_ + 1;
  const bool hopeless = strikes_ >= kMaxStrikes || failure.code == code::kBadProtocol;
  ErrorMessage answer{failure.code, failure.text, hopeless, {}};
  if (strikes_ >= kMaxStrikes) answer.text += "; " + std::to_string(kMaxStrikes) + " such lines running";
  return answer;
}

}  // namespace woodlouse::server
