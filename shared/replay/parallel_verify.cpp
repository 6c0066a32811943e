#include "shared/replay/parallel_verify.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "shared/replay/archive.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/segment.h"

namespace woodlouse::replay {
namespace {

/// Of one segment: what came of it, and where it ended.
struct Finding {
  core::Expected<Segment> segment;
  bool is_where_planned = false;  ///< it began and ended at the index's keyframes
};

class Plan {
 public:
  explicit Plan(std::shared_ptr<const ReplayArchive> archive)
      : archive_(std::move(archive)),
        findings_(archive_->index().keyframes.size()),
        first_bad_(findings_.size()) {}

  /// Takes one segment after the other until none is left that matters.
  void work() {
    for (;;) {
      const std::size_t k = next_.fetch_add(1);
      if (k >= findings_.size() || k > first_bad_.load()) return;
      findings_[k] = run(k);
      const Finding& finding = *findings_[k];
      if (finding.is_where_planned && finding.segment && !finding.segment->difference) continue;
      std::size_t before = first_bad_.load();
      while (k < before && !first_bad_.compare_exchange_weak(before, k)) {
      }
    }
  }

  /// After all work: the verdict, or nothing when the index misled.
  std::optional<core::Expected<Verification>> verdict() {
    Verification verification;
    verification.first_tick = archive_->first_tick();
    for (std::optional<Finding>& finding : findings_) {
      if (!finding || !finding->is_where_planned) return std::nullopt;
      if (!finding->segment) return tl::unexpected(finding->segment.error());
      verification.ticks += finding->segment->steps;
      verification.difference = std::move(finding->segment->difference);
      if (verification.difference) return verification;
    }
    verification.cut_off = !findings_.back()->segment->has_end;
    return verification;
  }

 private:
  Finding run(std::size_t k) {
    const std::vector<KeyframePlace>& places = archive_->index().keyframes;
    const auto stream = archive_->source().open();
    if (!stream) return {tl::unexpected(stream.error()), false};
    (*stream)->seekg(static_cast<std::streamoff>(places[k].offset));
    ReplayReader reader(**stream, archive_->source().name, places[k].line - 1);
    core::Expected<std::optional<Line>> line = reader.next();
    if (!line || !*line || !std::holds_alternative<Keyframe>(**line)) return {Segment{}, false};
    const Header& header = archive_->header();
    core::Expected<Segment> segment = run_segment(reader, archive_->map(), {header.tick_hz, header.seed},
                                                  std::get<Keyframe>(std::move(**line)));
    const bool is_last = k + 1 == places.size();
    bool is_where_planned = !segment || !segment->next == is_last;
    if (segment && segment->next && !is_last) {
      is_where_planned = places[k].offset + reader.line_offset() == places[k + 1].offset &&
                         reader.line_number() == places[k + 1].line;
    }
    return {std::move(segment), is_where_planned};
  }

  std::shared_ptr<const ReplayArchive> archive_;
  std::vector<std::optional<Finding>> findings_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> first_bad_;  ///< no later segment matters
};

/// The first segment begins right behind the header.
bool begins_behind_header(const ReplayArchive& archive) {
  const auto stream = archive.source().open();
  if (!stream) return false;
  ReplayReader reader(**stream, archive.source().name);
  if (!reader.read_header() || !reader.next()) return false;
  return reader.line_offset() == archive.index().keyframes.front().offset && reader.line_number() == 2;
}

/// Nothing when the recording has no index that leads from each segment to the next, or can't be opened at
/// all.
std::optional<core::Expected<Verification>> verify_by_index(const ReplaySource& source, unsigned jobs) {
  const auto archive = ReplayArchive::open(source);
  if (!archive || !begins_behind_header(**archive)) return std::nullopt;
  Plan plan(*archive);
  {
    std::vector<std::jthread> threads;
    for (unsigned k = 0; k < jobs; ++k) threads.emplace_back([&plan] { plan.work(); });
  }
  return plan.verdict();
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
