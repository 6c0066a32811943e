#include "client/play/spoken_words.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "client/play/modes/course_builder.h"
#include "client/play/scene_builder.h"

namespace woodlouse::client {
namespace {

constexpr std::size_t kMostLice = 20;  // read out at once; your own always

std::string number(double value, int decimals) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  const std::string said = text.data();
  const bool is_nought = said.find_first_of("123456789") == std::string::npos;
  return is_nought && said.front() == '-' ? said.substr(1) : said;  // "-0" says nothing
}

std::string offset(double value, const char* positive, const char* negative) {
  return number(std::abs(value), 1) + " m " + (value < 0.0 ? negative : positive);
}

/// What a mode counts by; points alone would be a number alone.
std::string counted(state::Mode mode, const std::string& measure) {
  return mode == state::Mode::kForage ? "score " + measure : measure;
}

}  // namespace

namespace words {

std::string compass(core::Vec2 direction) { return client::compass(direction, {0.0, 1.0}, Winds::kSpoken); }

std::string louse(const RoomView& room, const Present& louse) {
  const LouseSample& sample = louse.sample;
  std::string line = (louse.is_you ? "you" : louse.name) + ": " + offset(sample.position.x, "east", "west") +
                     ", " + offset(sample.position.y, "north", "south");
  double speed = std::hypot(sample.velocity.x, sample.velocity.y);
  if (room.map() != nullptr) {
    const terrain::SurfaceSample ground = room.map()->terrain->sample(sample.position.x, sample.position.y);
    const bool moves = speed > 0.05;
    const core::Vec2 direction = moves ? (1.0 / speed) * sample.velocity : sample.heading;
    speed = speed_in_space(ground, sample.velocity);
    line += ", height " + number(ground.z, 1) + " m, " + number(speed, 1) + " m/s " + compass(direction) +
            ", slope " + number(slope_degrees(ground, direction), 0) + " degrees";
  }
  return line + ", travelled " + number(sample.distance, 0) + " m";
}

std::vector<std::string> goal(const RoomView& room) {
  const Sight sight = room.sight();
  const std::uint32_t id = room.welcome() != nullptr ? room.welcome()->id : 0;
  std::vector<std::string> lines;
  for (const GoalLine& line : goal_lines(
           {sight, id, sample_of(sight, id), id != 0, &room.own_game().run(), 0, {0.0, 1.0}, Winds::kSpoken}))
    lines.push_back(plain_text(line));
  return lines;
}

std::optional<core::Vec2> way_to_goal(const RoomView& room) {
  const Sight sight = room.sight();
  const std::uint32_t id = room.welcome() != nullptr ? room.welcome()->id : 0;
  const LouseSample* const you = sample_of(sight, id);
  const auto place = goal_of({sight, id, you, true});
  return place ? std::optional(*place - you->position) : std::nullopt;
}

std::vector<std::string> rules(const RoomView& room) {
  return course_of({room.sight(), 0, nullptr, false, nullptr, 0}).rules;
}

std::vector<std::string> podium(const RoomView& room) {
  const Sight sight = room.sight();
  const std::uint32_t id = room.welcome() != nullptr ? room.welcome()->id : 0;
  const Course course = course_of({sight, id, sample_of(sight, id), id != 0, &room.own_game().run(), 0});
  std::vector<std::string> lines;
  for (const PodiumStep& step : course.podium)
    lines.push_back("place " + std::to_string(lines.size() + 1) + ": " + (step.is_you ? "you" : step.name) +
                    ", " + counted(sight.ruling.mode, step.measure) +
                    (step.medal.empty() ? "" : ", " + step.medal));
  if (!lines.empty() && !course.podium_note.empty()) lines.push_back(course.podium_note);
  return lines;
}

std::string error(const match::ErrorReading& reading) {
  std::array<char, 160> text{};
  std::snprintf(
      text.data(), text.size(),
      "error %.1e m/s of play, worst %.1e m at tick %llu; twin at half the step %.1e m away after %.0f s",
      reading.of_play, reading.worst, static_cast<unsigned long long>(reading.worst_tick), reading.apart,
      reading.apart_seconds);
  return text.data();
}

std::string no_error(const RoomView& room) {
  return room.pilot() == nullptr ? "only of your own louse the error is known"
                                 : "on an overview of a map no error is known";
}

std::string keys(const KeyLabels& keys, SteerBy steer, bool plays) {
  const auto spoken = [](const std::string& label) {
    return label == "SPC" ? "Space" : label == "TAB" ? "Tab" : label == "?" ? "question mark" : label;
  };
  const std::string all =
      spoken(keys.scores) + " where everyone is, " + keys.chat + " chat, " + spoken(keys.help) + " help, ";
  if (!plays) return "keys: " + all + keys.quit + " quit";
  const std::string driving =
      steer == SteerBy::kCompass
          ? keys.up + " push north, " + keys.left + " west, " + keys.down + " south, " + keys.right +
                " east, " + keys.brake + " brake"
          : keys.up + " push, " + keys.down + " brake, " + keys.left + " and " + keys.right + " turn";
  return "keys: " + driving + ", " + spoken(keys.cruise) + " cruise, " + keys.view + " where downhill is, " +
         all + keys.steer + " steer another way, " + keys.error + " how far steps err, " + keys.respawn +
         " respawn, " + keys.quit + " quit";
}

std::vector<std::string> room(const RoomView& view) {
  std::vector<std::string> lines;
  const std::vector<ScoreRow> rows = score_rows(view.sight());
  std::size_t rank = 0;
  for (const ScoreRow& row : rows) {
    if (rank >= kMostLice && !row.is_you) {
      ++rank;
      continue;
    }
    ++rank;
    const auto present = view.lice().find(row.id);
    const std::string place = row.rank > 0 ? "number " + std::to_string(row.rank) : std::string();
    const bool is_by_way = row.measure.empty();  // then it stands behind the way
    std::string line = place.empty() || is_by_way ? "" : place + ", ";
    line += present != view.lice().end() ? louse(view, present->second) : row.is_you ? "you" : row.name;
    if (is_by_way && !place.empty()) line += ", " + place;
    if (!is_by_way)
      line += ", " + (row.measure == "--" ? "no time yet" : counted(view.sight().ruling.mode, row.measure));
    if (row.is_you)
      lines.insert(lines.begin(), std::move(line));
    else
      lines.push_back(std::move(line));
  }
  if (rows.size() > kMostLice) lines.push_back("and " + std::to_string(rows.size() - kMostLice) + " more");
  return lines;
}

std::string what_became(const protocol::Welcome& welcome) {
  if (welcome.id == 0) return "watching again";
  return welcome.resumed ? "back in your louse" : "your louse is gone: this is a new one";
}

}  // namespace words

}  // namespace woodlouse::client
