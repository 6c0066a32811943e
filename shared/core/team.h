// Who helps with work that falls into parts which do not ask for each other's results. The work says what it
// shares; whoever does a part, the result is the same.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <functional>

namespace woodlouse::core {

/// For how little work a member is asked.
enum class Cut {
  kWorthIt,  ///< as little as pays, which the work says
  kFinest,   ///< one item: for proofs that the cut does not show
};

class Team {
 public:
  using Work = std::function<void(std::size_t part)>;
  /// Parts for each member that is asked: who comes late leaves some to the others.
  static constexpr std::size_t kPartsEach = 4;

  /// size: how many work at once, the caller among them; >= 1.
  Team(std::size_t size, Cut cut) : size_(size), cut_(cut) { assert(size >= 1); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  virtual ~Team() = default;

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Into how many parts to cut so many items, where a member is worth asking for `least` of them, >= 1. One
  /// part: it is not worth it.
  [[nodiscard]] std::size_t parts(std::size_t items, std::size_t least) const {
    const std::size_t members = std::min(size_, items / (cut_ == Cut::kFinest ? 1 : least));
    return members < 2 ? 1 : std::min(items, kPartsEach * members);
  }
  /// How many members so many parts are work for.
  [[nodiscard]] std::size_t members(std::size_t parts) const {
    return std::min(size_, std::max(std::min<std::size_t>(parts, 2), parts / kPartsEach));
  }
  /// Any thread. Calls work(0) to work(parts - 1), once each, in any order and several at once; all are done
  /// when it returns. What was written before is seen in them, and what they wrote after. False, and nothing
  /// is called, where the team is at another's work. REQUIRES work that neither throws nor runs this team.
  [[nodiscard]] virtual bool try_run(std::size_t parts, const Work& work) = 0;

 private:
  std::size_t size_;
  Cut cut_;
};

/// Into how many parts to cut for a team; one for none (null).
inline std::size_t parts_for(const Team* team, std::size_t items, std::size_t least) {
  return team == nullptr ? 1 : team->parts(items, least);
}

/// The work by the team where there is one and it is free, else here, one part after the other.
template <typename F>
void run_parts(Team* team, std::size_t parts, const F& work) {
  if (team != nullptr && parts > 1 && team->try_run(parts, std::cref(work))) return;
  for (std::size_t part = 0; part < parts; ++part) work(part);
}

}  // namespace woodlouse::core
