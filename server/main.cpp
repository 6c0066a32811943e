// woodlouse-server: parses, wires, runs.
#include <fcntl.h>
#include <openssl/crypto.h>
#include <unistd.h>

#include <boost/system/system_error.hpp>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>
#include <variant>

#include "server/cluster/cluster_command.h"
#include "server/commands/admin.h"
#include "server/commands/check.h"
#include "server/commands/inspect.h"
#include "server/commands/make_map.h"
#include "server/commands/records.h"
#include "server/commands/verify.h"
#include "server/config.h"
#include "server/log.h"
#include "server/server.h"
#include "server/signals.h"
#include "shared/core/allocation.h"

namespace {

namespace core = woodlouse::core;
using namespace woodlouse::server;

/// First of all: what other files make before main begins needs memory, too.
[[gnu::constructor(101)]] void prepare_for_no_memory() {
  core::end_when_out_of_memory("woodlouse-server: out of memory\n");
}

constexpr int kOk = 0;
constexpr int kFailed = 1;
constexpr int kUsage = 2;

int report(const core::Error& error, int exit_code) {
  std::cerr << "woodlouse-server: " << (error.where.empty() ? "" : error.where + ": ") << error.what << '\n';
  if (!error.hint.empty()) std::cerr << "      " << error.hint << '\n';
  return exit_code;
}

/// Of what was printed for somebody: an answer that got lost is none.
int printed(int exit_code) {
  if (std::cout.flush()) return exit_code;
  return report({"standard output", "can't be written", ""}, kFailed);
}

int run(const PrintConfig& config) {
  std::cout << config.text;
  return printed(kOk);
}

int run(const CheckConfig& config) { return printed(check_command(config.maps, config.summary, std::cout)); }
int run(const MakeMapConfig& config) { return printed(make_map_command(config.request, std::cout)); }
int run(const VerifyConfig& config) { return printed(verify_command(config.request, std::cout)); }
int run(const RecordsConfig& config) { return printed(records_command(config.request, std::cout)); }
int run(const ClusterConfig& config) { return printed(cluster_command(config.errand, std::cout, std::cerr)); }
int run(const AdminConfig& config) { return printed(admin_command(config.errand, std::cout, std::cerr)); }
int run(const InspectConfig& config) {
  return printed(inspect_command(config.request, std::cout, std::cerr));
}

/// While maps are loaded, or a recording to go on from: nothing is begun yet, and whoever stops the server
/// need not wait for it. Once rooms open, Server takes the signals over.
void end_when_signalled() {
  constexpr auto kEnd = [](int) { std::_Exit(kOk); };
  for (const int signal : taken_signals()) std::signal(signal, kEnd);
}

int run(const ServeConfig& config, const std::function<core::Expected<ServeConfig>()>& reread) {
  end_when_signalled();
  std::optional<KeptSignals> kept;  // until the log is written
  auto opened = config.log_file
                    ? Log::open(config.log_format, *config.log_file)
                    : core::Expected<std::unique_ptr<Log>>(std::make_unique<Log>(config.log_format));
  if (!opened) return report(opened.error(), kFailed);
  const Log& log = **opened;
  log.logger()->set_level(spdlog::level::from_str(config.log_level));
  auto server = Server::create(
      config, {reread, [&log] { log.reopen(); }, [&log] { return log.lost_lines(); }}, log.logger());
  if (!server) return report(server.error(), kFailed);
  kept.emplace(taken_signals());
  std::cout << "listening " << (*server)->address() << std::endl;
  if (!(*server)->web_url().empty()) std::cout << "web " << (*server)->web_url() << std::endl;
  if (!(*server)->admin_address().empty()) std::cout << "admin " << (*server)->admin_address() << std::endl;
  (*server)->run();
  (*server)->print_summary(std::cout);
  return printed((*server)->lost_recordings().empty() && (*server)->lost_records().empty() ? kOk : kFailed);
}

/// Where one of the three is closed, the next file opened would take its place, and what is printed go there.
void open_standard_descriptors() {
  int opened = 0;
  do {
    opened = ::open("/dev/null", O_RDWR);
  } while (opened >= 0 && opened <= STDERR_FILENO);
  if (opened >= 0) ::close(opened);
}

}  // namespace

int main(int argc, char** argv) {
  open_standard_descriptors();
  // A closed pipe behind standard output or error is no reason to end a game, nor is a recording that grows
  // past what its user may write: then writing fails.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // Else OpenSSL frees at exit what threads of libnats, which outlast its connections, may be freeing still.
  OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, nullptr);
  const auto config = parse_config(argc, argv);
  if (!config) return report(config.error(), kUsage);
  const auto reread = [argc, argv]() -> woodlouse::core::Expected<ServeConfig> {
    auto again = parse_config(argc, argv);
    if (!again) return tl::unexpected(again.error());
    return std::get<ServeConfig>(std::move(*again));
  };
  try {
    return std::visit(
        [&reread](const auto& chosen) {
          if constexpr (std::is_same_v<std::decay_t<decltype(chosen)>, ServeConfig>)
            return run(chosen, reread);
          else
            return run(chosen);
        },
        *config);
  } catch (const std::system_error& error) {  // of what no error can be returned from: a thread
    return report({"", error.what(), "has the system no more threads for it?"}, kFailed);
  } catch (const boost::system::system_error& error) {  // asio's own descriptors
    return report({"", error.what(), "has the system no more descriptors for it?   see  ulimit -n"}, kFailed);
  }
}
