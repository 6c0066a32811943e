// Re-runs a recording through the same match code and compares: the proof that a game was played as recorded.
//
// From keyframe to keyframe: the match is restored, the recorded roster changes and inputs are applied step
// by step, and of every step are demanded the same changes and inputs in the same order and the same state
// hash; of the next keyframe, the same bits. So a keyframe that a stretch begins with is one that the stretch
// before led to. After the first difference the re-run goes on to the next keyframe, to say which louse,
// which field and by how much.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "shared/core/error.h"
#include "shared/replay/rerun.h"
#include "shared/replay/source.h"

namespace woodlouse::replay {

struct Verification {
  std::uint64_t ticks = 0;  ///< steps re-run up to the end, or to where the first difference showed
  bool cut_off = false;     ///< the recording has no end line: the server did not finish it
  std::optional<Difference> difference;  ///< empty: the same bits throughout
  [[nodiscard]] bool ok() const { return !difference.has_value(); }
};

/// Re-runs a recording from its first line to its last; the index plays no part. `source` names it in errors;
/// a map that it only names is looked for in `folder`, then under the path it was recorded with. Errors: a
/// file that is no recording, of another version or behavior, or damaged before its last line.
core::Expected<Verification> verify(std::istream& in, const std::string& source,
                                    const std::filesystem::path& folder);

/// The same verdict, with the stretches between keyframes checked by `jobs` threads at once. An index that
/// does not lead from each stretch to the next is not trusted: then the recording is read through.
core::Expected<Verification> verify(const ReplaySource& source, unsigned jobs);

/// One or two lines for people, newline included: `ok N ticks`, or where and how it differs.
std::string to_text(const Verification& verification);

/// `woodlouse-server verify FILE...`: prints the verdicts to `out`, of several files each under its name;
/// 0 all the same, 1 one different or unreadable.
int verify_command(const std::vector<std::filesystem::path>& files, unsigned jobs, std::ostream& out);

}  // namespace woodlouse::replay
