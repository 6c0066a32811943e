#include "server/cluster/cluster_command.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "server/cluster/batch.h"
#include "server/cluster/host_table.h"
#include "server/cluster/joined_log.h"
#include "server/cluster/nats_link.h"
#include "server/cluster/shard_view.h"
#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

constexpr int kFine = 0;
constexpr int kFailed = 1;

int report(const core::Error& error, std::ostream& err) {
  err << "woodlouse-server: " << error.where << ": " << error.what << '\n';
  if (!error.hint.empty()) err << "      " << error.hint << '\n';
  return kFailed;
}

/// The first message of a stream, which nobody owns: whoever writes expects a message before his own.
std::string first_message() {
  BatchHead head;
  head.writer = {0, "init", {}};
  return pack(head, {});
}

int init(NatsLink& link, const ClusterSettings& settings, std::ostream& out, std::ostream& err) {
  const auto made = link.make_stream(first_message());
  if (!made) return report(made.error(), err);
  out << "the log of " << settings.shard << " is stream " << settings.stream()
      << (*made ? ", new, " : ", which was there already, ") << "of " << settings.replicas
      << (settings.replicas == 1 ? " replica\n" : " replicas\n");
  return kFine;
}

int status(NatsLink& link, const ClusterSettings& settings, std::ostream& out, std::ostream& err) {
  const auto table = std::make_shared<HostTable>(settings.host, settings.shard, 0);
  const auto heard =
      link.subscribe(settings.beat_subject("*"), [table](const auto&, const std::string& bytes, auto) {
        if (auto beat = beat_from(bytes)) table->take(std::move(*beat), Clock::now());
      });
  if (!heard) return report(heard.error(), err);
  const auto state = link.stream_state();
  if (!state) return report(state.error(), err);
  out << fmt::format("log {}: batches {} to {}, {} bytes, {} of {} replicas have all{}\n", settings.stream(),
                     state->first, state->last, state->bytes, state->current, state->replicas,
                     state->leader.empty() ? "" : core::joined({", led by ", state->leader}));
  if (const auto last = link.last()) {
    const auto batch = unpack(last->bytes, core::joined({"batch ", std::to_string(last->sequence)}));
    if (!batch) return report(batch.error(), err);
    out << "its last batch is that of " << to_text(batch->head.writer) << '\n';
    for (const RoomPlace& place : batch->head.rooms)
      out << fmt::format("room {}: tick {}, keyframe in batch {}\n", place.room, place.tick, place.keyframe);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto hosts = table->hosts(Clock::now());
  for (const Beat& beat : hosts)
    out << fmt::format("host {} at {}: {}, {} batch {}{}\n", beat.host, beat.address,
                       beat.owns    ? "owns the rooms"
                       : beat.ready ? "stands by"
                                    : "CAN'T TAKE OVER (its log says why)",
                       beat.owns ? "stored up to" : "has read up to", beat.sequence,
                       beat.leaves ? ", goes" : "");
  if (hosts.empty()) out << "no host is heard\n";
  return kFine;
}

int fsck(NatsLink& link, const ClusterErrand& errand, std::ostream& out, std::ostream& err) {
  const auto state = link.stream_state();
  if (!state) return report(state.error(), err);
  ShardView view;
  JoinedLog joined(errand.out, out);
  std::size_t epochs = 0;
  std::string writer;
  for (std::uint64_t sequence = state->first; sequence != 0 && sequence <= state->last; ++sequence) {
    const auto message = link.read(sequence);
    if (!message) return report(message.error(), err);
    const auto batch = unpack(message->bytes, core::joined({"batch ", std::to_string(sequence)}));
    if (!batch) return report(batch.error(), err);
    if (std::exchange(writer, to_text(batch->head.writer)) != to_text(batch->head.writer)) {
      ++epochs;
      out << "batch " << sequence << ": " << writer << '\n';
    }
    if (const auto taken = view.take(sequence, *batch); !taken) return report(taken.error(), err);
    if (const auto taken = joined.take(sequence, *batch); !taken) return report(taken.error(), err);
  }
  if (const auto closed = joined.close(); !closed) return report(closed.error(), err);
  out << fmt::format("batches {} to {}: {} epochs, {} ticks re-run, {} holes\n", state->first, state->last,
                     epochs, view.proven(), joined.holes());
  if (view.difference().empty()) return joined.holes() == 0 ? kFine : kFailed;
  return report({"the log differs", view.difference()}, err);
}

}  // namespace

int cluster_command(const ClusterErrand& errand, std::ostream& out, std::ostream& err) {
  assert(!errand.settings.nats.empty());
  const auto link = NatsLink::open(errand.settings, "operator", {});
  if (!link) return report(link.error(), err);
  switch (errand.action) {
    case ClusterErrand::Action::kInit:
      return init(**link, errand.settings, out, err);
    case ClusterErrand::Action::kStatus:
      return status(**link, errand.settings, out, err);
    case ClusterErrand::Action::kFsck:
      return fsck(**link, errand, out, err);
  }
  return kFailed;
}

}  // namespace woodlouse::server
