#include "shared/protocol/ack_line.h"

#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "shared/json/text.h"
#include "shared/state/louse_fields.h"

namespace woodlouse::protocol {
namespace {

/// What an ack can become, on the stack.
class AckText {
 public:
  template <std::size_t Size>
  AckText& literal(const char (&text)[Size]) {
    std::memcpy(end_, text, Size - 1);
    end_ += Size - 1;
    return *this;
  }
  AckText& word(std::string_view text) {
    std::memcpy(end_, text.data(), text.size());
    end_ += text.size();
    return *this;
  }
  template <std::integral T>
  AckText& integer(T value) {
    end_ = json::write_integer(end_, value);
    return *this;
  }
  AckText& number(double value) {
    end_ = json::write_double(end_, value);
    return *this;
  }
  AckText& boolean(bool value) { return value ? literal("true") : literal("false"); }

  void append_to(std::string& out) const {
    assert(end_ <= text_ + kRoom);
    out.append(text_, static_cast<std::size_t>(end_ - text_));
  }

 private:
  static constexpr std::size_t kNumbers = 19;
  static constexpr std::size_t kNames = 300;
  static constexpr std::size_t kRoom = kNames + kNumbers * json::kNumberRoom;

  char text_[kRoom];
  char* end_ = text_;
};

/// Every field of the louse; pairs where the frames' columns are single.
void write_state(AckText& text, const ExactState& exact) {
  const state::Louse& louse = exact.louse;
  text.literal(R"(,"you":{"tick":)").integer(exact.tick).literal(R"(,"id":)").integer(louse.id);
  text.literal(R"(,"x":)").number(louse.position.x).literal(R"(,"y":)").number(louse.position.y);
  text.literal(R"(,"vx":)").number(louse.velocity.x).literal(R"(,"vy":)").number(louse.velocity.y);
  text.literal(R"(,"heading":[)").number(louse.heading.x).literal(",").number(louse.heading.y);
  text.literal(R"(],"thrust":[)").number(louse.thrust.x).literal(",").number(louse.thrust.y);
  text.literal(R"(],"thrust_kind":)").integer(static_cast<std::uint32_t>(louse.thrust_kind));
  text.literal(R"(,"thrust_ticks":)").integer(louse.thrust_ticks);
  text.literal(R"(,"phase":)").integer(static_cast<std::uint32_t>(louse.phase));
  constexpr const state::LouseField* kFirst = state::find_field("flight_z");
  constexpr const state::LouseField* kLast = state::find_field("distance");
  static_assert(kLast - kFirst == 2, "its height and vertical speed in flight, its way");
  for (const state::LouseField* field = kFirst; field <= kLast; ++field)
    text.literal(",\"").word(field->name).literal("\":").number(state::field_value(louse, *field));
  text.literal("}");
}

}  // namespace

void append_ack(std::string& out, const Ack& ack) {
  AckText text;
  text.literal(R"({"type":"ack","seq":)").integer(ack.seq).literal(R"(,"tick":)").integer(ack.tick);
  text.literal(R"(,"margin_us":)").integer(ack.margin_us);
  text.literal(R"(,"late":)").boolean(ack.late).literal(R"(,"dropped":)").boolean(ack.dropped);
  text.literal(R"(,"clamped":)").boolean(ack.clamped);
  if (ack.you) write_state(text, *ack.you);
  text.literal("}\n").append_to(out);
}

}  // namespace woodlouse::protocol
