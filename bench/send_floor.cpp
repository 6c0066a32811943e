// What a bare loop of send() costs: the floor under what a server takes for each frame that it sends.
//
//     woodlouse-send-floor --listen 127.0.0.1:7779 --clients 200 --bytes 5200 --hz 20 --seconds 20
//     woodlouse-swarm --raw --bots 200 --seconds 60 127.0.0.1:7779
#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "bench/option_failure.h"
#include "bench/swarm/cpu_time.h"
#include "bench/swarm/servers.h"

namespace {

using Clock = std::chrono::steady_clock;
using woodlouse::swarm::cpu_seconds;

struct Options {
  std::string listen = "127.0.0.1:7779";
  std::size_t clients = 200;
  std::size_t bytes = 5000;
  double hz = 20.0;
  double seconds = 10.0;
};

int fail(const std::string& what) {
  std::cerr << "woodlouse-send-floor: " << what << ": " << std::strerror(errno) << "\n";
  return 69;
}

/// The listening socket, or -1.
int listen_at(const std::string& where) {
  const std::size_t colon = std::min(where.rfind(':'), where.size());
  const std::string host = where.substr(0, colon), port = where.substr(std::min(colon + 1, where.size()));
  std::uint16_t number = 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
  address.sin_port = htons(number);
  if (error != std::errc{} || end != port.data() + port.size() ||
      inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) {
    errno = EINVAL;
    return -1;
  }
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  const int yes = 1;
  if (socket < 0 || setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(socket, SOMAXCONN) != 0)
    return -1;
  socklen_t size = sizeof address;
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  std::cout << "listening " << host << ":" << ntohs(address.sin_port) << std::endl;
  return socket;
}

std::vector<int> accept_all(int listening, std::size_t clients) {
  std::vector<int> sockets;
  const int yes = 1;
  while (sockets.size() < clients) {
    const int socket = accept4(listening, nullptr, nullptr, SOCK_NONBLOCK);
    if (socket < 0) return sockets;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    sockets.push_back(socket);
  }
  return sockets;
}

void send_to_all(const std::vector<int>& sockets, const Options& options) {
  const std::string buffer(options.bytes, 'x');
  std::uint64_t sends = 0, whole = 0;
  const auto begin = Clock::now();
  const double cpu_before = cpu_seconds();
  const auto rounds = static_cast<std::uint64_t>(options.hz * options.seconds);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const std::chrono::duration<double> due(static_cast<double>(round) / options.hz);
    std::this_thread::sleep_until(begin + std::chrono::duration_cast<Clock::duration>(due));
    for (const int socket : sockets) {
      const ssize_t sent = send(socket, buffer.data(), buffer.size(), MSG_NOSIGNAL);
      ++sends;
      if (sent == static_cast<ssize_t>(buffer.size())) ++whole;
    }
  }
  const double cpu = cpu_seconds() - cpu_before;
  const std::chrono::duration<double> took = Clock::now() - begin;
  std::cout << sockets.size() << " clients, " << options.bytes << " bytes, " << options.hz << " Hz, "
            << took.count() << " s: " << sends << " sends, " << sends - whole << " not whole, "
            << 1e6 * cpu / static_cast<double>(sends) << " us a send" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Sends the same bytes to each of its clients in a bare loop, and says what a send costs.");
  app.add_option("--listen", options.listen, "HOST:PORT, an IPv4 address; port 0: any, printed")
      ->capture_default_str();
  app.add_option("--clients", options.clients, "that it waits for")
      ->check(CLI::Range(std::size_t{1}, std::size_t{20000}))
      ->capture_default_str();
  app.add_option("--bytes", options.bytes, "of a send")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 20))
      ->capture_default_str();
  app.add_option("--hz", options.hz, "sends a second to each")
      ->check(CLI::Range(0.1, 10000.0))
      ->capture_default_str();
  app.add_option("--seconds", options.seconds, "once all are there")
      ->check(CLI::Range(0.1, 86400.0))
      ->capture_default_str();
  app.failure_message(woodlouse::bench::option_failure);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  woodlouse::swarm::raise_descriptor_limit();
  const int listening = listen_at(options.listen);
  if (listening < 0) return fail("cannot listen on " + options.listen);
  const std::vector<int> sockets = accept_all(listening, options.clients);
  if (sockets.size() < options.clients) return fail("accept");
  send_to_all(sockets, options);
  for (const int socket : sockets) close(socket);
  close(listening);
  return 0;
}
