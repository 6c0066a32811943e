#include "server/room/broadcaster.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <string>
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
    if (!has_job()) end_job();
  });
}

void Broadcaster::change(SessionId session, ChannelId channel) {
  asio::post(strand_, [self = shared_from_this(), this, session, channel] {
    for (Member& member : members_)
      if (member.session == session) member.channel = channel;
  });
}

void Broadcaster::event(std::uint64_t number, Line line) {
  backlog_.fetch_add(1, std::memory_order_relaxed);
  asio::post(strand_, [self = shared_from_this(), this, event = Event{number, std::move(line), 0}]() mutable {
    events_.push_back(std::move(event));
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

void Broadcaster::part(StreamPart part) {
  assert(part.kind == StreamPart::Kind::kSteps);
  asio::post(strand_, [self = shared_from_this(), this, added = std::move(part)]() mutable {
    if (parts_.size() >= kMostParts) parts_.clear();
    parts_.push_back(std::move(added));
    wake();
  });
}

void Broadcaster::drop_frames() {
  asio::post(strand_, [self = shared_from_this(), this] {
    key_.reset();
    delta_.reset();
    parts_.clear();
    if (frame_job_ || !part_job_.empty()) end_job();
  });
}

/// Those who are to go and have heard all events before.
void Broadcaster::let_those_go() {
  for (; !events_.empty() && !events_.front().line; events_.pop_front()) {
    for (const Member& member : members_)
      if (member.subscriber && member.session == events_.front().session) member.subscriber->let_go();
    backlog_.fetch_sub(1, std::memory_order_relaxed);
  }
}

/// Up to the first who is to go.
Broadcaster::Batch Broadcaster::take_events() {
  assert(!events_.empty() && events_.front().line);
  Batch batch;
  std::string all;
  while (!events_.empty() && events_.front().line) {
    const std::string& line = *events_.front().line;
    if (!batch.events.empty() && all.size() + line.size() > kBatchBytes) break;
    all += line;
    batch.events.push_back(std::move(events_.front()));
    events_.pop_front();
  }
  batch.all = batch.events.size() == 1 ? batch.events.front().line : Line(std::move(all));
  return batch;
}

bool Broadcaster::begin_job() {
  next_member_ = 0;
  let_those_go();
  const bool has_frames = key_ || delta_;
  if (!events_.empty() && !(is_frames_turn_ && (has_frames || !parts_.empty()))) {
    event_job_ = take_events();
  } else if (!parts_.empty() && (is_parts_turn_ || !has_frames)) {
    part_job_ = std::exchange(parts_, {});
  } else if (key_) {
    frame_job_ = std::exchange(key_, std::nullopt);
  } else if (delta_) {
    frame_job_ = std::exchange(delta_, std::nullopt);
  }
  is_frames_turn_ = event_job_.has_value();
  if (!is_frames_turn_) is_parts_turn_ = part_job_.empty();
  return has_job();
}

void Broadcaster::end_job() {
  if (event_job_) backlog_.fetch_sub(event_job_->events.size(), std::memory_order_relaxed);
  event_job_.reset();
  frame_job_.reset();
  part_job_.clear();
  std::erase_if(members_, [](const Member& member) { return !member.subscriber; });
}

void Broadcaster::serve(const Member& member) const {
  if (!member.subscriber) return;
  if (event_job_) {
    if (event_job_->events.front().number >= member.first_event)
      return member.subscriber->deliver(event_job_->all);
    for (const Event& event : event_job_->events)  // it joined between them
      if (event.number >= member.first_event) member.subscriber->deliver(event.line);
    return;
  }
  if (!frame_job_) {
    if (member.channel != kByInputs) return;
    for (const StreamPart& part : part_job_) member.subscriber->follow(part);
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
  if (!has_job() && !begin_job()) {
    awake_ = false;
    return;
  }
  const std::size_t end = std::min(members_.size(), next_member_ + kSlice);
  for (; next_member_ < end; ++next_member_) serve(members_[next_member_]);
  if (next_member_ == members_.size()) end_job();
  asio::post(strand_, [self = shared_from_this(), this] { hand_out_slice(); });
}

}  // namespace woodlouse::server
