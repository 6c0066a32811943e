#include <iostream>

#include "bench/swarm/crowd_report.h"
#include "bench/swarm/options.h"
#include "bench/swarm/raw.h"
#include "bench/swarm/report.h"
#include "bench/swarm/servers.h"
#include "bench/swarm/swarm.h"

namespace {

int tell(const woodlouse::core::Error& error) {
  std::cerr << "woodlouse-swarm: " << error.where << ": " << error.what << "\n"
            << "try: " << error.hint << "\n";
  return 69;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace woodlouse::swarm;
  const auto parsed = parse_options(argc, argv);
  if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
  const Options& options = std::get<Options>(parsed);
  raise_descriptor_limit();
  if (options.raw) {
    const auto counted = count_raw_bytes(std::cout, options);
    return counted ? 0 : tell(counted.error());
  }
  Swarm swarm(options);
  const auto seconds = swarm.run();
  if (!seconds) return tell(seconds.error());
  const auto print = options.is_crowd ? print_crowd_report : print_report;
  return print(std::cout, options, swarm, seconds->count()) ? 0 : 1;
}
