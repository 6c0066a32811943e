// The ghosts beside you: those that hold a race's records, and your own drives before this one, the last and
// the best. Each drives in a world of its own. Time is an argument. Single thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "client/drawing/course/course.h"
#include "client/play/modes/drive.h"
#include "client/play/modes/ghost_run.h"
#include "client/play/trail.h"
#include "shared/map/map_definition.h"
#include "shared/protocol/records.h"

namespace woodlouse::client {

enum class GhostChoice : std::uint8_t { kBest, kLast, kOff };

class Ghosts {
 public:
  Ghosts() = default;
  ~Ghosts() { keep(); }
  Ghosts(const Ghosts&) = delete;
  Ghosts& operator=(const Ghosts&) = delete;

  /// Own drives are kept there from now on, and those of before are shown again, beside the author's of a
  /// shipped race (ghost_file.h); else no file is read, and own drives end with the program.
  void keep_in(std::filesystem::path folder) { folder_ = std::move(folder); }

  /// A game begins. The map outlives it or the next call.
  void begin(std::shared_ptr<const map::Map> map, std::uint32_t tick_hz, state::Mode mode);
  /// Whoever holds a record; false: this run can't be driven here.
  bool add_record(const protocol::GhostLine& line);
  /// A drive of your own is over; one that is too short to be raced is passed over.
  void add_drive(OwnDrive drive);

  /// Off, the last, the best; what it is now in words.
  std::string cycle();
  [[nodiscard]] GhostChoice choice() const { return choice_; }

  /// Where they are. since_spawn: ticks of your own drive, none before it began. run_start: moment at which
  /// your race's clock began, 0: it does not run. tick: the server's, now.
  std::vector<GhostMark> marks(std::optional<double> since_spawn, std::int64_t run_start, double tick);

 private:
  struct Record {
    std::optional<protocol::Board> board;  ///< none: the race's author's
    std::string name;
    double start = 0.0;  ///< ticks from the spawn to the first gate
    GhostRun run;
    Trail trail;
    bool is_double = false;  ///< the same drive as another one that is shown
  };

  [[nodiscard]] GhostMark mark(std::string name, const LouseSample& sample, Trail& trail) const;
  [[nodiscard]] double trail_spacing() const;
  /// The last drive from here on, and the best where it is one: of a race only with a lap in it.
  void take_own(OwnDrive drive);
  [[nodiscard]] bool is_better(GhostRun& a, GhostRun& b) const;
  void add_run(std::optional<protocol::Board> board, const std::string& name,
               const protocol::GhostLine& line);
  void mark_doubles();
  void load();
  /// Tries to, once more, with what could not be kept before.
  void keep();

  std::shared_ptr<const map::Map> map_;
  std::uint32_t tick_hz_ = 60;
  state::Mode mode_ = state::Mode::kRoam;
  GhostChoice choice_ = GhostChoice::kBest;
  std::optional<std::filesystem::path> folder_;
  std::vector<Record> records_;
  std::optional<GhostRun> last_, best_;
  std::vector<OwnDrive>
      unkept_;  ///< of this map, rate and mode, not in the folder yet; kMostGhostsKept at most
  Trail own_trail_{1.0};
};

}  // namespace woodlouse::client
