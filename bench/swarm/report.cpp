#include "bench/swarm/report.h"

#include <algorithm>
#include <map>
#include <ostream>
#include <string>
#include <vector>

#include "bench/swarm/report_text.h"

namespace woodlouse::swarm {
namespace {

std::string percentiles(const char* title, Samples& samples) {
  samples.sort();
  return text("%-26s p50 %7.2f  p95 %7.2f  p99 %7.2f  max %7.2f ms  (%zu)\n", title, samples.at(0.5),
              samples.at(0.95), samples.at(0.99), samples.at(1.0), samples.size());
}

struct Totals {
  std::vector<double> rates;  ///< distinct ticks a second, of each bot that joined
  double wanted_rate = 0.0;   ///< state_hz
  std::uint64_t bytes = 0, inputs = 0;
  Samples input_to_ack, frame_gaps;
  std::map<std::string, std::uint64_t> losses, complaints;
  std::size_t not_joined = 0, disconnected = 0;
};

Totals add_up(const Swarm& swarm, double seconds) {
  Totals totals;
  for (const auto& bot : swarm.bots()) {
    for (const auto& [what, times] : bot->complaints()) totals.complaints[what] += times;
    if (!bot->loss().empty()) ++totals.losses[bot->loss()];
    if (!bot->welcome()) {
      ++totals.not_joined;
      continue;
    }
    if (!bot->loss().empty()) ++totals.disconnected;
    const Tally& tally = bot->tally();
    totals.wanted_rate = bot->welcome()->state_hz;
    totals.rates.push_back(static_cast<double>(tally.distinct_ticks) / seconds);
    totals.bytes += tally.bytes;
    totals.inputs += tally.inputs;
    totals.input_to_ack.add(tally.input_to_ack);
    totals.frame_gaps.add(tally.frame_gaps);
  }
  std::sort(totals.rates.begin(), totals.rates.end());
  return totals;
}

std::string rates_text(const Totals& totals, double seconds) {
  double received = 0.0;
  for (const double rate : totals.rates) received += std::min(rate, totals.wanted_rate);
  const double wanted = totals.wanted_rate * static_cast<double>(totals.rates.size());
  const auto missing = [&](double got, double due) { return 100.0 * std::max(0.0, 1.0 - got / due); };
  return text("%-26s min %7.2f  median %7.2f  max %7.2f  (due %.0f, over %.1f s)\n",
              "distinct ticks/s per bot", totals.rates.front(), totals.rates[totals.rates.size() / 2],
              totals.rates.back(), totals.wanted_rate, seconds) +
         text("%-26s all %7.2f %%  worst bot %7.2f %%\n", "missing", missing(received, wanted),
              missing(totals.rates.front(), totals.wanted_rate));
}

}  // namespace

bool print_report(std::ostream& out, const Options& options, const Swarm& swarm, double seconds) {
  Totals totals = add_up(swarm, seconds);
  const auto& bots = swarm.bots();
  const auto joined =
      std::find_if(bots.begin(), bots.end(), [](const auto& bot) { return bot->welcome().has_value(); });
  const protocol::Welcome& welcome = *(*joined)->welcome();
  out << "swarm of " << options.bots << " at " << options.host << ":" << options.port << ", room "
      << welcome.room << " (" << welcome.tick_hz << " ticks/s, " << welcome.state_hz << " states/s), "
      << to_text(options.format) << ", " << options.inputs_per_second << " inputs/s each, seed "
      << options.seed << "\n";
  out << rates_text(totals, seconds);
  out << percentiles("gap between frames", totals.frame_gaps);
  out << percentiles("input to ack", totals.input_to_ack);
  out << text("%-26s %zu inputs sent, %zu acks\n", "inputs", static_cast<std::size_t>(totals.inputs),
              totals.input_to_ack.size());
  out << text("%-26s %.2f MB/s in all; own CPU %.0f %% of a core\n", "received",
              1e-6 * static_cast<double>(totals.bytes) / seconds, 100.0 * swarm.own_cpu_seconds() / seconds);
  out << text("%-26s %zu not joined, %zu disconnected\n", "lost", totals.not_joined, totals.disconnected);
  for (const auto& [reason, times] : totals.losses) out << "  " << times << " x " << reason << "\n";
  std::uint64_t complaints = 0;
  for (const auto& entry : totals.complaints) complaints += entry.second;
  out << text("%-26s %zu\n", "errors and notices", static_cast<std::size_t>(complaints));
  for (const auto& [what, times] : totals.complaints) out << "  " << times << " x " << what << "\n";
  return totals.not_joined == 0 && totals.disconnected == 0;
}

}  // namespace woodlouse::swarm
