#include "bench/swarm/raw.h"

#include <cstdio>
#include <memory>
#include <ostream>
#include <vector>

#include "bench/swarm/connection.h"
#include "bench/swarm/cpu_time.h"
#include "bench/swarm/profile.h"
#include "bench/swarm/servers.h"

namespace woodlouse::swarm {
namespace {

using Clock = Connection::Clock;

struct Raw : ConnectionUser {
  Raw(boost::asio::io_context& context, std::size_t& open)
      : connection(context, *this, false), still_open(open) {}
  bool on_line(std::string_view, Clock::time_point) override { return true; }
  void on_lost(std::string) override { --still_open; }

  Connection connection;
  std::size_t& still_open;
};

}  // namespace

core::Expected<void> count_raw_bytes(std::ostream& out, const Options& options) {
  constexpr std::size_t kRetries = 50;
  boost::asio::io_context context(1);
  const auto servers = find_servers(context, options);
  if (!servers) return tl::unexpected(servers.error());
  std::size_t open = options.bots;
  std::vector<std::unique_ptr<Raw>> all;
  for (std::size_t i = 0; i < options.bots; ++i) {
    all.push_back(std::make_unique<Raw>(context, open));
    Route route{*servers, {}, false, kRetries};
    if (options.addresses != 0) route.from = loopback(i % options.addresses);
    all.back()->connection.open(route);
  }
  const auto begin = Clock::now();
  const auto deadline =
      begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options.seconds));
  const double cpu_before = cpu_seconds();
  while (open != 0 && Clock::now() < deadline) context.run_for(std::chrono::milliseconds(20));
  const std::chrono::duration<double> measured = Clock::now() - begin;
  std::uint64_t bytes = 0;
  for (const auto& raw : all) {
    bytes += raw->connection.received();
    raw->connection.close();
  }
  char line[200];
  std::snprintf(line, sizeof line,
                "raw: %zu connections, %.0f bytes in %.2f s, %.2f MB/s; own CPU %.0f %% of a core\n",
                all.size(), static_cast<double>(bytes), measured.count(),
                1e-6 * static_cast<double>(bytes) / measured.count(),
                100.0 * (cpu_seconds() - cpu_before) / measured.count());
  out << line;
  return {};
}

}  // namespace woodlouse::swarm
