#include "server/room/broadcaster.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <utility>

namespace woodlouse::server {

namespace asio = boost::asio;

void Broadcaster::add(Member member) {
  asio::post(strand_, [self = shared_from_this(), this, added = std::move(member)]() mutable {
    members_.push_back(std::move(added));
  });
}

void Broadcaster::remove(SessionId session) {
  asio::post(strand_, [self = shared_from_this(), this, session] {
    for (Member& member : members_)
      if (member.session == session) member.subscriber.reset();
    // A running job holds an index into the list; it is tidied when the job ends.
    if (!event_job_ && !frame_job_) end_job();
  });
}

void Broadcaster::event(std::uint64_t number, Line line) {
  backlog_.fetch_add(1, std::memory_order_relaxed);
  asio::post(strand_,
             [self = shared_from_this(), this, job = EventJob{number, std::move(line), 0}]() mutable {
               events_.push_back(std::move(job));
               wake();
             });
}

void Broadcaster::let_go(SessionId session) {
  backlog_.fetch_add(1, std::memory_order_relaxed);
  asio::post(strand_, [self = shared_from_this(), this, session] {
    events_.push_back({0, {}, session});
    wake();
  });
}

void Broadcaster::frames(FrameKind kind, ChannelFrames frames) {
  asio::post(strand_, [self = shared_from_this(), this, kind, job = std::move(frames)]() mutable {
    if (kind == FrameKind::kKey) {
      key_ = std::move(job);
      delta_.reset();
    } else {
      delta_ = std::move(job);
    }
    wake();
  });
}

bool Broadcaster::begin_job() {
  next_member_ = 0;
  if (!events_.empty()) {
    event_job_ = std::move(events_.front());
    events_.pop_front();
  } else if (key_) {
    frame_job_ = std::exchange(key_, std::nullopt);
  } else if (delta_) {
    frame_job_ = std::exchange(delta_, std::nullopt);
  }
  return event_job_ || frame_job_;
}

void Broadcaster::end_job() {
  if (event_job_) backlog_.fetch_sub(1, std::memory_order_relaxed);
  event_job_.reset();
  frame_job_.reset();
  std::erase_if(members_, [](const Member& member) { return !member.subscriber; });
}

void Broadcaster::serve(const Member& member) const {
  if (!member.subscriber) return;
  if (event_job_ && !event_job_->line) {
    if (event_job_->session == member.session) member.subscriber->let_go();
    return;
  }
  if (event_job_) {
    if (event_job_->number >= member.first_event) member.subscriber->deliver(event_job_->line);
    return;
  }
  for (const ChannelFrame& entry : *frame_job_)
    if (entry.channel == member.channel) return member.subscriber->show(entry.frame);
}

void Broadcaster::wake() {
  if (std::exchange(awake_, true)) return;
  asio::post(strand_, [self = shared_from_this(), this] { hand_out_slice(); });
}

void Broadcaster::hand_out_slice() {
  if (!event_job_ && !frame_job_ && !begin_job()) {
    awake_ = false;
    return;
  }
  const std::size_t end = std::min(members_.size(), next_member_ + kSlice);
  for (; next_member_ < end; ++next_member_) serve(members_[next_member_]);
  if (next_member_ == members_.size()) end_job();
  asio::post(strand_, [self = shared_from_this(), this] { hand_out_slice(); });
}

}  // namespace woodlouse::server
