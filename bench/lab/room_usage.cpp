#include "bench/lab/room_usage.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "bench/lab/report/progress.h"

namespace woodlouse::lab {
namespace {

namespace fs = std::filesystem;

constexpr int kRestingLice = 20;

/// A child process; ended and waited for when this goes.
class Process {
 public:
  /// Standard output goes into `output`, standard error nowhere.
  static core::Expected<Process> start(const std::vector<std::string>& command, const fs::path& output) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                     0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    pid_t id = -1;
    const int error = posix_spawn(&id, command.front().c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0)
      return core::fail(command.front(), "can't be started", "build it, or name its folder with --programs");
    return Process(id);
  }
  Process(Process&& other) noexcept : id_(std::exchange(other.id_, -1)) {}
  Process& operator=(Process&&) = delete;
  ~Process() {
    if (id_ < 0) return;
    kill(id_, SIGTERM);
    waitpid(id_, nullptr, 0);
  }
  /// Processor time of all its threads [s].
  [[nodiscard]] double processor_seconds() const {
    double nanoseconds = 0.0;
    std::error_code error;
    for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(id_) + "/task", error)) {
      double one = 0.0;
      std::ifstream(task.path() / "schedstat") >> one;
      nanoseconds += one;
    }
    return 1e-9 * nanoseconds;
  }

 private:
  explicit Process(pid_t id) : id_(id) {}
  pid_t id_;
};

void sleep_for(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

/// The server's "listening ADDRESS" within five seconds.
std::string address_in(const fs::path& output) {
  for (int i = 0; i < 100; ++i) {
    std::ifstream in(output);
    std::string word;
    std::string address;
    if (in >> word >> address && word == "listening") return address;
    sleep_for(0.05);
  }
  return {};
}

void write_flat_map(const fs::path& file) {
  std::ofstream out(file);
  out << R"({"name": "flat", "terrain": {"origin": [-10, -10], "spacing": 5, "heights": [)";
  for (int row = 0; row < 5; ++row) out << (row == 0 ? "" : ", ") << "[0, 0, 0, 0, 0]";
  out << "]}}\n";
}

core::Expected<RoomUsage> use_room_in(const fs::path& folder, const fs::path& programs, Population population,
                                      double seconds) {
  write_flat_map(folder / "flat.json");
  const auto server = Process::start({(programs / "woodlouse-server").string(), "--map",
                                      (folder / "flat.json").string(), "--listen", "127.0.0.1:0"},
                                     folder / "server");
  if (!server) return tl::unexpected(server.error());
  const std::string address = address_in(folder / "server");
  if (address.empty())
    return core::fail("woodlouse-server", "did not say where it listens", "run it by hand to see why");
  std::vector<Process> swarm;
  if (population == Population::kResting) {
    auto started =
        Process::start({(programs / "woodlouse-swarm").string(), "--bots", std::to_string(kRestingLice),
                        "--inputs-per-second", "0", "--seconds", std::to_string(seconds + 10), address},
                       folder / "swarm");
    if (!started) return tl::unexpected(started.error());
    swarm.push_back(std::move(*started));
  }
  sleep_for(1.5);  // start, handshakes, first keys
  Progress progress(population == Population::kEmpty ? "empty room" : "resting room", 100);
  const auto begin = std::chrono::steady_clock::now();
  const double before = server->processor_seconds();
  for (int i = 0; i < 100; ++i) {
    sleep_for(seconds / 100);
    progress.advance();
  }
  const double used = server->processor_seconds() - before;
  const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return RoomUsage{100.0 * used / passed, passed, population == Population::kEmpty ? 0.0 : kRestingLice};
}

}  // namespace

core::Expected<RoomUsage> use_room(const fs::path& programs, Population population, double seconds) {
  const fs::path folder = fs::temp_directory_path() / ("woodlouse-room-" + std::to_string(getpid()));
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return core::fail(folder.string(), "can't be made", "TMPDIR names another temporary folder");
  auto usage = use_room_in(folder, programs, population, seconds);
  fs::remove_all(folder, error);  // what can't be removed stays in the system's temporary folder
  return usage;
}

}  // namespace woodlouse::lab
