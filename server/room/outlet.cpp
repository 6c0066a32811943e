#include "server/room/outlet.h"

#include <boost/asio/post.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace woodlouse::server {

namespace asio = boost::asio;

Outlet::Outlet(const Lanes& lanes) : strand_(asio::make_strand(lanes.io())) {
  for (std::size_t k = 0; k < lanes.size(); ++k) lanes_.push_back(std::make_shared<Broadcaster>(lanes[k]));
}

void Outlet::open(ChannelId channel, RowLayout layout) {
  asio::post(strand_, [self = shared_from_this(), channel, layout = std::move(layout)]() mutable {
    self->channels_.open(channel, std::move(layout));
  });
}

void Outlet::close(ChannelId channel) {
  asio::post(strand_, [self = shared_from_this(), channel] { self->channels_.close(channel); });
}

void Outlet::show_newest(ChannelId channel, std::shared_ptr<Subscriber> subscriber, SharedSnapshot now) {
  assert(subscriber != nullptr && now);
  asio::post(strand_,
             [self = shared_from_this(), channel, subscriber = std::move(subscriber), now = std::move(now)] {
               for (const Frame& frame : self->channels_.newest(channel, now->scene()))
                 subscriber->show_again(frame);
               self->encoded_.store(self->channels_.encoded(), std::memory_order_relaxed);
             });
}

void Outlet::add(Broadcaster::Member member) {
  assert(member.subscriber != nullptr && member.subscriber->lane() < lanes_.size());
  asio::post(strand_, [self = shared_from_this(), member = std::move(member)]() mutable {
    Broadcaster& lane = *self->lanes_[member.subscriber->lane()];
    lane.add(std::move(member));
  });
}

void Outlet::remove(SessionId session, std::size_t lane) {
  asio::post(strand_, [self = shared_from_this(), session, lane] { self->lanes_[lane]->remove(session); });
}

void Outlet::event(std::uint64_t number, Line line) {
  events_.fetch_add(1, std::memory_order_relaxed);
  asio::post(strand_, [self = shared_from_this(), number, line = std::move(line)] {
    for (const auto& lane : self->lanes_) lane->event(number, line);
    self->events_.fetch_sub(1, std::memory_order_relaxed);
  });
}

void Outlet::let_go(SessionId session, std::size_t lane) {
  asio::post(strand_, [self = shared_from_this(), session, lane] { self->lanes_[lane]->let_go(session); });
}

void Outlet::show(FrameKind kind, SharedSnapshot now) {
  assert(now);
  asio::post(strand_, [self = shared_from_this(), kind, now = std::move(now)]() mutable {
    const bool waits = static_cast<bool>(self->due_);
    // A key that is skipped is made up for: deltas would rest on one that nobody has.
    if (!waits || kind == FrameKind::kKey) self->due_kind_ = kind;
    self->due_ = std::move(now);
    // Behind all that has been posted by now: of several snapshots the newest.
    if (!waits) asio::post(self->strand_, [self] { self->encode(); });
  });
}

void Outlet::flush() {
  asio::post(strand_, [self = shared_from_this()] { self->encode(); });
}

void Outlet::keep(std::shared_ptr<const void> what) {
  flush();
  asio::post(strand_, [self = shared_from_this(), what = std::move(what)]() mutable { what.reset(); });
}

void Outlet::change(SessionId session, std::size_t lane, ChannelId channel) {
  asio::post(strand_, [self = shared_from_this(), session, lane, channel] {
    self->lanes_[lane]->change(session, channel);
  });
}

void Outlet::show_step(SharedStep step, std::optional<InputStream::Quiet> goes_out) {
  assert(step != nullptr);
  asio::post(strand_, [self = shared_from_this(), step = std::move(step), goes_out] {
    self->stream_.step(*step);
    if (goes_out) self->hand_out(self->stream_.take(*goes_out));
  });
}

void Outlet::show_steps_left() {
  asio::post(strand_, [self = shared_from_this()] {
    StreamPart part = self->stream_.take(InputStream::Quiet::kTold).value_or(StreamPart{});
    part.is_last = true;
    self->hand_out(std::move(part));
  });
}

void Outlet::keep_keyframe(match::MatchState state, std::uint64_t kept_ticks) {
  asio::post(strand_, [self = shared_from_this(), state = std::move(state), kept_ticks]() mutable {
    self->hand_out(self->stream_.take(InputStream::Quiet::kTold));
    self->stream_.keyframe(std::move(state), kept_ticks);
  });
}

void Outlet::show_keyframe(std::shared_ptr<Subscriber> subscriber, Line header) {
  assert(subscriber != nullptr);
  asio::post(strand_,
             [self = shared_from_this(), subscriber = std::move(subscriber), header = std::move(header)] {
               if (header) subscriber->follow({StreamPart::Kind::kHeader, 0, 0, header, true});
               for (StreamPart part : self->stream_.newest()) {
                 part.is_answer = true;
                 subscriber->follow(part);
               }
             });
}

void Outlet::hand_out(std::optional<StreamPart> part) {
  if (!part) return;
  for (const auto& lane : lanes_) lane->part(*part);
}

void Outlet::begin_anew() {
  asio::post(strand_, [self = shared_from_this()] {
    self->due_ = {};
    self->stream_.begin_anew();
    self->channels_.begin_anew();
    for (const auto& lane : self->lanes_) lane->drop_frames();
  });
}

void Outlet::welcome(std::shared_ptr<Subscriber> subscriber, std::function<protocol::Welcome()> make,
                     std::uint32_t divisor) {
  assert(subscriber != nullptr && make != nullptr);
  asio::post(strand_, [subscriber = std::move(subscriber), make = std::move(make), divisor] {
    subscriber->welcome(make(), divisor);
  });
}

void Outlet::encode() {
  const SharedSnapshot now = std::exchange(due_, {});
  if (!now) return;  // the game that it was of is over
  ChannelFrames frames = channels_.encode(now->scene(), due_kind_);
  encoded_.store(channels_.encoded(), std::memory_order_relaxed);
  if (frames.empty()) return;
  for (std::size_t k = 1; k < lanes_.size(); ++k) lanes_[k]->frames(due_kind_, frames);
  lanes_.front()->frames(due_kind_, std::move(frames));
}

std::size_t Outlet::backlog() const {
  std::size_t most = 0;
  for (const auto& lane : lanes_) most = std::max(most, lane->backlog());
  return most + events_.load(std::memory_order_relaxed);
}

}  // namespace woodlouse::server
