// A host of a cluster: one thread that follows the shard's log and stands by, or owns it and writes. That it
// lives is told by another one (heartbeat.h).
//
//   following --the owner is silent, or goes; the log takes this host's first batch--> owning
//       ^---------------another host's batch stands in the log-------------------------'
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "server/cluster/cluster.h"
#include "server/cluster/heartbeat.h"
#include "server/cluster/host_table.h"
#include "server/cluster/inbox.h"
#include "server/cluster/log_writer.h"
#include "server/cluster/nats_link.h"
#include "server/cluster/node_figures.h"
#include "server/cluster/shard_text.h"
#include "server/cluster/shard_view.h"
#include "server/logging/events.h"

namespace woodlouse::server {

class Node final : public Cluster {
 public:
  /// Between two looks at what has come.
  static constexpr Duration kLook = std::chrono::milliseconds(5);
  /// Between two attempts to read the log from a beginning.
  static constexpr Duration kBeginEvery = std::chrono::milliseconds(250);
  /// Text of a batch that waits for no time: it is one message of NATS, packed, but where a line is long.
  static constexpr std::size_t kCutBytes = 512u << 10;
  static constexpr std::size_t kCutBehindBytes = 4u << 20;  ///< the same while a batch is on its way
  /// Batches that are not acknowledged; then the log begins anew once it takes some.
  static constexpr std::size_t kMostWaiting = 600;
  /// Without an acknowledgement; then the rooms are told.
  static constexpr Duration kNotDurableAfter = std::chrono::seconds(10);
  static constexpr Duration kLeaveWithin = std::chrono::milliseconds(500);
  /// In which another host is to take over what was handed to it; then it is this one's again.
  static constexpr Duration kTakenWithin = std::chrono::seconds(3);

  Node(ClusterSettings settings, Hooks hooks, std::shared_ptr<spdlog::logger> log);
  /// One that only shows the rooms.
  Node(ClusterSettings settings, Viewers viewers, std::shared_ptr<spdlog::logger> log);
  ~Node() override { leave(); }

  core::Expected<void> connect();

  void start() override;
  void leave() override;
  [[nodiscard]] std::unique_ptr<TickWatcher> watch(const std::string& room, replay::Header header) override;
  [[nodiscard]] std::optional<std::string> elsewhere(std::string_view room) const override;
  [[nodiscard]] bool is_on_its_way(std::string_view room) const override;
  [[nodiscard]] std::vector<HostedRoom> rooms_elsewhere() const override;
  [[nodiscard]] ClusterFigures figures() const override;
  [[nodiscard]] std::vector<std::string> hosts() const override;
  void begin_leaving(const std::string& to) override;
  void hand_over() override;
  [[nodiscard]] std::optional<std::string> successor(const std::string& wanted) const override {
    const auto next = table().successor(Clock::now(), wanted);
    return next ? std::optional(next->address) : std::nullopt;
  }

 private:
  // The node's thread:
  void run();
  bool follow();
  [[nodiscard]] bool begin_following();
  [[nodiscard]] core::Expected<std::string> read_whole(std::uint64_t sequence);
  [[nodiscard]] core::Expected<void> read_beginning(const NatsLink::StreamState& state);
  [[nodiscard]] ShardView fresh_view();
  void show();
  [[nodiscard]] bool take_message(const LogMessage& message);
  [[nodiscard]] bool pass_gap();
  [[nodiscard]] bool has_log_gone_back(Time now);
  void tell_line();
  void tell_following(Time now);
  void tell_mode();
  [[nodiscard]] bool is_owner_gone(Time now);
  [[nodiscard]] const HostTable& table() const { return heartbeat_.hosts(); }
  [[nodiscard]] Heartbeat::Hooks heard();
  void asked(const MoveOrder& order);
  [[nodiscard]] bool is_cut_off() const { return is_log_cut_ || heartbeat_.is_cut(); }
  [[nodiscard]] Duration silence(Time now) const;
  [[nodiscard]] bool take_over();
  [[nodiscard]] bool catch_up();
  [[nodiscard]] bool take_log();
  [[nodiscard]] std::vector<RoomToGoOn> rooms_to_go_on();
  void own();
  void tell_owning();
  void ask_the_log();
  void hear(std::deque<NodeEvent> events);
  void cut(Time now);
  [[nodiscard]] std::size_t cut_bytes() const {
    return writer_->waiting() == 0 ? kCutBytes : kCutBehindBytes;
  }
  void write(Time now);
  void tell_kept();
  [[nodiscard]] Time next_look(Time now) const;
  [[nodiscard]] bool begin_log_anew();
  void watch_durability(Time now);
  void step_down();
  void store_the_rest();
  void watch_handing_over(Time now);
  [[nodiscard]] std::optional<LastBatch> read_last();
  bool complain(const core::Error& error);

  [[nodiscard]] core::Expected<void> open_log_link();
  bool renew_log_link();

  void say(LogEvent event, const std::string& text) {
    told_.count(event);
    log_event(*log_, event, "cluster: " + text);
  }

  const ClusterSettings settings_;
  const Hooks hooks_;                     ///< none of one that only shows
  const std::optional<Viewers> viewers_;  ///< of one that only shows
  const std::shared_ptr<spdlog::logger> log_;
  const std::shared_ptr<Inbox> inbox_ = std::make_shared<Inbox>();
  Heartbeat heartbeat_;
  NodeFigures told_;
  std::unique_ptr<NatsLink> log_link_;

  // The node's thread's:
  std::optional<ShardView> view_;
  std::vector<std::pair<std::string, std::vector<std::string>>> to_show_;  ///< lines, by room, in their order
  Time begin_at_{};  ///< to read the log, at the earliest
  Time renew_at_{};  ///< to make a line that is closed anew, likewise
  bool is_log_empty_ = false;
  Time tried_{};                       ///< to take over, in vain
  std::optional<Time> going_;          ///< since when the owner is known to go
  bool has_lost_rooms_ = false;        ///< whose beginning could not be read any more
  std::uint64_t after_ = 0;            ///< the stream's last sequence number, where it holds nothing to read
  Time heard_{};                       ///< the owner, by its batches
  Time came_at_{}, looked_back_at_{};  ///< the last batch; the last look at what the log holds, behind it
  std::uint64_t reading_ = 0;          ///< how often the log was begun to be read
  std::uint64_t passed_over_ = 0;      ///< batches in a row
  std::set<std::string> shown_;        ///< of one that only shows them: rooms of which lines were handed on
  std::optional<LogWriter> writer_;
  Writer former_;  ///< this host's epoch before, where its log had to begin anew
  std::optional<ShardText> text_;
  std::deque<std::pair<std::uint64_t, std::vector<std::function<void()>>>>
      kept_;  ///< who waits for the batches below that number
  Time cut_at_{};
  bool is_full_ = false;  ///< nothing more may wait: what is told is dropped
  bool is_told_not_durable_ = false;
  bool was_cut_off_ = false;  ///< as told
  bool is_other_mode_told_ = false;
  std::optional<Time> rooms_changed_;  ///< of the log that is followed; none: they are told
  Time doubted_at_{};                  ///< Time{}: the rooms are this host's, as far as is known
  bool has_differed_ = false;          ///< some tick, from the log: it takes nothing over
  std::string last_fault_;             ///< told already

  std::uint64_t handed_epoch_ = 0;
  std::optional<Time> handed_over_;  ///< since when the rooms are to go on elsewhere, and do not yet

  std::atomic<bool> is_leaving_{false};
  std::atomic<bool> is_to_hand_over_{false};
  std::atomic<bool> is_drained_{false};     ///< an operator wants no room here any more
  std::atomic<bool> is_log_cut_{false};     ///< from NATS
  std::atomic<bool> is_log_closed_{false};  ///< for good: NATS has refused this host
  mutable std::mutex mutex_;                ///< of what follows
  std::vector<std::string> known_rooms_;    ///< of the shard, as the log has them

  std::jthread running_;
};

}  // namespace woodlouse::server
