#include "server/ban_desk.h"

#include <cassert>
#include <mutex>
#include <utility>

#include "server/access/ban_file.h"

namespace woodlouse::server {

struct BanDesk::Shared {
  std::mutex mutex;  ///< held while somebody is told: whoever ends the desk waits for that
  bool is_open = true;
};

BanDesk::BanDesk(std::shared_ptr<Doorman> doorman, std::optional<std::filesystem::path> file)
    : file_(std::move(file)),
      doorman_(std::move(doorman)),
      shared_(std::make_shared<Shared>()),
      thread_(kMostWaiting, std::chrono::hours(1), [] {}) {
  assert(doorman_ != nullptr);
}

BanDesk::~BanDesk() {
  thread_.close();
  static_cast<void>(thread_.wait_until(Clock::now() + kLastMoment));
  const std::lock_guard lock(shared_->mutex);
  shared_->is_open = false;
}

core::Expected<void> BanDesk::read() {
  if (!file_) return {};
  auto bans = read_bans(*file_);
  if (!bans) return tl::unexpected(bans.error());
  doorman_->use(std::move(*bans));
  return {};
}

bool BanDesk::post(std::function<core::Expected<void>()> work, Done done) {
  assert(work && done);
  return thread_.post([shared = shared_, work = std::move(work), done = std::move(done)] {
    auto result = work();
    const std::lock_guard lock(shared->mutex);
    if (shared->is_open) done(std::move(result));
  });
}

bool BanDesk::change(Edit edit, Done done) {
  return post(
      [doorman = doorman_, file = file_, edit = std::move(edit)]() -> core::Expected<void> {
        Bans bans = doorman->bans();
        bans.drop_over(wall_now());
        if (auto edited = edit(bans); !edited) return edited;
        if (file)
          if (auto written = write_bans(*file, bans); !written) return written;
        doorman->use(std::move(bans));
        return {};
      },
      std::move(done));
}

bool BanDesk::reread(Done done) {
  return post(
      [doorman = doorman_, file = file_]() -> core::Expected<void> {
        if (!file) return {};
        auto bans = read_bans(*file);
        if (!bans) return tl::unexpected(bans.error());
        doorman->use(std::move(*bans));
        return {};
      },
      std::move(done));
}

}  // namespace woodlouse::server
