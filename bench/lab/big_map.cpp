#include "bench/lab/big_map.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "bench/lab/methods/laboratory.h"
#include "bench/lab/problems/motion.h"
#include "bench/lab/report/progress.h"
#include "shared/core/random.h"
#include "shared/map/flt_grid_file.h"

namespace woodlouse::lab {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

double resident_megabytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes = 0.0;
  while (status >> word) {
    if (word == "VmRSS:") status >> kilobytes;
  }
  return kilobytes / 1024.0;
}

/// Removed with everything in it when this goes.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(fs::temp_directory_path() / ("woodlouse-lab-" + std::to_string(getpid()))) {
    std::error_code error;
    fs::create_directories(path_, error);  // a folder that is not there shows when the file is written
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code error;
    fs::remove_all(path_, error);  // what can't be removed stays in the system's temporary folder
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Rolling hills with a cell of 1 m; the rows repeat with a shift, so that writing is a copy.
core::Expected<void> write_map(const fs::path& file, std::size_t knots) {
  std::ofstream header(fs::path(file).replace_extension(".hdr"));
  header << "ncols " << knots << "\nnrows " << knots
         << "\nxllcenter 0\nyllcenter 0\ncellsize 1\nbyteorder LSBFIRST\n";
  header.close();
  std::ofstream data(file, std::ios::binary);
  Progress progress("writing the map", knots);
  std::vector<float> row(knots);
  const auto wave = [](std::size_t i, double length) {
    return std::sin(2.0 * std::numbers::pi * static_cast<double>(i) / length);
  };
  std::vector<double> across(knots);
  for (std::size_t i = 0; i < knots; ++i) across[i] = 3.0 * wave(i, 97.0) + 0.5 * wave(i, 23.0);
  for (std::size_t j = 0; j < knots; ++j) {
    const double along = wave(j, 71.0);
    for (std::size_t i = 0; i < knots; ++i)
      row[i] = static_cast<float>(across[i] * along + across[(i + 7 * j) % knots]);
    data.write(reinterpret_cast<const char*>(row.data()),
               static_cast<std::streamsize>(row.size() * sizeof(float)));
    progress.advance();
  }
  data.close();
  if (!header || !data)
    return core::fail(file.string(), "can't be written",
                      "the temporary folder needs room; TMPDIR names another");
  return {};
}

/// Asks the system to forget the file's pages, so that opening finds them on the disk.
void forget_pages(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  posix_fadvise(descriptor, 0, 0, POSIX_FADV_DONTNEED);
  close(descriptor);
}

double cached_megabytes(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return 0.0;
  const std::size_t bytes = fs::file_size(file);
  void* const at = mmap(nullptr, bytes, PROT_READ, MAP_SHARED, descriptor, 0);
  close(descriptor);
  if (at == MAP_FAILED) return 0.0;
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  std::vector<unsigned char> pages((bytes + page - 1) / page);
  double cached = 0.0;
  if (mincore(at, bytes, pages.data()) == 0) {
    for (const unsigned char one : pages) cached += (one & 1) != 0 ? 1.0 : 0.0;
  }
  munmap(at, bytes);
  return cached * static_cast<double>(page) / 1048576.0;
}

std::vector<state::Louse> wanderers(std::size_t count, const terrain::Rectangle& domain) {
  core::Random random(13);
  const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  std::vector<state::Louse> lice;
  for (std::size_t i = 0; i < count; ++i) {
    lice.push_back(louse_at({within(domain.x_min, domain.x_max), within(domain.y_min, domain.y_max)},
                            {within(-5, 5), within(-5, 5)}));
    const double angle = within(-std::numbers::pi, std::numbers::pi);
    push(lice.back(), {std::cos(angle), std::sin(angle)});
  }
  return lice;
}

}  // namespace

core::Expected<BigMapUsage> use_big_map(std::size_t knots, std::size_t lice_count, double seconds) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "big.flt";
  if (auto done = write_map(file, knots); !done) return tl::unexpected(done.error());
  forget_pages(file);

  BigMapUsage usage;
  usage.knots = static_cast<double>(knots);
  usage.lice = static_cast<double>(lice_count);
  const double before = resident_megabytes();
  const auto begin = Clock::now();
  auto grid = map::FltGrid::open(file);
  if (!grid) return tl::unexpected(grid.error());
  const document::AnySurface surface(std::in_place_type<terrain::TiledBSpline>, std::move(*grid));
  const auto& spline = std::get<terrain::TiledBSpline>(surface);
  constexpr double kRate = 60.0;
  const auto stepper = make_stepper(surface, Equations::kSurface, Integrator::kNystrom4, state::Parameters{},
                                    spline.domain(), 1.0 / kRate);
  if (!stepper) return tl::unexpected(stepper.error());
  std::vector<state::Louse> lice = wanderers(lice_count, spline.domain());
  physics::StepCounters counters;
  (*stepper)->advance(lice, counters);
  usage.open_seconds = seconds_since(begin);

  const long ticks = std::lround(seconds * kRate);
  Progress progress("wandering", static_cast<std::size_t>(ticks));
  for (long tick = 1; tick < ticks; ++tick) {
    (*stepper)->advance(lice, counters);
    progress.advance();
  }
  usage.ns_per_step = 1e9 * seconds_since(begin) / static_cast<double>(counters.louse_steps);
  usage.resident_mb = resident_megabytes();
  usage.grown_mb = usage.resident_mb - before;
  usage.cached_mb = cached_megabytes(file);
  usage.tiles = static_cast<double>(spline.tiles_built());
  const double side =
      std::ceil(static_cast<double>(knots - 1) / static_cast<double>(terrain::BSplineTile::kCells));
  usage.all_tiles = side * side;
  return usage;
}

}  // namespace woodlouse::lab
