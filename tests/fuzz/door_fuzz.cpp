// What comes to the doors before a session: HTTP on the web port, over a socket as in the server; the PROXY
// header; the operator's lines and requests; addresses and lists of them.
//
// Input: a byte that says to which of them, then what is said.
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/access/address_range.h"
#include "server/admin/admin_request.h"
#include "server/admin/command.h"
#include "server/net/http_door.h"
#include "server/proxies/proxy_header.h"
#include "server/proxies/trusted_proxies.h"
#include "tests/fuzz/property.h"
#include "tests/server/timing/manual_timekeeper.h"

namespace {

namespace asio = boost::asio;
namespace server = woodlouse::server;
namespace protocol = woodlouse::protocol;
using woodlouse::fuzz::demand;
using woodlouse::fuzz::demand_readable;

/// Nobody wants to read this again: the dictionary has it, and no page of the server.
constexpr std::string_view kWord = "marzipan";

class NoRooms final : public server::Directory {
 public:
  [[nodiscard]] std::shared_ptr<server::Door> find(std::string_view) const override { return nullptr; }
  [[nodiscard]] std::vector<std::string> names() const override { return {"volcano"}; }
  [[nodiscard]] protocol::Rooms list() const override {
    return protocol::Rooms{{{"volcano", "volcano", 1, 2, 3}}};
  }
  [[nodiscard]] std::string_view why_not_ready(server::Time) const override { return {}; }
  [[nodiscard]] std::uint64_t changes() const override { return 0; }
};

/// A web port with one connection, whose other end the input is written to.
struct WebPort {
  asio::io_context io{1};
  server::ManualTimekeeper timekeeper;
  protocol::Limits limits;
  server::LiveLimits live_limits{limits};
  server::TrafficMetrics traffic;
  NoRooms directory;
  server::SessionEnvironment environment{directory,  live_limits, traffic,
                                         timekeeper, "woodlouse", std::make_shared<spdlog::logger>("fuzz")};
  server::WebEnvironment web{{{"lice.example.org"}, {}}, 7777};
  std::shared_ptr<server::AddressAccount> account =
      std::make_shared<server::AddressAccount>(7, "127.0.0.1", limits, timekeeper.now());
};

/// All that it answers, by when it has read everything and the client has ended.
std::string answers_to(std::string_view said, int& upgraded) {
  WebPort port;
  std::array<int, 2> ends{};
  demand(socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0, "a pair of sockets");
  demand(fcntl(ends[1], F_SETFL, O_NONBLOCK) == 0, "a socket that does not wait");
  asio::ip::tcp::socket near(port.io);
  near.assign(asio::ip::tcp::v4(), ends[0]);
  int closed = 0;
  const auto door =
      server::make_http_door(std::move(near), port.environment, port.web, {port.account, {}},
                             {[&] { ++closed; }, [&](std::unique_ptr<server::Wire>) { ++upgraded; }, {}});
  door->start();
  std::string answers;
  const auto read_all = [&] {
    std::array<char, 4096> part{};
    for (ssize_t size; (size = read(ends[1], part.data(), part.size())) > 0;)
      answers.append(part.data(), static_cast<std::size_t>(size));
  };
  while (!said.empty() && closed + upgraded == 0) {
    const ssize_t sent = send(ends[1], said.data(), std::min<std::size_t>(said.size(), 2000), MSG_NOSIGNAL);
    if (sent <= 0) break;
    said.remove_prefix(static_cast<std::size_t>(sent));
    port.io.restart();
    port.io.poll();
    read_all();
  }
  shutdown(ends[1], SHUT_WR);
  for (int k = 0; k < 100 && closed + upgraded == 0; ++k) {
    port.io.restart();
    port.io.poll();
    read_all();
    if (k > 2) port.timekeeper.advance(std::chrono::seconds(11));
  }
  read_all();
  close(ends[1]);
  demand(closed + upgraded == 1, "a connection ends, once");
  port.io.restart();
  port.io.poll();
  demand(port.timekeeper.pending() == 0, "nothing is waited for after the end");
  return answers;
}

void try_http(std::string_view said) {
  int upgraded = 0;
  const std::string answers = answers_to(said, upgraded);
  demand(answers.find(kWord) == std::string::npos, "nothing that was asked stands in an answer", answers);
  demand(answers.empty() || answers.starts_with("HTTP/1.1 "), "an answer is one of HTTP", answers);
  demand(upgraded == 0 || answers.find("HTTP/1.1 101 ") != std::string::npos, "who goes on was told",
         answers);
}

void try_proxy_header(std::string_view bytes) {
  using Header = server::ProxyHeader;
  const Header header = Header::read(bytes);
  if (header.verdict == Header::Verdict::kRefused) demand_readable(header.why);
  if (header.verdict != Header::Verdict::kWhole) return;
  demand(header.bytes >= 16 && header.bytes <= Header::kMostBytes && header.bytes <= bytes.size(),
         "a whole header has come");
  for (std::size_t size = 0; size < header.bytes; ++size) {
    const Header part = Header::read(bytes.substr(0, size));
    demand(part.verdict == Header::Verdict::kMore, "a part of a header waits for the rest",
           bytes.substr(0, size));
    demand(part.bytes > size && part.bytes <= header.bytes, "it says how much more, and no more than comes");
  }
  const Header again = Header::read(bytes.substr(0, header.bytes));
  demand(again.source == header.source, "what stands behind a header is none of it");
}

void try_operator(std::string_view said) {
  if (const auto request = server::read_request(said)) {
    demand(request->path.find('?') == std::string::npos, "a path has no query", request->path);
  } else {
    demand(request.error().body.find(kWord) == std::string::npos,
           "nothing that was asked stands in an answer");
  }
  const auto line = server::decode_command(said);
  if (!line) return demand_readable(line.error().text);
  std::string text = server::encode(*line);
  demand(text.ends_with('\n'), "a command is a line", text);
  text.pop_back();
  const auto again = server::decode_command(text);
  demand(again.has_value(), "a command that was written can be read", text);
  demand(server::encode(*again) == text + "\n", "and is the same", text);
}

void try_addresses(std::string_view text) {
  if (const auto range = server::AddressRange::parse(text)) {
    const auto again = server::AddressRange::parse(range->text());
    demand(again == *range, "a range of addresses that was written is the same", range->text());
    demand(range->contains(*again), "it is within itself", range->text());
  }
  if (const auto proxy = server::checked_proxy(text)) {
    const server::TrustedProxies trusted({*proxy});
    demand(trusted.contains(proxy->address), "a network has its own address", text);
  } else {
    demand_readable(proxy.error().what);
  }
  const server::TrustedProxies local({*server::checked_proxy("127.0.0.0/8")});
  if (const auto behind = local.behind(text))
    demand(!local.contains(*behind) || text.find("127.") != std::string_view::npos ||
               text.find("7f") != std::string_view::npos || text.find("7F") != std::string_view::npos,
           "who is behind is no proxy unless all are", text);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string_view said(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::array kDoors = {try_http, try_proxy_header, try_operator, try_addresses};
  kDoors[data[0] % kDoors.size()](said);
  return 0;
}
