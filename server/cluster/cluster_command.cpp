#include "server/cluster/cluster_command.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cassert>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "server/cluster/batch.h"
#include "server/cluster/heartbeat.h"
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

core::Expected<std::shared_ptr<HostTable>> hear_hosts(NatsLink& link, const ClusterSettings& settings,
                                                      Duration lasts) {
  const auto table = std::make_shared<HostTable>(settings.host, settings.shard, 0);
  auto heard = link.subscribe(settings.beat_subject("*"), [table](const auto&, const auto& bytes, auto) {
    if (auto beat = beat_from(bytes)) table->take(std::move(*beat), Clock::now());
  });
  if (!heard) return tl::unexpected(heard.error());
  heard = link.subscribe(settings.edge_subject("*"), [table](const auto&, const auto& bytes, auto) {
    if (auto beat = beat_from(bytes)) table->take_edge(std::move(*beat), Clock::now());
  });
  if (!heard) return tl::unexpected(heard.error());
  std::this_thread::sleep_for(lasts);
  return table;
}

std::string_view doing(const Beat& host) {
  if (host.owns) return host.leaves ? "owns the rooms and goes" : "owns the rooms";
  if (host.leaves) return "takes no rooms any more";
  return host.ready ? "stands by" : "CAN'T TAKE OVER (its log says why)";
}

std::string_view mode_of(const Beat& host) {
  if (!host.strict) return "";
  return *host.strict ? "mode strict, " : "mode play, ";
}

/// Waits until another host owns the rooms.
int move(NatsLink& link, const ClusterErrand& errand, std::ostream& out, std::ostream& err) {
  constexpr Duration kWithin = std::chrono::seconds(10);
  const bool is_drain = errand.action == ClusterErrand::Action::kDrain;
  const auto table = hear_hosts(link, errand.settings, 6 * Heartbeat::every(errand.settings.silence));
  if (!table) return report(table.error(), err);
  const auto owner = (*table)->owner(Clock::now());
  if (!owner) return report({"cluster", "nobody owns its rooms now"}, err);
  const auto heard = (*table)->hosts(Clock::now());
  if (is_drain && std::none_of(heard.begin(), heard.end(),
                               [&errand](const Beat& beat) { return beat.host == errand.host; }))
    return report(
        {errand.host, "no host of that name is heard", "woodlouse-server cluster status says who is there"},
        err);
  const bool is_owners = !is_drain || owner->host == errand.host;
  const std::string to = is_drain ? std::string() : errand.host;
  if (!is_drain && owner->host == to) return report({to, "owns the rooms already"}, err);
  if (is_owners && !(*table)->successor(Clock::now(), to))
    return report({to.empty() ? "cluster" : to, "nobody stands by there that could take the rooms",
                   "woodlouse-server cluster status says who stands by"},
                  err);
  const Time asked = Clock::now();
  const MoveOrder order{is_drain ? errand.host : std::string(), to};
  if (const auto sent = link.publish(errand.settings.move_subject(), to_text(order)); !sent)
    return report(sent.error(), err);
  while (Clock::now() - asked < kWithin) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const auto now = (*table)->owner(Clock::now());
    const auto hosts = (*table)->hosts(Clock::now());
    const bool is_drained = std::any_of(hosts.begin(), hosts.end(), [&errand](const Beat& beat) {
      return beat.host == errand.host && beat.leaves && !beat.owns;
    });
    if (!now || (is_owners && now->host == owner->host) || (is_drain && !is_drained)) continue;
    const auto took = std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - asked);
    out << fmt::format("the rooms of {} are at {}, {}{}\n", errand.settings.shard, now->host, now->address,
                       is_owners ? fmt::format(", after {} ms", took.count()) : "");
    if (is_drain) out << errand.host << " takes none any more, until it is started anew\n";
    return kFine;
  }
  return report({"cluster", "nothing has moved within 10 s",
                 "the logs of the hosts say why, or that of NATS: may who asks publish " +
                     errand.settings.move_subject() + "?"},
                err);
}

int status(NatsLink& link, const ClusterSettings& settings, std::ostream& out, std::ostream& err) {
  const auto table =
      hear_hosts(link, settings, Heartbeat::kEdgeEvery + 2 * Heartbeat::every(settings.silence));
  if (!table) return report(table.error(), err);
  const auto state = link.stream_state();
  if (!state) return report(state.error(), err);
  int code = kFine;
  out << fmt::format("log {}: batches {} to {}, {} bytes, {} of {} replicas have all{}\n", settings.stream(),
                     state->first, state->last, state->bytes, state->current, state->replicas,
                     state->leader.empty() ? "" : core::joined({", led by ", state->leader}));
  if (const auto last = link.last()) {
    const auto batch = unpack(last->bytes, core::joined({"batch ", std::to_string(last->sequence)}));
    if (!batch) code = report(batch.error(), err);
    if (batch) out << "its last batch is that of " << to_text(batch->head.writer) << '\n';
    for (const RoomPlace& place : batch ? batch->head.rooms : std::vector<RoomPlace>())
      out << fmt::format("room {}: tick {}, keyframe in batch {}\n", place.room, place.tick, place.keyframe);
  }
  const auto hosts = (*table)->hosts(Clock::now());
  for (const Beat& beat : hosts)
    out << fmt::format("host {} at {}: {}, {}{} batch {}\n", beat.host, beat.address, doing(beat),
                       mode_of(beat), beat.owns ? "stored up to" : "has read up to", beat.sequence);
  for (const Beat& beat : (*table)->edges(Clock::now()))
    out << fmt::format("edge {}{}: {}, has read up to batch {}\n", beat.host,
                       beat.address.empty() ? "" : core::joined({" at ", beat.address}),
                       beat.ready ? "shows the rooms" : "SHOWS NOTHING (its log says why)", beat.sequence);
  if (hosts.empty()) out << "no host is heard\n";
  return code;
}

/// Of ten thousands of reads one may come too late.
core::Expected<NatsLink::Message> read_patiently(NatsLink& link, std::uint64_t sequence) {
  constexpr int kTries = 20;
  auto message = link.read(sequence);
  for (int tried = 1; !message && tried < kTries; ++tried) message = link.read(sequence);
  return message;
}

int fsck(NatsLink& link, const ClusterErrand& errand, std::ostream& out, std::ostream& err) {
  const auto state = link.stream_state();
  if (!state) return report(state.error(), err);
  ShardView view;
  JoinedLog joined(errand.out, out);
  std::size_t epochs = 0;
  std::string writer;
  for (std::uint64_t sequence = state->first; sequence != 0 && sequence <= state->last; ++sequence) {
    const auto message = read_patiently(link, sequence);
    if (!message) return report(message.error(), err);
    const auto batch = unpack(message->bytes, core::joined({"batch ", std::to_string(sequence)}));
    if (!batch) {
      out << batch.error().text() << '\n';
      view.lose(sequence);
      joined.lose();
      continue;
    }
    if (const auto order = view.check_order(sequence, batch->head); !order) {
      out << order.error().text() << "; it is passed over\n";
      view.pass_over(sequence);
      continue;
    }
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
    case ClusterErrand::Action::kMove:
    case ClusterErrand::Action::kDrain:
      return move(**link, errand, out, err);
    case ClusterErrand::Action::kFsck:
      return fsck(**link, errand, out, err);
  }
  return kFailed;
}

}  // namespace woodlouse::server
