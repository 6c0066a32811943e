#include "shared/replay/parallel_verify.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <deque>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "shared/core/thread_team.h"
#include "shared/replay/archive.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/segment.h"

namespace woodlouse::replay {
namespace {

/// How many rows of the index were met in the lines.
struct Met {
  std::uint64_t inputs = 0;
  std::uint64_t players = 0;
  std::uint64_t leaves = 0;
};

/// What came of one segment.
struct Finding {
  std::size_t segment = 0;
  core::Expected<Segment> result;
  bool is_as_indexed = false;  ///< it began and ended at the index's keyframes, and held what the index says
};

class Plan {
 public:
  /// `longest_line`: of each job.
  Plan(std::shared_ptr<const ReplayArchive> archive, std::size_t longest_line)
      : archive_(std::move(archive)), longest_line_(longest_line), first_bad_(places().size()) {}

  /// Takes one segment after the other until none is left that matters.
  class Job {
   public:
    explicit Job(Plan& plan) : plan_(plan) {}
    void work();

   private:
    friend class Plan;
    Finding run(std::size_t k);
    bool is_as_indexed(std::size_t k, const ReplayIndex& lines);

    Plan& plan_;
    std::unique_ptr<std::istream> stream_;
    std::optional<Finding> finding_;  ///< the first bad one, or the last segment's
    Met met_;
  };

  /// After all work: the verdict, or nothing when the index misled.
  std::optional<core::Expected<Verification>> verdict(std::deque<Job>& jobs) const;

 private:
  [[nodiscard]] const std::vector<KeyframePlace>& places() const { return archive_->index().keyframes; }

  std::shared_ptr<const ReplayArchive> archive_;
  std::size_t longest_line_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> first_bad_;  ///< no later segment matters
};

void Plan::Job::work() {
  for (;;) {
    const std::size_t k = plan_.next_.fetch_add(1);
    if (k >= plan_.places().size() || k > plan_.first_bad_.load()) return;
    Finding finding = run(k);
    if (finding.result) finding.result->next.reset();
    const bool is_good = finding.is_as_indexed && finding.result && !finding.result->difference;
    // A job's segments ascend: the first bad one it meets is the one that counts of its own.
    if (!is_good || k + 1 == plan_.places().size()) finding_ = std::move(finding);
    if (is_good) continue;
    std::size_t before = plan_.first_bad_.load();
    while (k < before && !plan_.first_bad_.compare_exchange_weak(before, k)) {
    }
    return;
  }
}

Finding Plan::Job::run(std::size_t k) {
  const ReplayArchive& archive = *plan_.archive_;
  const std::vector<KeyframePlace>& places = plan_.places();
  if (!stream_) {
    auto opened = archive.source().open();
    if (!opened) return {k, tl::unexpected(opened.error()), false};
    stream_ = std::move(*opened);
  }
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(places[k].offset));
  ReplayReader reader(*stream_, archive.source().name, places[k].line - 1, plan_.longest_line_);
  core::Expected<std::optional<Line>> line = reader.next();
  auto* keyframe = line && *line ? std::get_if<Keyframe>(&**line) : nullptr;
  if (keyframe == nullptr || keyframe->state.tick != places[k].tick) return {k, Segment{}, false};
  ReplayIndex lines;
  if (k == 0) lines.add(places[k], *keyframe);
  const Header& header = archive.header();
  core::Expected<Segment> segment =
      run_segment(reader, archive.map(), settings_of(header), std::move(*keyframe), lines);
  if (!segment) return {k, std::move(segment), !reader.wants_longer_lines()};
  const bool is_last = k + 1 == places.size();
  bool is_where_planned = !segment->next == is_last;
  if (segment->next && !is_last) {
    const KeyframePlace end{segment->next->state.tick, places[k].offset + reader.line_offset(),
                            reader.line_number()};
    is_where_planned = end == places[k + 1];
  }
  if (is_last && segment->index) {
    segment->index_offset += places[k].offset;
    is_where_planned = is_where_planned && unlike_index(*segment->index, archive.index()).empty() &&
                       segment->end && segment->end->index_offset == segment->index_offset;
  }
  return {k, std::move(segment), is_where_planned && is_as_indexed(k, lines)};
}

/// `lines`: of the segment alone. Compared at once, so that nothing of it is kept.
bool Plan::Job::is_as_indexed(std::size_t k, const ReplayIndex& lines) {
  const ReplayIndex& index = plan_.archive_->index();
  // Rows past these are left out of an index; which ones, only who reads all lines in order can tell.
  if (index.marks.size() >= ReplayIndex::kMaxMarks || index.players.size() >= ReplayIndex::kMaxPlayers)
    return false;
  const auto from = [&](std::uint64_t tick) {
    return std::lower_bound(index.marks.begin(), index.marks.end(), tick,
                            [](const Mark& mark, std::uint64_t t) { return mark.tick < t; });
  };
  const std::vector<KeyframePlace>& places = plan_.places();
  const auto end = k + 1 < places.size() ? from(places[k + 1].tick) : index.marks.end();
  if (!std::equal(from(places[k].tick), end, lines.marks.begin(), lines.marks.end())) return false;
  for (const PlayerSpan& player : lines.players) {
    const PlayerSpan* indexed = index.find(player.player);
    if (indexed == nullptr || indexed->label != player.label || indexed->joined != player.joined)
      return false;
  }
  for (const Mark& mark : lines.marks) {
    if (mark.kind != MarkKind::kLeave) continue;
    const PlayerSpan* indexed = index.find(mark.player);
    if (indexed == nullptr || indexed->left != mark.tick + 1) return false;
    ++met_.leaves;
  }
  met_.inputs += lines.inputs;
  met_.players += lines.players.size();
  return true;
}

std::optional<core::Expected<Verification>> Plan::verdict(std::deque<Job>& jobs) const {
  Finding* first = nullptr;
  Met met;
  for (Job& job : jobs) {
    met.inputs += job.met_.inputs;
    met.players += job.met_.players;
    met.leaves += job.met_.leaves;
    if (job.finding_ && (first == nullptr || job.finding_->segment < first->segment)) first = &*job.finding_;
  }
  assert(first != nullptr);  // of the last segment at least
  if (!first->is_as_indexed) return std::nullopt;
  if (!first->result) return tl::unexpected(first->result.error());
  Verification verification;
  verification.first_tick = archive_->first_tick();
  verification.ticks = places()[first->segment].tick - verification.first_tick + first->result->steps;
  verification.difference = std::move(first->result->difference);
  if (verification.difference) return verification;
  const ReplayIndex& index = archive_->index();
  const auto left = std::count_if(index.players.begin(), index.players.end(),
                                  [](const PlayerSpan& player) { return player.left.has_value(); });
  if (met.inputs != index.inputs || met.players != index.players.size() ||
      met.leaves != static_cast<std::uint64_t>(left))
    return std::nullopt;
  verification.cut_off = !first->result->end;
  return verification;
}

/// Nothing when the recording has no index that tells each segment and what is in it, or can't be opened at
/// all.
std::optional<core::Expected<Verification>> verify_by_index(const ReplaySource& source, unsigned jobs) {
  const auto archive = ReplayArchive::open(source);
  if (!archive) return std::nullopt;
  // Together they take no more memory than one reader does; a server's lines are a hundredth of that.
  Plan plan(*archive, kMaxReplayLineBytes / (2 * jobs));
  std::deque<Plan::Job> work;
  for (unsigned k = 0; k < jobs; ++k) work.emplace_back(plan);
  {
    const auto work_on = [&work](std::size_t job) { work[job].work(); };
    std::vector<std::jthread> threads;
    core::start_threads(threads, 1, work.size(), work_on);
    work_on(0);
  }
  return plan.verdict(work);
}

}  // namespace

core::Expected<Verification> verify(const ReplaySource& source, unsigned jobs) {
  assert(jobs >= 1);
  if (jobs > 1) {
    if (auto verification = verify_by_index(source, jobs)) return std::move(*verification);
  }
  return verify(source);
}

}  // namespace woodlouse::replay
