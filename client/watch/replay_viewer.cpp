#include "client/watch/replay_viewer.h"

#include <unistd.h>

#include <chrono>
#include <utility>
#include <variant>

#include "client/drawing/layout.h"

namespace woodlouse::client {

ReplayViewer::ReplayViewer(boost::asio::io_context& context, RecordingView& recording,
                           const std::string& name, TerminalGuard& guard, KeySource keys,
                           TerminalScreen& screen, const GameSettings& settings)
    : recording_(recording),
      guard_(guard),
      screen_(screen),
      settings_(settings),
      screening_(recording, name, settings.view, paints_pixels(settings.look)),
      loop_(context, guard, std::move(keys), screen, settings.fps, *this) {}

void ReplayViewer::on_input(const TerminalInput& input) {
  const Key* key = std::get_if<Key>(&input);
  if (key == nullptr) return;
  const auto action = screening_.on_key(*key);
  if (action == Action::kConfirm) return loop_.finish({});
  if (action == Action::kQuitNow) return loop_.finish({kExitInterrupted, ""});
  if (action == Action::kSuspend) guard_.suspend();
  if (action == Action::kRedraw) screen_.invalidate();
  loop_.hurry();
}

Scene ReplayViewer::scene(core::Time now, double fps) {
  screening_.suit(default_view(settings_.look, terminal_size(STDOUT_FILENO)));
  screening_.update(now);
  recording_.prove(now + std::chrono::nanoseconds(std::chrono::seconds(1)) / (settings_.fps * kProvingShare));
  return screening_.scene({settings_.look, fps, false, now});
}

}  // namespace woodlouse::client
