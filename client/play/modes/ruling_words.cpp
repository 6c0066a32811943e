#include "client/play/modes/ruling_words.h"

#include <cassert>

#include "client/drawing/formatted.h"
#include "client/play/modes/goal.h"

namespace woodlouse::client {
namespace {

constexpr double kMomentsOfTick = 65536.0;

/// Who fell, and by whom: whoever bumped it off has held the place longer for it (rules/hill.h).
std::string fall_words(const protocol::Event& event, std::uint32_t you, const Sight& sight) {
  const auto by = static_cast<std::uint32_t>(event.values[0].value_or(0));
  const bool is_you = event.id == you;
  if (by == 0) return is_you ? "you fell off" : event.name + " fell off";
  const protocol::Game* const game = sight.ruling.game;
  const bool counts = game != nullptr && game->phase == protocol::GamePhase::kPlay;
  return (by == you ? "you" : sight.name_of(by)) + " pushed " + (is_you ? "you" : event.name) + " off" +
         (counts ? ": +3 s" : "");
}

}  // namespace

std::string describe_ruling(const protocol::Event& event, std::uint32_t you, std::uint32_t tick_hz,
                            const Sight& sight) {
  assert(sight.name_of && tick_hz > 0);
  using protocol::EventKind;
  const auto value = [&event](std::size_t k) { return event.values[k].value_or(0); };
  const bool is_you = event.id != 0 && event.id == you;
  switch (event.kind) {
    case EventKind::kGate:
      if (!is_you) return {};
      if (value(2) == 0) return value(0) == 0 ? "through S: the clock runs" : std::string();
      return gate_name(value(0)) + " " + span_text(value(2), tick_hz) +
             (event.values[3]
                  ? formatted(" %+.2f s", static_cast<double>(value(3)) / kMomentsOfTick / tick_hz)
                  : "");
    case EventKind::kLapDone:
      return is_you ? "lap " + span_text(value(1), tick_hz) + (value(2) != 0 ? ", your best" : "")
                    : std::string();
    case EventKind::kRun:
      return formatted("%s ran %s, #%ld", event.name.c_str(), span_text(value(0), tick_hz).c_str(),
                       static_cast<long>(value(1)));
    case EventKind::kRecord:
      return formatted("%s drove a record: %s", event.name.c_str(), span_text(value(0), tick_hz).c_str());
    case EventKind::kHarvest:
      return "harvest: crumbs count twice";
    case EventKind::kHolds:
      if (event.id == 0) return {};  // the lines say when nobody does
      return is_you ? "you hold the place" : event.name + " holds the place";
    case EventKind::kMoving:
      return "the place will move";
    case EventKind::kFell:
      return fall_words(event, you, sight);
    case EventKind::kRound:
      if (event.phase == protocol::GamePhase::kPlay)
        return formatted("round %ld begins", static_cast<long>(value(0)));
      if (event.phase == protocol::GamePhase::kPodium)
        return formatted("round %ld is over", static_cast<long>(value(0)));
      return {};
    default:
      return {};
  }
}

}  // namespace woodlouse::client
