// A host with a room whose log is a list of batches, and who reads it.
#pragma once

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "server/cluster/log_tap.h"
#include "server/cluster/shard_text.h"
#include "server/cluster/shard_view.h"
#include "shared/map/map_file.h"

namespace woodlouse::server::test {

inline std::shared_ptr<const map::Map> volcano() {
  static const auto map = *map::load_map(std::string(WOODLOUSE_SOURCE_DIR) + "/maps/volcano.json");
  return map;
}

/// Jobs are done at once, or refused.
struct Desk final : LogDesk {
  explicit Desk(ShardText& into) : text(into) {}
  [[nodiscard]] bool post(Job job) override {
    if (is_full) return false;
    job(text, now);
    return true;
  }
  void post_soon(Job job) override { job(text, now); }
  void doubt() override { is_doubted = true; }
  [[nodiscard]] bool is_in_doubt() const override { return is_doubted; }
  [[nodiscard]] std::uint64_t beginnings() const override { return begun; }
  ShardText& text;
  Time now = Time{} + std::chrono::hours(1);
  bool is_full = false;
  bool is_doubted = false;
  std::uint64_t begun = 0;
};

/// A host with one room, whose log is a list of batches.
struct Shard {
  explicit Shard(std::uint64_t epoch = 1) : writer{epoch, "a", {epoch, 9}} {}

  void open(const std::string& name, std::unique_ptr<match::Match> match) {
    game = std::move(match);
    tap = std::make_unique<LogTap>(desk, name, replay::make_header(*game, "test", "volcano.json"),
                                   std::chrono::hours(1));
    tap->begin(*game);
  }
  void open(const std::string& name = "volcano", std::uint64_t seed = 5) {
    open(name, std::make_unique<match::Match>(volcano(), match::MatchSettings{60, seed, state::Mode::kRoam}));
  }
  void step(int count = 1) {
    for (int k = 0; k < count; ++k) {
      if (!lice.empty())
        game->file({lice[static_cast<std::size_t>(k) % lice.size()],
                    seq++,
                    {state::ThrustKind::kMapVector, {0.5, 0.25}},
                    state::kHeld,
                    game->tick()});
      const match::StepRecord& record = game->advance();
      const LiveStep live(record, {});
      tap->step(live, *game);
    }
  }
  void join(const std::string& name) {
    lice.push_back(game->join({name, protocol::Role::kPlayer}));
    tap->claimed({lice.back(), name, protocol::Role::kPlayer, {lice.back(), 2, 3, 4}});
  }
  void cut() {
    const std::uint64_t sequence = first + batches.size();
    const std::string lines = text.cut(sequence);
    batches.push_back(*unpack(pack({writer, batches.size(), match::kBehavior, text.places()}, lines), "x"));
  }

  Writer writer;
  std::uint64_t first = 1;
  ShardText text{std::chrono::hours(1)};
  std::shared_ptr<Desk> desk = std::make_shared<Desk>(text);
  std::unique_ptr<match::Match> game;
  std::unique_ptr<LogTap> tap;
  std::vector<match::PlayerId> lice;
  std::uint32_t seq = 0;
  std::vector<Batch> batches;
};

inline void read_all(ShardView& view, const Shard& shard, std::size_t from = 0) {
  for (std::size_t k = from; k < shard.batches.size(); ++k) {
    const auto taken = view.take(shard.first + k, shard.batches[k]);
    if (!taken) FAIL(taken.error().text());
  }
}

inline const match::Match& followed(const ShardView& view, const std::string& room = "volcano") {
  const auto found = view.rooms().find(room);
  REQUIRE(found != view.rooms().end());
  REQUIRE(found->second.follower->match() != nullptr);
  return *found->second.follower->match();
}

}  // namespace woodlouse::server::test
