#include "client/watch/recording_view.h"

#include <algorithm>
#include <utility>

namespace woodlouse::client {
namespace {

constexpr double kTrailSpacings = 200.0;  // a trail's points are this part of the map's width apart

}  // namespace

core::Expected<std::unique_ptr<RecordingView>> RecordingView::open(replay::ReplaySource source) {
  auto archive = replay::ReplayArchive::open(std::move(source));
  if (!archive) return tl::unexpected(archive.error());
  auto playback = (*archive)->play((*archive)->first_tick());
  if (!playback) return tl::unexpected(playback.error());
  auto prover = (*archive)->play((*archive)->first_tick());
  if (!prover) return tl::unexpected(prover.error());
  return std::unique_ptr<RecordingView>(
      new RecordingView(std::move(*archive), std::move(*playback), std::move(*prover)));
}

RecordingView::RecordingView(std::shared_ptr<const replay::ReplayArchive> archive,
                             std::unique_ptr<replay::Playback> playback,
                             std::unique_ptr<replay::Playback> prover)
    : archive_(std::move(archive)),
      playback_(std::move(playback)),
      prover_(std::move(prover)),
      proof_(archive_->first_tick(), archive_->last_tick()) {
  for (const replay::PlayerSpan& player : archive_->players()) labels_[player.player] = player.label;
  take_lice();
}

core::Expected<void> RecordingView::show(std::uint64_t tick) {
  if (tick == this->tick()) return {};
  const auto lead_in = static_cast<std::uint64_t>(kTrailSeconds * archive_->header().tick_hz);
  core::Expected<void> done;
  if (tick < this->tick() || tick - this->tick() > lead_in) {
    trails_.clear();
    done = playback_->seek(tick - std::min(lead_in, tick - archive_->first_tick()));
    extend_trails();
    error_.reset();
    if (done) done = run_to(tick);
    begin_error();
  } else {
    done = run_to(tick);
  }
  take_lice();
  return done;
}

core::Expected<void> RecordingView::run_to(std::uint64_t tick) {
  while (this->tick() < tick) {
    const state::Louse* const measured = error_ ? louse(measured_) : nullptr;
    const auto before = measured != nullptr ? std::optional(*measured) : std::nullopt;
    const auto step = playback_->advance();
    if (!step) return tl::unexpected(step.error());
    if (!*step) return {};
    if (before) count_error(*before, (*step)->recorded.step);
    proof_.take(**step);
    chat_.add((*step)->chats);
    extend_trails();
  }
  return {};
}

void RecordingView::measure(std::uint32_t id) {
  if (id == measured_) return;
  measured_ = id;
  begin_error();
}

void RecordingView::begin_error() {
  error_.reset();
  found_.reset();
  if (measured_ == 0) return;
  const replay::Header& header = archive_->header();
  error_ = std::make_unique<match::LiveError>(*archive_->map(), 1.0 / header.tick_hz, header.mode);
  found_ = std::make_unique<match::FoundLice>(*archive_->map(), 1.0 / header.tick_hz, header.mode);
}

void RecordingView::count_error(const state::Louse& before, const match::StepRecord& step) {
  for (const state::Louse& found : found_->find({&before, 1}, step)) error_->find(found, step.tick);
  error_->count(1);
}

void RecordingView::prove(core::Time deadline) {
  while (prover_ && std::chrono::steady_clock::now() < deadline) {
    const auto step = prover_->advance();
    const bool has_more = step && *step;
    if (has_more) {
      proof_.take(**step);
      chat_.add((*step)->chats);
    }
    if (!has_more || !(*step)->is_proven()) prover_.reset();
  }
}

Sight RecordingView::sight() const {
  Sight sight{archive_->map().get(), lice_, trails_, nullptr};
  sight.name_of = [this](std::uint32_t id) {
    const auto label = labels_.find(id);
    return name_of(label == labels_.end() ? nullptr : &label->second, id);
  };
  sight.is_bot = [this](std::uint32_t id) {
    const auto label = labels_.find(id);
    return label != labels_.end() && label->second.role == protocol::Role::kBot;
  };
  if (shown_.game)
    sight.ruling = {archive_->header().mode, &*shown_.game, static_cast<double>(tick()),
                    archive_->header().tick_hz, 0};
  return sight;
}

void RecordingView::extend_trails() {
  const terrain::Rectangle& domain = archive_->map()->terrain->domain();
  const double spacing = std::max(domain.x_max - domain.x_min, 1.0) / kTrailSpacings;
  for (const state::Louse& louse : playback_->match().world().lice())
    trails_.try_emplace(louse.id, spacing).first->second.add(louse.position, louse.flight_z);
}

void RecordingView::take_lice() {
  lice_.clear();
  shown_ = snapshot_of(playback_->match());
  for (const auto& [id, sample] : shown_.lice) {
    const auto label = labels_.find(id);
    const match::PlayerLabel* known = label == labels_.end() ? nullptr : &label->second;
    lice_[id] = {sample, name_of(known, id), known != nullptr && known->role == protocol::Role::kBot, false};
  }
  std::erase_if(trails_, [this](const auto& entry) { return !lice_.contains(entry.first); });
}

}  // namespace woodlouse::client
