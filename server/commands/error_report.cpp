#include "server/commands/error_report.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <span>
#include <string_view>
#include <vector>

#include "shared/core/joined.h"
#include "shared/match/found_lice.h"
#include "shared/match/step_error.h"
#include "shared/match/twin.h"
#include "shared/protocol/text_cleaning.h"
#include "shared/replay/format.h"

namespace woodlouse::server {
namespace {

constexpr std::size_t kMostNameBytes = 200;  // of one that came in a file

/// A recording's ticks, observed.
struct Observers {
  Observers(const map::Map& map, double tick, state::Mode mode)
      : found(map, tick, mode), error(map, tick, mode), twin(map, tick, mode) {}

  match::FoundLice found;
  match::StepError error;
  match::Twin twin;
};

core::Expected<void> observe(const replay::ReplayArchive& archive, Observers& observers) {
  const auto playback = archive.play(archive.first_tick());
  if (!playback) return tl::unexpected(playback.error());
  const match::Match& match = (*playback)->match();
  for (;;) {
    const std::uint64_t tick = match.tick();
    const std::vector<state::Louse> before(match.world().lice().begin(), match.world().lice().end());
    const auto step = (*playback)->advance();
    if (!step) return tl::unexpected(step.error());
    if (!*step) return {};
    if (!(*step)->is_proven())
      return core::fail(archive.source().name,
                        core::joined({"differs at tick ", std::to_string(match.tick())}), "ask verify");
    const std::span<const state::Louse> found = observers.found.find(before, (*step)->recorded.step);
    observers.error.observe(found, tick);
    observers.twin.observe(found, observers.error.stepped());
  }
}

std::string apart(std::vector<double> divergences) {
  if (divergences.empty()) return "       0         -         -";
  std::sort(divergences.begin(), divergences.end());
  char text[64];
  std::snprintf(text, sizeof text, "%8zu %9.2g %9.2g", divergences.size(),
                divergences[(divergences.size() - 1) / 2], divergences.back());
  return text;
}

std::string row(std::string_view who, double of_play, const match::ErrorFigure& figure, double tick_seconds,
                const std::vector<double>& divergences, std::string_view name) {
  char text[128];
  std::snprintf(text, sizeof text, "%6.*s %9.1f %11.3g %10.2g %9llu ", static_cast<int>(who.size()),
                who.data(), static_cast<double>(figure.ticks) * tick_seconds, of_play, figure.worst,
                static_cast<unsigned long long>(figure.worst_tick));
  return core::joined({text, apart(divergences), name.empty() ? "" : "  ", name, "\n"});
}

}  // namespace

core::Expected<std::string> error_report(const replay::ReplayArchive& archive) {
  const replay::Header& header = archive.header();
  const double tick_seconds = 1.0 / header.tick_hz;
  Observers observers(*archive.map(), tick_seconds, header.mode);
  if (const auto done = observe(archive, observers); !done) return tl::unexpected(done.error());
  std::string out =
      "error: bounds of each tick's local error, metres over the map and what a wrong velocity adds in a "
      "second,\nfor a second of play; apart: how far a twin at half the step is away after 10 s [m]\n"
      "player   seconds  error[m/s]   worst[m]   at tick  windows  median     most    name\n";
  match::ErrorFigure whole;
  std::vector<double> all;
  for (const auto& [player, figure] : observers.error.figures()) {
    whole.ticks += figure.ticks;
    whole.sum += figure.sum;
    if (figure.worst > whole.worst) {
      whole.worst = figure.worst;
      whole.worst_tick = figure.worst_tick;
    }
    const auto found = observers.twin.divergences().find(player);
    const std::vector<double> own =
        found != observers.twin.divergences().end() ? found->second : std::vector<double>{};
    all.insert(all.end(), own.begin(), own.end());
    const replay::PlayerSpan* label = archive.index().find(player);
    out += row(std::to_string(player), observers.error.of_play(figure), figure, tick_seconds, own,
               label != nullptr ? protocol::clean_text(label->label.name, kMostNameBytes) : "");
  }
  return out + row("all", observers.error.of_play(whole), whole, tick_seconds, all, "");
}

}  // namespace woodlouse::server
