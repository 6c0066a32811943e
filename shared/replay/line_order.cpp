#include "shared/replay/line_order.h"

#include <string>
#include <variant>

#include "shared/core/joined.h"

namespace woodlouse::replay {

using core::joined;

namespace {

std::string number(std::uint64_t n) { return std::to_string(n); }

template <typename... On>
struct Overloaded : On... {
  using On::operator()...;
};
template <typename... On>
Overloaded(On...) -> Overloaded<On...>;

}  // namespace

void LineOrder::begin() { wants_keyframe_ = true; }

core::Expected<void> LineOrder::follow(const Line& line) {
  if (has_end_) return core::fail({}, "stands after the end");
  if (has_index_ && !std::holds_alternative<End>(line))
    return core::fail({}, "stands after the index", "the end alone follows it");
  if (wants_keyframe_ && !std::holds_alternative<Keyframe>(line))
    return core::fail({}, "is no keyframe", "one stands behind the header");
  return std::visit(Overloaded{[&](const StepLine& l) { return step(l.step.tick, l.steps); },
                               [&](const Keyframe& l) { return keyframe(l.state.tick); },
                               [&](const ChatLine& l) { return aside("chat", l.tick); },
                               [&](const PauseLine& l) { return aside("pause", l.tick); },
                               [&](const IndexLine& l) { return index(l.tick); },
                               [&](const End& l) { return end(l.tick); }},
                    line);
}

core::Expected<void> LineOrder::step(std::uint64_t tick, std::uint64_t steps) {
  if (due_ && tick != *due_) {
    return core::fail({}, joined({"step ", number(tick), " stands where step ", number(*due_), " is due"}),
                      "lines are missing or out of order");
  }
  steps_ += steps;
  if (steps_ > kMaxStepsBetweenKeyframes) {
    return core::fail(
        {}, joined({"more than ", number(kMaxStepsBetweenKeyframes), " steps after the last keyframe"}),
        joined({"one stands every ", number(kKeyframeSeconds), " s"}));
  }
  due_ = tick + steps;
  chats_ = 0;
  has_keyframe_ = false;
  return {};
}

core::Expected<void> LineOrder::keyframe(std::uint64_t tick) {
  if (due_ && (tick != *due_ || has_keyframe_)) {
    return core::fail({}, joined({"a keyframe of tick ", number(tick), " stands where ",
                                  has_keyframe_ ? "one of tick " : "tick ", number(*due_),
                                  has_keyframe_ ? " stands already" : " is reached"}));
  }
  due_ = tick;
  steps_ = 0;
  has_keyframe_ = true;
  wants_keyframe_ = false;
  return {};
}

core::Expected<void> LineOrder::aside(const char* kind, std::uint64_t tick) {
  if (due_ && tick != *due_) {
    return core::fail(kind,
                      joined({"of step ", number(tick), " stands where step ", number(*due_), " is due"}),
                      "what is told stands before the step that was due");
  }
  due_ = tick;
  if (++chats_ > kMaxChatsAStep) {
    return core::fail(
        kind, joined({"more than ", number(kMaxChatsAStep), " lines of chat before step ", number(tick)}),
        "no server lets so many pass");
  }
  return {};
}

core::Expected<void> LineOrder::index(std::uint64_t tick) {
  if (due_ && tick != *due_) {
    return core::fail("index",
                      joined({"tick ", number(tick), " after step lines up to tick ", number(*due_)}),
                      "lines are missing");
  }
  due_ = tick;
  has_index_ = true;
  return {};
}

core::Expected<void> LineOrder::end(std::uint64_t tick) {
  if (due_ && !has_index_)
    return core::fail("end", "has no index before it", "a server writes both or neither");
  if (due_ && tick != *due_) {
    return core::fail("end", joined({"tick ", number(tick), " after step lines up to tick ", number(*due_)}),
                      "lines are missing");
  }
  has_end_ = true;
  return {};
}

}  // namespace woodlouse::replay
