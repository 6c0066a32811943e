// woodlouse-scenario: matches from scripts, their hashes compared; with --table, the proof that builds agree.
#include <iostream>

#include "bench/scenario/session.h"
#include "shared/core/allocation.h"

int main(int argc, char** argv) {
  using namespace woodlouse::scenario;
  woodlouse::core::end_when_out_of_memory("woodlouse-scenario: out of memory\n");
  const auto parsed = parse_options(argc, argv);
  if (const int* exit_code = std::get_if<int>(&parsed)) return *exit_code;
  return static_cast<int>(Session(std::get<Options>(parsed), std::cout, std::cerr).run());
}
