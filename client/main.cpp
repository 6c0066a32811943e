// The terminal client: parse, run.
#include <exception>
#include <iostream>
#include <new>

#include "client/config.h"
#include "client/startup.h"
#include "client/terminal/outcome.h"

int main(int argc, char** argv) {
  using namespace woodlouse::client;
  const Parsed parsed = parse_arguments(argc, argv);
  if (parsed.exit_code) {
    (*parsed.exit_code == kExitFine ? std::cout : std::cerr) << parsed.output;
    return *parsed.exit_code;
  }
  try {
    return run_client(parsed.config);
  } catch (const std::bad_alloc&) {
    std::cerr << "woodlouse: out of memory\n";
    return kExitIo;
  } catch (const std::exception& error) {  // the terminal is restored on the way here
    std::cerr << "woodlouse: " << error.what() << "\n      this is a bug; please report it\n";
    return kExitIo;
  }
}
