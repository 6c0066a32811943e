#include "server/commands/inspect.h"

#include <cmath>
#include <ostream>

#include "server/commands/error_report.h"
#include "shared/core/joined.h"
#include "shared/json/text.h"
#include "shared/replay/inspect.h"
#include "shared/replay/source_file.h"

namespace woodlouse::server {
namespace {

int report(const core::Error& error, std::ostream& errors) {
  errors << error.text() << '\n';
  return 1;
}

}  // namespace

int inspect_command(const InspectRequest& request, std::ostream& out, std::ostream& errors) {
  const auto archive = replay::ReplayArchive::open(replay::source_of_file(request.file, request.maps));
  if (!archive) return report(archive.error(), errors);
  const bool wants_state = request.tick || request.seconds;
  if (request.summary || (!wants_state && !request.rulings && !request.error)) {
    const core::Expected<std::string> summary = replay::inspect_summary(**archive);
    if (!summary) return report(summary.error(), errors);
    out << *summary;
  }
  if (request.rulings) {
    const auto told =
        replay::inspect_rulings(**archive, [&](const std::string& ruling) { out << ruling << '\n'; });
    if (!told) return report(told.error(), errors);
  }
  if (request.error) {
    const core::Expected<std::string> table = error_report(**archive);
    if (!table) return report(table.error(), errors);
    out << *table;
  }
  if (!wants_state) return 0;
  const double at = request.seconds.value_or(0.0) * (*archive)->header().tick_hz;
  // A little up, because 41.7 s are 2502 ticks, not 2501.999.
  const std::uint64_t tick = request.tick ? *request.tick
                             : at < 1e15  ? static_cast<std::uint64_t>(std::floor(at + 1e-6))
                                          : std::uint64_t{1} << 53;
  const core::Expected<replay::InspectedState> state = replay::inspect_state(**archive, tick);
  if (!state) return report(state.error(), errors);
  out << json::printable_json(state->json);
  if (!state->difference) return 0;
  return report({request.file.string(),
                 core::joined({"differs at tick ", std::to_string(state->difference->tick), ": ",
                               state->difference->what}),
                 "the state printed is the re-run's; ask verify"},
                errors);
}

}  // namespace woodlouse::server
