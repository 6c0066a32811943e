#include "bench/swarm/line_scan.h"

#include <charconv>

namespace woodlouse::swarm {

std::optional<std::uint32_t> scan_ack_seq(std::string_view line) {
  constexpr std::string_view kHead = R"({"type":"ack","seq":)";
  if (!line.starts_with(kHead)) return std::nullopt;
  std::uint32_t seq = 0;
  const char* const end = line.data() + line.size();
  const auto [rest, error] = std::from_chars(line.data() + kHead.size(), end, seq);
  if (error != std::errc{} || rest == end || *rest != ',' || !line.ends_with('}')) return std::nullopt;
  return seq;
}

bool is_only_counted(std::string_view line) {
  for (const std::string_view head :
       {R"({"type":"event",)", R"({"type":"map",)", R"({"type":"rooms",)", R"({"type":"pong",)"})
    if (line.starts_with(head)) return true;
  return false;
}

std::string without_players(std::string_view line) {
  constexpr std::string_view kPlayers = R"("players":[)";
  const std::size_t players =
      line.starts_with(R"({"type":"welcome",)") ? line.rfind(kPlayers) : std::string_view::npos;
  const std::size_t end = players == std::string_view::npos ? players : line.find(']', players);
  if (end == std::string_view::npos) return std::string(line);
  return std::string(line.substr(0, players + kPlayers.size())) + std::string(line.substr(end));
}

bool says_resumed(std::string_view line) { return line.find(R"("resumed":true)") != std::string_view::npos; }

std::string with_resume(std::string join, const std::optional<std::string>& token) {
  const std::size_t end = join.rfind('}');
  if (end != std::string::npos) join.insert(end, R"(,"resume":)" + (token ? '"' + *token + '"' : "true"));
  return join;
}

}  // namespace woodlouse::swarm
