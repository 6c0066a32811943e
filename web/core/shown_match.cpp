#include "web/core/shown_match.h"

#include <string>

#include "shared/follow/shown_game.h"
#include "shared/protocol/game.h"
#include "shared/protocol/messages.h"
#include "web/core/answer.h"

namespace woodlouse::web {

void answer_game(const match::Match* match) {
  std::string& out = answer();
  if (match == nullptr || match->rules() == nullptr) {
    out = "null";
    return;
  }
  json::ObjectText text(out);
  protocol::append_game(text, follow::shown_game(*match->rules()));
  text.end();
}

void answer_players(const match::Match* match) {
  static const match::PlayerLabels kNobody;
  json::append_array(answer(), match == nullptr ? kNobody : match->labels(),
                     [](std::string& out, const auto& player) {
                       json::ObjectText text(out);
                       text.integer("id", player.first)
                           .text("name", player.second.name)
                           .text("role", protocol::to_text(player.second.role))
                           .end();
                     });
}

void answer_standings(const match::Match* match) {
  const bool has_rules = match != nullptr && match->rules() != nullptr;
  json::append_array(
      answer(), has_rules ? match->labels() : match::PlayerLabels(),
      [&](std::string& out, const auto& player) {
        const rules::Standing standing = match->rules()->standing(player.first);
        json::ObjectText text(out);
        text.integer("id", player.first).integer("score", standing.score);
        text.integer("gate", standing.gate).integer("lap", standing.lap);
        text.integer("lap_start", standing.lap_start).integer("best_lap", standing.best_lap).end();
      });
}

void add_difference(json::ObjectText& text, const std::optional<replay::Difference>& difference) {
  if (!difference) {
    text.json("difference", "null");
    return;
  }
  text.object("difference", [&](json::ObjectText& object) {
    object.integer("tick", difference->tick)
        .text("what", difference->what)
        .text("detail", difference->detail);
  });
}

}  // namespace woodlouse::web
