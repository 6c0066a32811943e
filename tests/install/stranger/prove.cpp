// Plays a short game, records it in memory, proves the recording, and shows that an altered one is caught.
#include <iostream>
#include <string>

#include "shared/map/map_file.h"
#include "shared/match/match.h"
#include "shared/replay/verify.h"
#include "shared/replay/writer.h"

using namespace woodlouse;

int main(int, char** argv) {
  int unused;
  const auto map = map::load_map(argv[1]);
  if (!map) {
    std::cerr << map.error().text() << '\n';
    return 1;
  }
  match::Match game(*map, {60, 7});
  replay::ReplayWriter writer;
  std::string recording;
  writer.append_header(recording, replay::make_header(game, "stranger 1", argv[1]));
  writer.append_keyframe(recording, game.state());
  game.join();
  for (int tick = 0; tick < 200; ++tick) writer.append_step(recording, game.advance());
  writer.append_end(recording, "done");

  const auto judged = [](std::string bytes) {
    const auto verdict = replay::verify(replay::ReplaySource::of_bytes(std::move(bytes), "game"));
    return verdict ? replay::to_text(*verdict) : verdict.error().text();
  };
  std::string altered = recording;
  const std::size_t hash = altered.find("\"hash\":\"", altered.find("{\"step\":100,")) + 8;
  altered[hash] = altered[hash] == '0' ? '1' : '0';
  std::cout << judged(recording) << judged(altered);
  return judged(recording) == "ok ticks 0 to 200\n" && judged(altered).find("differs at tick 101") == 0 ? 0
                                                                                                        : 1;
}
