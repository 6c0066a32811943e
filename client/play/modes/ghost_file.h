// Own drives in a folder of the account's: FOLDER/ghosts/<map hash>-<behavior>.ndjson, two lines a drive as
// they are on the wire, an `ack` with the exact state where it began and a `ghost` with its inputs. What is
// read is checked as what comes from outside is: a line that is none ends the list, a drive that no louse can
// drive is passed over. Several clients of one account may keep their drives at once: none loses another's.
// Nothing here is worth a word to the player: without a file there are no old ghosts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/play/modes/drive.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/records.h"

namespace woodlouse::client {

inline constexpr std::size_t kMostGhostsKept = 20;

/// $XDG_DATA_HOME/woodlouse, or ~/.local/share/woodlouse; empty: neither is known.
std::filesystem::path data_folder();

std::string ghost_drives_text(const std::vector<OwnDrive>& drives, std::uint32_t tick_hz, state::Mode mode);
/// Those of this rate and mode, the newest last, kMostGhostsKept at most.
std::vector<OwnDrive> parse_ghost_drives(std::string_view text, const map::Map& map, std::uint32_t tick_hz,
                                         state::Mode mode);

std::vector<OwnDrive> read_ghost_drives(const std::filesystem::path& folder, const map::Map& map,
                                        std::uint32_t tick_hz, state::Mode mode);
/// Behind those that stand there now, whoever wrote them; beyond kMostGhostsKept the oldest ones go. All of
/// them, or none: false, with the file as it was, where another one holds the folder for over 0.1 s, or the
/// file can't be read or written.
[[nodiscard]] bool keep_ghost_drives(const std::filesystem::path& folder, const map::Map& map,
                                     std::uint32_t tick_hz, state::Mode mode,
                                     const std::vector<OwnDrive>& drives);

/// The ghost that came with the shipped map of that name, where it proves its run on this one; none: else.
/// REQUIRES a map with a race, in full detail.
std::optional<protocol::GhostLine> read_author_ghost(const map::Map& map, std::uint32_t tick_hz);

/// Whether `name` was marked as done in that folder, and marks it.
bool is_done(const std::filesystem::path& folder, std::string_view name);
void mark_done(const std::filesystem::path& folder, std::string_view name);

}  // namespace woodlouse::client
