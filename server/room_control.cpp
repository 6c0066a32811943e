#include "server/room_control.h"

#include <spdlog/fmt/fmt.h>

#include <boost/asio/post.hpp>

#include <cassert>
#include <mutex>
#include <random>
#include <system_error>
#include <utility>

#include "server/admin/answer.h"
#include "server/chosen_games.h"
#include "server/logging/events.h"
#include "server/version.h"
#include "shared/core/printable.h"
#include "shared/protocol/codes.h"
#include "shared/protocol/text_cleaning.h"

namespace woodlouse::server {
namespace {

namespace asio = boost::asio;

std::uint64_t fresh_seed() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

/// What became of an order in each of several rooms.
struct Outcomes {
  struct One {
    std::string room;
    core::Expected<std::uint64_t> tick;
  };
  std::mutex mutex;
  std::vector<One> all;
  std::size_t missing = 0;
};

std::string answer_of(const std::vector<Outcomes::One>& all, const std::string& done_text) {
  std::string text;
  bool is_any_done = false;
  for (const Outcomes::One& one : all) {
    is_any_done |= one.tick.has_value();
    text += text.empty() ? "" : "\n";
    text += one.tick ? fmt::format("{}: {}, at tick {}", core::printable(one.room), done_text, *one.tick)
                     : fmt::format("{}: {}", core::printable(one.room), one.tick.error().text());
  }
  if (!is_any_done) return refused(admin_code::kNotNow, text);
  return done(text, [&all](json::ObjectText& object) {
    object.objects("rooms", all, [](json::ObjectText& row, const Outcomes::One& one) {
      row.text("name", one.room).boolean("done", one.tick.has_value());
      if (one.tick) row.integer("tick", *one.tick);
    });
  });
}

}  // namespace

std::vector<std::shared_ptr<Room>> chosen_rooms(const Lobby& lobby, const std::string& name) {
  auto rooms = lobby.rooms();
  if (!name.empty()) std::erase_if(rooms, [&name](const auto& room) { return room->name() != name; });
  return rooms;
}

std::string no_such_room(const Lobby& lobby, const std::string& name) {
  std::string names;
  for (const std::string& one : lobby.names()) names += ' ' + core::printable(one);
  if (names.empty()) return refused(protocol::code::kUnknownRoom, "there is no room; `open` makes one");
  return refused(protocol::code::kUnknownRoom,
                 fmt::format("no room \"{}\"; there are:{}", core::printable(name), names));
}

RoomControl::RoomControl(const Strand& strand, Lobby& lobby, RoomOpener& opener, Companions& companions,
                         const LiveLimits& limits, ServeConfig config, Counts counts,
                         std::shared_ptr<spdlog::logger> log)
    : strand_(strand),
      lobby_(lobby),
      opener_(opener),
      companions_(companions),
      limits_(limits),
      config_(std::move(config)),
      counts_(std::move(counts)),
      log_(std::move(log)) {
  assert(counts_.open && counts_.closed);
}

void RoomControl::end() {
  if (!slow_) return;
  slow_->stop();
  slow_->join();
}

void RoomControl::open(const Command& command, Answered answered) {
  ServeConfig config = config_;
  config.maps = {command.file};
  config.fork.reset();
  config.rotate.reset();
  const std::uint64_t seed = config.seed ? *config.seed + kMaxRooms + opened_++ : fresh_seed();
  asio::post(*slow_, [this, config, seed, name = command.name, answered = std::move(answered)] {
    try {
      make_rooms(config, seed, name, answered);
    } catch (const std::system_error& error) {  // of what no error can be returned from: a thread
      answered(refused(admin_code::kFailed, error.what()));
    }
  });
}

/// On the slow thread.
void RoomControl::make_rooms(const ServeConfig& config, std::uint64_t seed, const std::string& name,
                             const Answered& answered) {
  const auto fail = [&answered](const core::Error& error) {
    answered(refused(admin_code::kFailed, error.text()));
  };
  auto games = choose_games(config);
  if (!games) return fail(games.error());
  Made rooms;
  share_maps(*games, maps_);
  for (const ChosenGame& game : *games) {
    const std::string room = name.empty() ? game.room : room_name(name, game.mode);
    if (room.size() > protocol::kMaxRoomBytes || protocol::clean_text(room, room.size()) != room)
      return fail({"open", "a room's name has at most 80 bytes, all of them to be seen", "--name NAME"});
    if (!chosen_rooms(lobby_, room).empty())
      return answered(refused(admin_code::kNotNow,
                              fmt::format("there is a room \"{}\" already: --name NAME gives another one",
                                          core::printable(room))));
    auto made = opener_.make(config, room, start_of(game, config, seed + rooms.size()));
    if (!made) return fail(made.error());
    rooms.push_back(std::move(*made));
  }
  const std::lock_guard lock(made_mutex_);
  const auto made = made_.insert(made_.end(), std::move(rooms));
  asio::post(strand_, [this, made, answered] {
    std::list<Made> taken;
    {
      const std::lock_guard again(made_mutex_);
      taken.splice(taken.end(), made_, made);
    }
    open_made(taken.front(), answered);
  });
}

void RoomControl::open_made(const Made& rooms, const Answered& answered) {
  if (lobby_.rooms().size() + rooms.size() > kMaxRooms)
    return answered(refused(admin_code::kNotNow, fmt::format("there are at most {} rooms", kMaxRooms)));
  std::string text;
  std::vector<std::string> names;
  for (const auto& room : rooms) {
    const std::string name = room->name();
    room->use(*limits_.now());  // which may be others than when it was made
    if (!counts_.open(room))
      return answered(refused(admin_code::kNotNow,
                              fmt::format("{}{}room {} was not opened: one of its name came first, the "
                                          "cluster's rooms are another host's, or the server stops",
                                          text, text.empty() ? "" : "\n", core::printable(name))));
    log_event(*log_, LogEvent::kOperator, fmt::format("admin: opened room {}", name));
    text += fmt::format("{}room {} is open", text.empty() ? "" : "\n", core::printable(name));
    names.push_back(name);
  }
  answered(done(text, [&names](json::ObjectText& object) {
    object.array("rooms", names,
                 [](std::string& out, const std::string& name) { json::append_string(out, name); });
  }));
}

void RoomControl::close(const Command& command, const Answered& answered) {
  const protocol::Bye bye{std::string(protocol::code::kShutdown), "the operator has closed the room", false};
  const std::string name = command.room;
  const bool is_closing = lobby_.close(name, bye, "closed by its operator", [this, name, answered] {
    asio::post(strand_, [this, name, answered] {
      counts_.closed(name);
      companions_.forget(name);
      log_event(*log_, LogEvent::kRoomClosed, fmt::format("admin: closed room {}", name));
      answered(done(fmt::format("room {} is closed", core::printable(name))));
    });
  });
  if (!is_closing) answered(no_such_room(lobby_, name));
}

void RoomControl::order(const Command& command, const std::string& done_text, const Give& give,
                        Answered answered) {
  const auto rooms = chosen_rooms(lobby_, command.room);
  if (rooms.empty()) return answered(no_such_room(lobby_, command.room));
  const auto outcomes = std::make_shared<Outcomes>();
  outcomes->missing = rooms.size();
  for (const auto& room : rooms) outcomes->all.push_back({room->name(), 0});
  for (std::size_t k = 0; k < rooms.size(); ++k)
    give(*rooms[k], [outcomes, k, done_text, answered](core::Expected<std::uint64_t> tick) {
      {
        const std::lock_guard lock(outcomes->mutex);
        outcomes->all[k].tick = std::move(tick);
        if (--outcomes->missing != 0) return;
      }
      answered(answer_of(outcomes->all, done_text));
    });
}

void RoomControl::pause(const Command& command, Answered answered) {
  order(
      command, "paused", [](Room& room, Room::Ordered done) { room.pause(std::move(done)); },
      std::move(answered));
}

void RoomControl::resume(const Command& command, Answered answered) {
  order(
      command, "goes on", [](Room& room, Room::Ordered done) { room.resume(std::move(done)); },
      std::move(answered));
}

void RoomControl::step(const Command& command, Answered answered) {
  order(
      command, "stands still again",
      [ticks = command.ticks](Room& room, Room::Ordered done) { room.step(ticks, std::move(done)); },
      std::move(answered));
}

void RoomControl::record(const Command& command, Answered answered) {
  if (!companions_.has_recordings())
    return answered(refused(admin_code::kNotNow,
                            "this server records nothing: start it with --record, which says where to"));
  if (command.on)
    return order(
        command, "is recorded",
        [this](Room& room, Room::Ordered done) { begin_recording(room, std::move(done)); },
        std::move(answered));
  order(
      command, "is no longer recorded",
      [this](Room& room, Room::Ordered done) {
        companions_.do_not_record(room.name());
        room.end_recording("ended by the operator", std::move(done));
      },
      std::move(answered));
}

/// The room says what it plays; the file is made beside it; the room begins to write.
void RoomControl::begin_recording(Room& room, Room::Ordered answered) {
  if (room.is_recorded()) return answered(core::fail({}, "is recorded already"));
  room.ask_header(kServerName, [this, room = room.weak_from_this(), answered = std::move(answered)](
                                   replay::Header header, std::uint64_t game) {
    asio::post(*slow_, [this, room, header = std::move(header), game, answered] {
      const auto self = room.lock();
      if (!self) return answered(core::fail({}, "the room has closed"));
      try {
        auto recorder = companions_.record(self->name(), header);
        if (!recorder) return answered(tl::unexpected(recorder.error()));
        self->record(std::move(*recorder), game, answered);
      } catch (const std::system_error& error) {  // a thread, again
        answered(core::fail({}, error.what()));
      }
    });
  });
}

}  // namespace woodlouse::server
