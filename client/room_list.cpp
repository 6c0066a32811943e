#include "client/room_list.h"

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <variant>
#include <vector>

#include "client/net/unreachable.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/framing.h"

namespace woodlouse::client {
namespace {

constexpr std::chrono::seconds kAnswersWithin{5};
constexpr std::size_t kMostLine = 1u << 20;

using Row = std::array<std::string, 7>;

/// Characters, each of which is taken for a column.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

Closing closing_of(const boost::asio::ip::tcp::iostream& stream, Reached reached) {
  const auto error = stream.error();
  if (error == boost::asio::error::connection_refused) return {kConnectionRefused, {}, {}, reached};
  if (error == boost::asio::error::timed_out || error == boost::asio::error::operation_aborted)
    return {"no answer for " + std::to_string(kAnswersWithin.count()) + " s", {}, {}, reached};
  return {error ? error.message() : "the connection was closed", {}, {}, reached};
}

}  // namespace

std::string table_of(const protocol::Rooms& rooms) {
  std::vector<Row> rows = {{"room", "map", "players", "bots", "spectators", "code", "where"}};
  for (const protocol::RoomEntry& room : rooms.rooms)
    rows.push_back({room.name, room.map, std::to_string(room.players), std::to_string(room.bots),
                    std::to_string(room.spectators), room.code,
                    room.address.empty() ? "here" : room.address});
  std::array<std::size_t, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      assert(widths[k] >= width_of(row[k]));
      const bool is_number = k >= 2 && k <= 4;
      const std::string gap(widths[k] - width_of(row[k]), ' ');
      const bool is_last = k + 1 == row.size();
      text += is_number ? gap + row[k] + "  " : row[k] + (is_last ? "\n" : gap + "  ");
    }
  }
  return text;
}

core::Expected<protocol::Rooms> ask_for_rooms(const Address& server) {
  boost::asio::ip::tcp::iostream stream;
  stream.expires_after(kAnswersWithin);
  stream.connect(server.host, std::to_string(server.port));
  if (!stream) return tl::unexpected(why_not_joined(server, closing_of(stream, Reached::kName)));
  protocol::LineFramer framer(kMostLine);
  Reached reached = Reached::kHost;
  std::array<char, 4096> bytes{};
  while (stream.peek() != std::char_traits<char>::eof()) {
    framer.append({bytes.data(), static_cast<std::size_t>(stream.readsome(bytes.data(), bytes.size()))});
    while (const auto line = framer.next()) {
      const auto message = protocol::decode_server(line->text, {}, protocol::Format::kQuantized);
      if (!message) continue;  // of a newer server
      if (const auto* rooms = std::get_if<protocol::Rooms>(&*message)) return *rooms;
      if (const auto* error = std::get_if<protocol::ErrorMessage>(&*message))
        return tl::unexpected(
            why_not_joined(server, {error->text, error->code, {}, Reached::kServer, error->address}));
      if (!std::holds_alternative<protocol::Hello>(*message)) continue;
      reached = Reached::kServer;
      stream << protocol::encode(protocol::List{}) << std::flush;
    }
  }
  return tl::unexpected(why_not_joined(server, closing_of(stream, reached)));
}

}  // namespace woodlouse::client
