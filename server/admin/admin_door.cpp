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
  if (is_stopping_) return;  // closed by its end
  if (served_ >= kMostTalks) end_oldest_stranger(true);
  if (guests_.size() >= kMostTalks + kCourtesy && !end_oldest_stranger(false)) return;
  const auto talk = std::make_shared<AdminTalk>(std::move(socket), control_, *watch_, timekeeper_);
  const bool is_served = served_ < kMostTalks;
  guests_.push_back({talk, is_served});
  if (is_served) ++served_;
  auto closed = [this, gone = std::weak_ptr(talk), is_served] {
    std::erase_if(guests_, [talk = gone.lock()](const Guest& guest) { return guest.talk == talk; });
    if (is_served) --served_;
    tell_when_empty();
  };
  if (is_served) return talk->start(std::move(closed));
  talk->start_refused(refused(protocol::code::kTooManyConnections,
                              "this door has " + std::to_string(kMostTalks) + " connections already"),
                      std::move(closed));
}

/// Who has not said who he is keeps nobody out who might. False: there is none.
bool AdminDoor::end_oldest_stranger(bool is_served) {
  const auto stranger = std::find_if(guests_.begin(), guests_.end(), [is_served](const Guest& guest) {
    return guest.is_served == is_served && (guest.talk->is_stranger() || !is_served);
  });
  if (stranger == guests_.end()) return false;
  std::shared_ptr(stranger->talk)->give_way();  // which leaves the list
  return true;
}

void AdminDoor::stop(std::function<void()> stopped) {
  boost::asio::post(strand_, [this, stopped = std::move(stopped)]() mutable {
    assert(!is_stopping_);
    is_stopping_ = true;
    port_.close();
    stopped_ = std::move(stopped);
    const auto guests = guests_;  // those that end at once leave
    for (const Guest& guest : guests) guest.talk->end();
    tell_when_empty();
  });
}

void AdminDoor::tell_when_empty() {
  if (stopped_ && guests_.empty()) std::exchange(stopped_, nullptr)();
}

}  // namespace woodlouse::server
