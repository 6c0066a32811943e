#include "client/play/own_error.h"

#include <cassert>
#include <memory>

#include "shared/match/live_error.h"

namespace woodlouse::client {

bool has_error(const RoomView& room) {
  return room.pilot() != nullptr && room.pilot()->predicts() && room.map() != nullptr;
}

std::optional<match::ErrorReading> own_error(RoomView& room, bool asked) {
  if (!has_error(room)) return std::nullopt;
  Prediction& prediction = *room.pilot()->prediction();
  if (!asked) return prediction.measure(nullptr), std::nullopt;
  if (prediction.error() == nullptr)
    prediction.measure(std::make_shared<match::LiveError>(*room.map(), prediction.step_seconds(),
                                                          prediction.mode(), room.welcome()->tick_hz));
  match::LiveError& error = *prediction.error();
  // One that is out (of a hill) is predicted on, but plays nothing.
  if (!room.lice().contains(room.pilot()->id())) error.forget_waiting();
  error.count(kMostErrorTicks);
  return error.reading();
}

}  // namespace woodlouse::client
