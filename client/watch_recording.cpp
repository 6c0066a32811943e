#include "client/watch_recording.h"

#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "client/terminal/descriptor.h"
#include "client/watch/recording_view.h"
#include "client/watch/replay_viewer.h"
#include "shared/replay/source_file.h"

namespace woodlouse::client {
namespace {

Outcome no_recording(const core::Error& error) {
  return {kExitIo, "woodlouse: " + error.where + ": " + error.what + "\n      " +
                       (error.hint.empty() ? "a recording is what  woodlouse-server --record FILE  writes"
                                           : error.hint) +
                       "\n"};
}

Outcome show(const Config& config, RecordingView& recording) {
  auto keys = open_terminal_for_keys(STDIN_FILENO);
  if (!keys) return {kExitIo, "woodlouse: " + keys.error().text() + "\n"};
  Descriptor key_terminal(*keys);
  const Look look = choose_look(config.color, config.glyphs, hints_of_environment());
  const Descriptor frames(open_terminal_for_frames(STDOUT_FILENO));
  const Descriptor modes(dup(key_terminal.get()));  // the guard's: outlives the viewer, which closes its own
  auto guard = TerminalGuard::enter(modes.get(), STDOUT_FILENO, TerminalUse::kFullScreen);
  if (!guard) return {kExitIo, "woodlouse: " + guard.error().text() + "\n"};
  TerminalScreen screen(frames.get() >= 0 ? frames.get() : STDOUT_FILENO, look.color);
  boost::asio::io_context context(1);
  const std::string name = std::filesystem::path(config.recording).filename().string();
  return ReplayViewer(context, recording, name, **guard, key_terminal.release(), screen,
                      {look, config.view, config.fps, Overlay::kNone})
      .run();
}

}  // namespace

Outcome watch_recording(const Config& config) {
  const auto recording = RecordingView::open(replay::source_of_file(config.recording, config.maps));
  if (!recording) return no_recording(recording.error());
  const Outcome outcome = show(config, **recording);
  const auto& difference = (*recording)->proof().difference();
  if (!difference) return outcome;
  return {kExitDiffers, outcome.message + "woodlouse: " + to_text(*difference) +
                            "\n      for more:  woodlouse-server verify " + config.recording + "\n"};
}

}  // namespace woodlouse::client
