#include <iostream>

#include "bench/swarm/options.h"
#include "bench/swarm/report.h"
#include "bench/swarm/swarm.h"

int main(int argc, char** argv) {
  using namespace woodlouse::swarm;
  const auto parsed = parse_options(argc, argv);
  if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
  const Options& options = std::get<Options>(parsed);
  Swarm swarm(options);
  const auto seconds = swarm.run();
  if (!seconds) {
    std::cerr << "woodlouse-swarm: " << seconds.error().where << ": " << seconds.error().what << "\n"
              << "try: " << seconds.error().hint << "\n";
    return 69;
  }
  return print_report(std::cout, options, swarm, seconds->count()) ? 0 : 1;
}
