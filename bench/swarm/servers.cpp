#include "bench/swarm/servers.h"

#include <sys/resource.h>

namespace woodlouse::swarm {

using boost::asio::ip::tcp;

core::Expected<std::vector<tcp::endpoint>> find_servers(boost::asio::io_context& context,
                                                        const Options& options) {
  boost::system::error_code error;
  tcp::resolver resolver(context);
  const auto found = resolver.resolve(options.host, options.port, error);
  if (error) return core::fail(options.host + ":" + options.port, error.message(), "check the address");
  std::vector<tcp::endpoint> servers;
  for (const auto& entry : found) servers.push_back(entry.endpoint());
  return servers;
}

void raise_descriptor_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);  // where it does not work, connects say so
}

}  // namespace woodlouse::swarm
