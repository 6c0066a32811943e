// A drive driven again, in a world of its own: what a ghost is drawn from. No bandwidth, and the same bits as
// the drive had. Single thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "client/play/modes/drive.h"
#include "client/play/view_state.h"
#include "shared/map/map_definition.h"
#include "shared/physics/world.h"

namespace woodlouse::client {

/// Why no louse of that map can have driven so, for drives that came from outside; empty: one can.
std::string why_no_drive(const map::Map& map, std::uint32_t tick_hz, const OwnDrive& drive);

class GhostRun {
 public:
  /// REQUIRES a map in full detail that has the mode, and why_no_drive() to be empty.
  GhostRun(const map::Map& map, std::uint32_t tick_hz, state::Mode mode, OwnDrive drive);

  /// Where it was `ticks` after its start; before that at its start, nothing once it is over. Of a leap
  /// forward kMostSteps are taken at once, the rest with the next calls.
  std::optional<LouseSample> at(double ticks);
  /// How far it had come after so many ticks, its end at the latest [m].
  double distance_at(std::uint32_t ticks);

  [[nodiscard]] const OwnDrive& drive() const { return drive_; }

 private:
  static constexpr std::uint32_t kMostSteps = 1200;
  static constexpr state::LouseId kGhost = 1;

  void rewind();
  void step();
  void run_to(std::uint32_t tick, std::uint32_t most_steps);

  physics::World world_;
  OwnDrive drive_;
  std::uint32_t tick_ = 0;  ///< since the start
  std::size_t next_ = 0;    ///< of the inputs
};

}  // namespace woodlouse::client
