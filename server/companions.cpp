#include "server/companions.h"

#include <cassert>
#include <utility>
#include <variant>

#include "server/version.h"
#include "server/watchers/ground_ahead.h"
#include "server/watchers/record_pattern.h"
#include "server/watchers/shadow.h"
#include "shared/core/thread_team.h"

namespace woodlouse::server {

void Companions::begin(const ServeConfig& config, std::size_t shadow_threads) {
  assert(shadow_threads >= 1 && !recordings_ && !records_);
  if (config.step_threads > 1) step_team_ = std::make_shared<core::ThreadTeam>(config.step_threads);
  if (config.record) {
    recordings_.emplace(*config.record, log_);
    dump_folder_ = config.record->pattern.folder();
  }
  if (config.records) records_.emplace(*config.records, log_);
  if (config.shadow) shadows_.emplace(shadow_threads);
}

Watchers Companions::make(const std::string& room, const Start& start, std::vector<core::Error>& failed) {
  Watchers watchers;
  const auto take = [&](auto opened) {
    if (opened)
      watchers.push_back(std::move(*opened));
    else
      failed.push_back(opened.error());
  };
  replay::Header header = replay::make_header(*start.match, kServerName, start.map_file);
  if (recordings_ && is_to_be_recorded(room)) {
    replay::Header recorded = header;
    recorded.parent = start.parent;
    take(recordings_->open(room, std::move(recorded)));
  }
  if (records_ && start.match->settings().mode == state::Mode::kRace)
    take(records_->open(room, *start.match, start.map_file));
  if (cluster_ != nullptr) {
    if (header.map_definition.empty())
      failed.emplace_back(room, "its map is too big for the log of a cluster",
                          "at most " + std::to_string(replay::kMaxInlineMapBytes) + " bytes");
    else
      watchers.push_back(cluster_->watch(room, header));
  }
  if (shadows_)
    watchers.push_back(std::make_unique<Shadow>(
        room, start.map, std::move(header), dump_folder_ / ("shadow." + file_part(room)), *shadows_, log_));
  if (std::holds_alternative<map::TiledTerrain>(start.map->definition.terrain)) {
    const std::lock_guard lock(mutex_);
    if (!ground_) ground_.emplace(1);
    if (auto ahead = GroundAhead::make(room, *start.map, start.map_file, *ground_, log_))
      watchers.push_back(std::move(ahead));
  }
  return watchers;
}

bool Companions::is_to_be_recorded(const std::string& room) {
  const std::lock_guard lock(mutex_);
  return !unrecorded_.contains(room);
}

core::Expected<std::unique_ptr<TickWatcher>> Companions::record(const std::string& room,
                                                                replay::Header header) {
  if (!recordings_)
    return core::fail({}, "this server records nothing", "start it with --record, which says where");
  auto recorder = recordings_->open(room, std::move(header));
  if (!recorder) return tl::unexpected(recorder.error());
  const std::lock_guard lock(mutex_);
  unrecorded_.erase(room);
  return std::unique_ptr<TickWatcher>(std::move(*recorder));
}

void Companions::do_not_record(const std::string& room) {
  const std::lock_guard lock(mutex_);
  unrecorded_.insert(room);
}

void Companions::end() {
  if (recordings_) recordings_->end(Clock::now() + kLastMoment);
  if (records_) records_->end(Clock::now() + kLastRecords);
  if (shadows_) shadows_->join();
}

void Companions::drop_files() {
  records_.reset();
  recordings_.reset();
}

}  // namespace woodlouse::server
