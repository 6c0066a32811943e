#include "server/admin/admin_door.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

#include "server/admin/answer.h"
#include "shared/protocol/codes.h"

namespace woodlouse::server {

AdminDoor::AdminDoor(boost::asio::io_context& io, Control& control, Timekeeper& timekeeper,
                     std::shared_ptr<spdlog::logger> log)
    : strand_(boost::asio::make_strand(io)),
      control_(control),
      timekeeper_(timekeeper),
      port_(strand_, std::move(log)) {}

core::Expected<std::string> AdminDoor::open(const AdminSettings& settings) {
  std::optional<Secret> token;
  if (settings.token_file) {
    auto read = read_secret("--admin-token-file", *settings.token_file);
    if (!read) return tl::unexpected(read.error());
    token = *read;
  }
  assert(token || std::holds_alternative<std::filesystem::path>(settings.where));
  watch_.emplace(std::move(token), timekeeper_.now());
  return port_.open(settings.where);
}

void AdminDoor::start() {
  boost::asio::post(strand_, [this] {
    if (watch_) port_.start([this](AdminPort::Socket socket) { take(std::move(socket)); });
  });
}

void AdminDoor::take(AdminPort::Socket socket) {
  if (is_stopping_ || talks_.size() >= kMostTalks + kCourtesy) return;  // closed by its end
  const auto talk = std::make_shared<AdminTalk>(std::move(socket), control_, *watch_, timekeeper_);
  if (served_ >= kMostTalks) end_oldest_stranger();
  talks_.push_back(talk);
  const bool is_served = served_ < kMostTalks;
  if (is_served) ++served_;
  auto closed = [this, gone = std::weak_ptr(talk), is_served] {
    std::erase(talks_, gone.lock());
    if (is_served) --served_;
    tell_when_empty();
  };
  if (is_served) return talk->start(std::move(closed));
  talk->start_refused(refused(protocol::code::kTooManyConnections,
                              "this door has " + std::to_string(kMostTalks) + " connections already"),
                      std::move(closed));
}

/// Who has not said who he is keeps nobody out who might.
void AdminDoor::end_oldest_stranger() {
  const auto stranger =
      std::find_if(talks_.begin(), talks_.end(), [](const auto& talk) { return talk->is_stranger(); });
  if (stranger != talks_.end()) std::shared_ptr(*stranger)->end();  // which leaves the list
}

void AdminDoor::stop(std::function<void()> stopped) {
  boost::asio::post(strand_, [this, stopped = std::move(stopped)]() mutable {
    assert(!is_stopping_);
    is_stopping_ = true;
    port_.close();
    stopped_ = std::move(stopped);
    const auto talks = talks_;  // those that end at once leave
    for (const auto& talk : talks) talk->end();
    tell_when_empty();
  });
}

void AdminDoor::tell_when_empty() {
  if (stopped_ && talks_.empty()) std::exchange(stopped_, nullptr)();
}

}  // namespace woodlouse::server
