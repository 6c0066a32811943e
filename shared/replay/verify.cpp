#include "shared/replay/verify.h"

#include <cassert>
#include <utility>

#include "shared/core/joined.h"
#include "shared/replay/line_reader.h"
#include "shared/replay/segment.h"

namespace woodlouse::replay {

using core::joined;

struct Verifier::Work {
  explicit Work(const ReplaySource& of) : source(of) {}

  ReplaySource source;
  std::unique_ptr<InputStream> stream;
  std::optional<ReplayReader> reader;
  match::MatchSettings settings;
  std::shared_ptr<const map::Map> map;
  std::optional<Keyframe> start;  ///< of the segment that is next
  ReplayIndex lines;
  Verification verification;

  core::Expected<void> begin();
  void add(const Keyframe& keyframe) {
    lines.add({keyframe.state.tick, reader->line_offset(), reader->line_number()}, keyframe);
  }
};

core::Expected<void> Verifier::Work::begin() {
  auto opened = source.open();
  if (!opened) return tl::unexpected(opened.error());
  stream = std::move(*opened);
  reader.emplace(*stream, source.name);
  const core::Expected<Header> header = reader->read_header();
  if (!header) return tl::unexpected(header.error());
  settings = settings_of(*header);
  auto recorded = recorded_map(*header, source);
  if (!recorded) return tl::unexpected(recorded.error());
  map = std::move(*recorded);
  core::Expected<std::optional<Line>> first = reader->next();
  if (!first) return tl::unexpected(first.error());
  if (!*first) return core::fail(source.name, "was cut off before its first keyframe");
  start = std::get<Keyframe>(std::move(**first));
  verification.first_tick = start->state.tick;
  add(*start);
  return {};
}

Verifier::Verifier(const ReplaySource& source) : work_(std::make_unique<Work>(source)) {}
Verifier::~Verifier() = default;

const Verification& Verifier::verification() const { return work_->verification; }

core::Expected<bool> Verifier::advance() {
  Work& work = *work_;
  if (!work.reader) {
    if (auto begun = work.begin(); !begun) return tl::unexpected(begun.error());
  }
  assert(work.start);
  core::Expected<Segment> segment = run_segment(*work.reader, work.map, work.settings,
                                                *std::exchange(work.start, std::nullopt), work.lines);
  if (!segment) return tl::unexpected(segment.error());
  Verification& verification = work.verification;
  verification.ticks += segment->steps;
  verification.difference = std::move(segment->difference);
  if (segment->next) work.add(*segment->next);
  if (!verification.difference) verification.difference = index_difference(*segment, 0, work.lines);
  work.start = std::move(segment->next);
  const bool goes_on = work.start && !verification.difference;
  if (!goes_on) verification.cut_off = !segment->end && !verification.difference;
  return goes_on;
}

core::Expected<Verification> verify(const ReplaySource& source) {
  Verifier verifier(source);
  for (;;) {
    const core::Expected<bool> goes_on = verifier.advance();
    if (!goes_on) return tl::unexpected(goes_on.error());
    if (!*goes_on) return verifier.verification();
  }
}

std::string to_text(const Verification& verification) {
  if (verification.ok()) {
    return joined({"ok ticks ", std::to_string(verification.first_tick), " to ",
                   std::to_string(verification.first_tick + verification.ticks),
                   verification.from_start() ? "" : ", the start is taken on trust",
                   verification.cut_off ? ", then the recording is cut off: it has no end line" : "", "\n"});
  }
  const Difference& difference = *verification.difference;
  return joined({"differs at tick ", std::to_string(difference.tick), ": ", difference.what, "\n",
                 difference.detail, "\n"});
}

}  // namespace woodlouse::replay
