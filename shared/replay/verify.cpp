#include "shared/replay/verify.h"

#include <memory>
#include <ostream>
#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/format.h"
#include "shared/replay/parallel_verify.h"
#include "shared/replay/recorded_map.h"
#include "shared/replay/segment.h"

namespace woodlouse::replay {

using core::joined;

core::Expected<Verification> verify(std::istream& in, const std::string& source,
                                    const std::filesystem::path& folder) {
  ReplayReader reader(in, source);
  const core::Expected<Header> header = reader.read_header();
  if (!header) return tl::unexpected(header.error());
  const auto map = load_recorded_map(*header, source, folder);
  if (!map) return tl::unexpected(map.error());
  core::Expected<std::optional<Line>> first = reader.next();
  if (!first) return tl::unexpected(first.error());
  if (!*first) return core::fail(source, "was cut off before its first keyframe");
  if (!std::holds_alternative<Keyframe>(**first)) {
    return core::fail(reader.place(), "is no keyframe", "one stands behind the header");
  }
  std::optional<Keyframe> start = std::get<Keyframe>(std::move(**first));
  Verification verification;
  bool has_end = false;
  while (start && !verification.difference) {
    core::Expected<Stretch> stretch =
        run_stretch(reader, *map, {header->tick_hz, header->seed}, *std::exchange(start, std::nullopt));
    if (!stretch) return tl::unexpected(stretch.error());
    verification.ticks += stretch->steps;
    verification.difference = std::move(stretch->difference);
    start = std::move(stretch->next);
    has_end = stretch->has_end;
  }
  verification.cut_off = !has_end && !verification.difference;
  return verification;
}

core::Expected<Verification> verify(const ReplaySource& source, unsigned jobs) {
  if (jobs > 1) {
    if (auto verification = verify_in_parallel(source, jobs)) return std::move(*verification);
  }
  const auto stream = source.open();
  if (!stream) return tl::unexpected(stream.error());
  return verify(**stream, source.name, source.folder);
}

std::string to_text(const Verification& verification) {
  const std::string ticks = std::to_string(verification.ticks);
  if (verification.ok()) {
    if (!verification.cut_off) return joined({"ok ", ticks, " ticks\n"});
    return joined({"ok ", ticks, " ticks, then the recording is cut off: it has no end line\n"});
  }
  const Difference& difference = *verification.difference;
  return joined({"differs at tick ", std::to_string(difference.tick), ": ", difference.what, "\n",
                 difference.detail, "\n"});
}

int verify_command(const std::vector<std::filesystem::path>& files, unsigned jobs, std::ostream& out) {
  int exit_code = 0;
  for (const std::filesystem::path& file : files) {
    const core::Expected<Verification> verification = verify(ReplaySource::of_file(file), jobs);
    if (verification && files.size() > 1) out << file.string() << ": ";
    out << (verification ? to_text(*verification) : verification.error().text() + "\n") << std::flush;
    if (!verification || !verification->ok()) exit_code = 1;
  }
  return exit_code;
}

}  // namespace woodlouse::replay
