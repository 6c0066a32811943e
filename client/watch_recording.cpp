#include "client/watch_recording.h"

#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "client/opened_terminal.h"
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
  const auto terminal = OpenedTerminal::open();
  if (!terminal) return {kExitIo, "woodlouse: " + terminal.error().text() + "\n"};
  Look look = (*terminal)->choose(config.color, config.glyphs);
  look.palette = config.palette;
  TerminalGuard& guard = (*terminal)->fill_screen();
  TerminalScreen screen = (*terminal)->screen();
  boost::asio::io_context context(1);
  const std::string name = std::filesystem::path(config.recording).filename().string();
  return ReplayViewer(context, recording, name, guard, (*terminal)->take_keys(), screen,
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
