// Who is in the room and what was said: names from welcome and events, the chat and the game's own notices.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "shared/protocol/messages.h"

namespace woodlouse::client {

struct Resident {
  std::string name;
  protocol::Role role = protocol::Role::kPlayer;
};

/// A line of the chat; `from` is empty for a notice of the game.
struct Utterance {
  std::string from;
  std::string text;
};

class Roster {
 public:
  static constexpr std::size_t kLines = 50;  ///< the oldest are forgotten beyond

  /// A new session: who is there replaces who was; the chat stays. You are there under the name you were
  /// given.
  void welcome(const protocol::Welcome& welcome);
  /// How many look on: nobody says when one comes or goes.
  void count_spectators(std::uint32_t count) { spectators_ = count; }
  void event(const protocol::Event& event);
  void note(std::string text) { say({}, std::move(text)); }

  /// The resident of that id; null for ids not announced.
  [[nodiscard]] const Resident* find(std::uint32_t id) const;
  [[nodiscard]] std::size_t lice() const { return residents_.size(); }
  [[nodiscard]] std::size_t bots() const {
    return static_cast<std::size_t>(
        std::count_if(residents_.begin(), residents_.end(),
                      [](const auto& resident) { return resident.second.role == protocol::Role::kBot; }));
  }
  /// As last counted.
  [[nodiscard]] std::uint32_t spectators() const { return spectators_; }
  [[nodiscard]] const std::deque<Utterance>& chat() const { return chat_; }
  /// How many lines there ever were; tells what is new.
  [[nodiscard]] std::size_t lines_said() const { return lines_said_; }

 private:
  void say(std::string from, std::string text);

  std::map<std::uint32_t, Resident> residents_;
  std::uint32_t spectators_ = 0;
  std::deque<Utterance> chat_;
  std::size_t lines_said_ = 0;
};

/// What an event says, for a person: "ada joined", "bot gauss left".
std::string describe(const protocol::Event& event);

}  // namespace woodlouse::client
