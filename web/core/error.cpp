// How far the steps of one louse err (shared/match/live_error.h), for who asks.
#include <cassert>
#include <cstdint>
#include <memory>

#include "shared/json/object_text.h"
#include "shared/match/live_error.h"
#include "shared/state/mode.h"
#include "web/core/answer.h"
#include "web/core/ground.h"
#include "web/core/live_error_text.h"

extern "C" const woodlouse::state::Louse* world_find(woodlouse::web::Handle handle, std::uint32_t id);

namespace woodlouse::web {
namespace {

struct OpenError {
  OpenError(const std::shared_ptr<const map::Map>& on, std::uint32_t hz, state::Mode mode,
            std::uint32_t settling)
      : map(on), error(*on, 1.0 / hz, mode, settling) {}

  std::shared_ptr<const map::Map> map;  ///< its steps may refer to it
  match::LiveError error;
};

Handles<OpenError> errors;

}  // namespace

void answer_error(const match::LiveError& error) {
  const auto reading = error.reading();
  if (!reading) {
    answer() = "null";
    return;
  }
  json::ObjectText text(answer());
  text.number("of_play", reading->of_play).number("worst", reading->worst);
  text.integer("worst_tick", reading->worst_tick).number("apart", reading->apart);
  text.number("apart_seconds", reading->apart_seconds).end();
}

/// Of a louse in a world of the same ground, rate and mode. settling: how many ticks old one is before it
/// counts, below 2048. REQUIRES what world_open does.
WOODLOUSE_EXPORT(error_open)
Handle error_open(Handle on, std::uint32_t hz, std::uint32_t mode, std::uint32_t settling) {
  const std::shared_ptr<const map::Map>& map = ground(on);
  assert(map->detail == map::Detail::kExact && hz >= 1 && hz <= 1000 && mode < state::kModes.size());
  assert(map->definition.modes.has(state::kModes[mode]) && settling < match::LiveError::kMostWaiting);
  return errors.add(std::make_unique<OpenError>(map, hz, state::kModes[mode], settling));
}

WOODLOUSE_EXPORT(error_close) void error_close(Handle handle) { errors.close(handle); }

/// The louse as the step of number `tick` finds it, thrust told: as it stands in that world now; again, where
/// it is run again. Always the same louse. False: there is none of that id.
WOODLOUSE_EXPORT(error_find)
bool error_find(Handle handle, Handle world, std::uint32_t id, double tick) {
  assert(tick >= 0.0);
  const state::Louse* const louse = world_find(world, id);
  if (louse != nullptr) errors.at(handle).error.find(*louse, static_cast<std::uint64_t>(tick));
  return louse != nullptr;
}

/// What was found and has not counted was no play.
WOODLOUSE_EXPORT(error_forget) void error_forget(Handle handle) { errors.at(handle).error.forget_waiting(); }

/// Counts at most so many ticks. Answers with {"of_play" [m/s of play], "worst" [m], "worst_tick", "apart"
/// [m], "apart_seconds"}, or null before the first tick has counted.
WOODLOUSE_EXPORT(error_count) void error_count(Handle handle, std::uint32_t most) {
  match::LiveError& error = errors.at(handle).error;
  error.count(most);
  answer_error(error);
}

}  // namespace woodlouse::web
