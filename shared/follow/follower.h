// Watches a room by inputs: re-runs its recording while it is written, line by line as they come over a wire,
// and proves each tick. It sees all of the game in full precision and pays for inputs, not for lice.
//
// A header begins a game, a keyframe the place to go on from; whoever fell behind is given a new one, and
// what lies between is not known. The first line that does not go as it says ends it: what is shown would be
// no longer the room's.
// No socket, no clock. Single thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "shared/core/error.h"
#include "shared/replay/format.h"
#include "shared/replay/rerun.h"
#include "shared/replay/source.h"

namespace woodlouse::follow {

/// Who is shown the game on its way, not only where a line has led it. Called within take().
class Witness {
 public:
  Witness() = default;
  Witness(const Witness&) = delete;
  Witness& operator=(const Witness&) = delete;
  virtual ~Witness() = default;

  /// A keyframe: the game goes on there, as another match than before, which is there till the call returns.
  virtual void began(const match::Match& game) = 0;
  /// A step that went as its line says; each of those, too, of which one line tells that they did nothing.
  virtual void stepped(const match::StepRecord& step, const match::Match& game) = 0;
  virtual void said(const replay::ChatLine& chat) = 0;
};

class Follower {
 public:
  /// source: names the lines in errors, as "the server's stream". witness: null: nobody. maps: those of what
  /// is followed beside this; null: none. Both outlive this.
  explicit Follower(std::string source, Witness* witness = nullptr, replay::Maps* maps = nullptr)
      : source_(std::move(source)), witness_(witness), maps_(maps) {}

  /// Whether a line from the wire is one of a recording: it has no `type`.
  [[nodiscard]] static bool is_recorded(std::string_view line) { return !line.starts_with(R"({"type":)"); }

  /// The next line, without its newline. False: it differs, and every further line is passed over.
  bool take(std::string_view line);
  /// Another session begins: nothing is known any more, but the count of what was proven stays.
  void begin_anew();

  /// The game as the lines have led it; null before a keyframe, and once it differs. Its map is the header's.
  [[nodiscard]] const match::Match* match() const { return rerun_ ? &rerun_->match() : nullptr; }
  /// Steps re-run so far whose hash was that of the line.
  [[nodiscard]] std::uint64_t proven() const { return proven_; }
  /// How often it went on from a new keyframe in a game.
  [[nodiscard]] std::uint64_t gaps() const { return gaps_; }
  /// The tick at which what comes differs from the re-run, or can't be one of its lines, and how.
  [[nodiscard]] const std::optional<replay::Difference>& difference() const { return difference_; }

 private:
  core::Expected<void> begin(std::string_view line);
  core::Expected<void> follow(replay::Line line);
  core::Expected<void> go_on(replay::Keyframe keyframe);
  core::Expected<void> step(replay::StepLine line);
  void differ(std::uint64_t tick, std::string what);

  std::string source_;
  Witness* witness_;
  replay::Maps* maps_;
  std::size_t lines_ = 0;
  std::optional<match::MatchSettings> settings_;
  std::shared_ptr<const map::Map> map_;
  std::unique_ptr<replay::Rerun> rerun_;
  std::uint64_t proven_ = 0;
  std::uint64_t gaps_ = 0;
  std::optional<replay::Difference> difference_;
};

}  // namespace woodlouse::follow
