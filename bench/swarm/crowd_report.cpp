#include "bench/swarm/crowd_report.h"

#include <map>
#include <ostream>
#include <string>

#include "bench/swarm/report_text.h"

namespace woodlouse::swarm {
namespace {

using Counts = std::map<std::string, std::uint64_t>;

std::string times(Samples samples) {
  samples.sort();
  return text("p50 %.2f p99 %.2f max %.2f ms (%zu)", samples.at(0.5), samples.at(0.99), samples.at(1.0),
              samples.size());
}

std::string got(const std::string& title, const Tally& tally) {
  std::string line = title + ": gap " + times(tally.frame_gaps) +
                     text(", missed %zu of %zu", static_cast<std::size_t>(tally.missed),
                          static_cast<std::size_t>(tally.missed + tally.distinct_ticks));
  if (tally.inputs != 0) line += ", ack " + times(tally.input_to_ack);
  return line + "\n";
}

std::string counts(const std::string& title, const Counts& counts) {
  std::string lines;
  for (const auto& [what, count] : counts)
    lines += title + ": " + std::to_string(count) + " x " + what + "\n";
  return lines;
}

/// What became of a group's clients.
struct Fates {
  std::size_t joined = 0, disconnected = 0, stalled = 0;
  std::uint64_t retried = 0;
  Counts losses, refusals, complaints;
  Samples to_welcome, to_first_frame;
  Tally tally;  ///< of those that read

  explicit Fates(const Bots& bots) {
    for (const auto& bot : bots) add(*bot);
  }

  void add(const Bot& bot) {
    retried += bot.connection().retried();
    for (const auto& [code, count] : bot.refusals()) refusals[code] += count;
    for (const auto& [what, count] : bot.complaints()) complaints[what] += count;
    if (!bot.loss().empty()) ++losses[bot.loss()];
    if (!bot.welcome()) return;
    ++joined;
    if (!bot.loss().empty()) ++disconnected;
    if (bot.profile().stalls) ++stalled;
    if (bot.arrival().to_welcome) to_welcome.add(*bot.arrival().to_welcome);
    if (bot.arrival().to_first_frame) to_first_frame.add(*bot.arrival().to_first_frame);
    if (!bot.profile().stalls) tally.add(bot.tally());
  }

  [[nodiscard]] std::string text_of(const std::string& name, std::size_t clients) const {
    std::string lines =
        text("%s: %zu clients, %zu joined, %zu disconnected, %zu stalled, %zu connects tried again\n",
             name.c_str(), clients, joined, disconnected, stalled, static_cast<std::size_t>(retried));
    lines += name + " connect to welcome: " + times(to_welcome) + "\n";
    lines += name + " connect to first frame: " + times(to_first_frame) + "\n";
    return lines + counts(name + " join refused", refusals) + counts(name + " lost", losses) +
           counts(name + " told", complaints);
  }
};

std::string healthy_text(const Swarm& swarm) {
  const Fates fates(swarm.healthy());
  const HealthyTallies& tallies = swarm.healthy_tallies();
  Tally loaded = tallies.coming;
  loaded.add(tallies.lasts);
  return fates.text_of("healthy", swarm.healthy().size()) + got("healthy before the load", tallies.before) +
         got("healthy while it comes", tallies.coming) + got("healthy while it lasts", tallies.lasts) +
         got("healthy under load", loaded);
}

std::string traffic_text(const Tally& tally, double seconds) {
  const auto received = static_cast<double>(tally.bytes), sent = static_cast<double>(tally.bytes_sent);
  return text("others received %.0f bytes/s, sent %.0f bytes/s: %.1f bytes out a byte in\n",
              received / seconds, sent / seconds, sent > 0.0 ? received / sent : 0.0);
}

std::string comeback_text(const Swarm& swarm) {
  std::size_t cut = 0, back = 0, same = 0, said = 0;
  Samples to_first_frame;
  for (const auto& bot : swarm.bots()) {
    if (!bot->comeback().is_cut) continue;
    ++cut;
    if (bot->arrival().to_first_frame && bot->loss().empty()) {
      ++back;
      to_first_frame.add(*bot->arrival().to_first_frame);
    }
    if (bot->comeback().has_same_louse) ++same;
    if (bot->comeback().says_resumed) ++said;
  }
  return text("resume: %zu cut, %zu back, %zu in the same louse, %zu told resumed\n", cut, back, same, said) +
         "resume connect to first frame: " + times(to_first_frame) + "\n";
}

std::string churn_text(const Churn& churn) {
  const Fates fates(churn.bots());
  return text("churn: %zu sent, %zu kept back\n", static_cast<std::size_t>(churn.sent()),
              static_cast<std::size_t>(churn.kept_back())) +
         counts("churn join refused", fates.refusals) + counts("churn lost last", fates.losses);
}

}  // namespace

bool print_crowd_report(std::ostream& out, const Options& options, const Swarm& swarm, double seconds) {
  const Fates others(swarm.bots());
  out << text(
      "crowd at %s:%s: %zu bots, %zu spectators, %zu chatters, %zu askers, %.0f %% stalled, %zu healthy, "
      "%.1f s\n",
      options.host.c_str(), options.port.c_str(), options.bots, options.spectators, options.chatters,
      options.askers, options.stalled_percent, options.healthy, seconds);
  if (!swarm.healthy().empty()) out << healthy_text(swarm);
  if (!swarm.bots().empty()) {
    out << others.text_of("others", swarm.bots().size()) << got("others", others.tally)
        << text("others all in or refused after %.2f s\n", swarm.joining_seconds())
        << traffic_text(others.tally, seconds);
    if (others.tally.inputs != 0)
      out << text("others inputs: %zu sent, %zu acks\n", static_cast<std::size_t>(others.tally.inputs),
                  static_cast<std::size_t>(others.tally.acks));
  }
  if (options.resume) out << comeback_text(swarm);
  if (options.churn_per_second > 0.0) out << churn_text(swarm.churn());
  out << text("own CPU %.0f %% of a core\n", 100.0 * swarm.own_cpu_seconds() / seconds);
  const Fates healthy(swarm.healthy());
  return others.joined == swarm.bots().size() && others.disconnected == 0 && healthy.disconnected == 0;
}

}  // namespace woodlouse::swarm
