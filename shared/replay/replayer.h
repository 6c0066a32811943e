// Re-runs a recording through the same match code and compares: the proof that a game was played as recorded.
//
// The re-run applies the recorded roster changes and inputs step by step and demands, of every step, the same
// changes and inputs in the same order and the same state hash; of every keyframe, the same bits. After the
// first difference it goes on to the next keyframe, to say which louse, which field and by how much.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "shared/core/error.h"

namespace woodlouse::replay {

/// Where a recording and its re-run part.
struct Difference {
  std::uint64_t tick = 0;  ///< the first tick whose state, or the step whose inputs, differ
  std::string what;        ///< the hashes, or the roster change or input that was applied otherwise
  std::string detail;      ///< from the next keyframe: louse, field, both values; or why it says nothing
};

struct Verification {
  std::uint64_t ticks = 0;               ///< steps re-run
  bool cut_off = false;                  ///< the recording has no end line: the server did not finish it
  std::optional<Difference> difference;  ///< empty: the same bits throughout
  [[nodiscard]] bool ok() const { return !difference.has_value(); }
};

/// Re-runs a recording. `source` names it in errors; a map that it only names is looked for in `folder`, then
/// under the path it was recorded with. Errors: a file that is no recording, of another version or behavior,
/// or damaged before its last line.
core::Expected<Verification> verify(std::istream& in, const std::string& source,
                                    const std::filesystem::path& folder);

/// One or two lines for people, newline included: `ok N ticks`, or where and how it differs.
std::string to_text(const Verification& verification);

/// `woodlouse-server verify FILE`: prints the verdict to `out`; 0 the same, 1 different or unreadable.
int verify_command(const std::filesystem::path& file, std::ostream& out);

}  // namespace woodlouse::replay
