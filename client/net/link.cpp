#include "client/net/link.h"

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/write.hpp>
#include <utility>
#include <variant>

#include "shared/core/joined.h"
#include "shared/follow/follower.h"
#include "shared/match/match.h"
#include "shared/protocol/codec.h"
#include "shared/protocol/codes.h"

namespace woodlouse::client {

using boost::system::error_code;

namespace {

std::string in_words(error_code error) {
  namespace asio = boost::asio;
  if (error == asio::error::eof) return "the server closed the connection";
  if (error == asio::error::connection_refused) return kConnectionRefused;
  if (error == asio::error::connection_reset) return "connection reset";
  if (error == asio::error::host_not_found || error == asio::error::host_not_found_try_again)
    return "host not found";
  return error.message();
}

protocol::Join by_frames(protocol::Join join) {
  if (std::exchange(join.stream, protocol::Stream::kFrames) == protocol::Stream::kInputs)
    join.state_hz.reset();
  return join;
}

/// Where the server has rules of play, also with their columns, unless every column is spoken for by a proof.
/// By inputs only what this program can re-run.
protocol::Join asked_of(const protocol::Hello& hello, protocol::Join join) {
  const auto has = [&hello](std::string_view feature) {
    return std::find(hello.features.begin(), hello.features.end(), feature) != hello.features.end();
  };
  if (!has("inputs") || hello.behavior != match::kBehavior) join = by_frames(std::move(join));
  if (!has("rules") || join.fields.empty() || join.fields == protocol::all_columns()) return join;
  for (const protocol::Column column : protocol::kRulesColumns) join.fields.push_back(column);
  return join;
}

}  // namespace

Link::Link(boost::asio::io_context& context, protocol::Join join, LinkListener& listener)
    : join_(std::move(join)),
      listener_(&listener),
      resolver_(context),
      socket_(context),
      watchdog_(context) {}

void Link::open(const Address& address, std::chrono::seconds patience) {
  patience_ = patience;
  watch(kReachPatience, "no answer within " + std::to_string(kReachPatience.count()) + " s");
  resolver_.async_resolve(
      address.host, std::to_string(address.port),
      [self = shared_from_this()](error_code error, const Tcp::resolver::results_type& endpoints) {
        if (error) return self->end({in_words(error)});
        self->on_resolved(endpoints);
      });
}

void Link::on_resolved(const Tcp::resolver::results_type& endpoints) {
  if (listener_ == nullptr) return;
  reached_ = Reached::kName;
  boost::asio::async_connect(socket_, endpoints,
                             [self = shared_from_this()](error_code error, const Tcp::endpoint&) {
                               if (self->listener_ == nullptr) return;
                               if (error) return self->end({in_words(error)});
                               self->reached_ = Reached::kHost;
                               self->watch(kGreetPatience, "it takes the connection and says nothing");
                               error_code ignored_where_unsupported;  // without it inputs are only later
                               self->socket_.set_option(Tcp::no_delay(true), ignored_where_unsupported);
                               self->read();
                             });
}

void Link::read() {
  socket_.async_read_some(boost::asio::buffer(incoming_),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            if (self->listener_ == nullptr) return;
                            self->framer_.append({self->incoming_.data(), size});
                            self->take_lines();
                            if (self->listener_ == nullptr) return;
                            if (error) return self->end(self->farewell_.value_or(Closing{in_words(error)}));
                            if (self->joined_) self->watch(kSilence, "the server has fallen silent");
                            self->read();
                          });
}

void Link::take_lines() {
  while (listener_ != nullptr) {
    const auto line = framer_.next();
    if (!line) return;
    if (line->oversize) {
      const bool greets = reached_ != Reached::kServer;
      const std::size_t most = greets ? kMaxHelloBytes : kMaxLineBytes;
      return end({core::joined({greets ? "no woodlouse server answers there: its first line has more than "
                                       : "the server sent a line of more than ",
                                std::to_string(most), " bytes"}),
                  kNoServerOfOurs});
    }
    if (welcome_.stream == protocol::Stream::kInputs && follow::Follower::is_recorded(line->text)) {
      listener_->on_recorded(line->text, std::chrono::steady_clock::now());
      continue;
    }
    const auto message = protocol::decode_server(line->text, welcome_.fields, welcome_.format);
    if (message) {
      take(*message);
    } else if (message.error().code != "unknown_type") {  // a newer server may say things we need not know
      end({"no woodlouse server answers there: " + message.error().text, kNoServerOfOurs});
    }
  }
}

void Link::take(const protocol::ServerMessage& message) {
  if (const auto* hello = std::get_if<protocol::Hello>(&message)) {
    if (hello->protocol != protocol::kProtocolVersion) {
      return end({"the server speaks protocol " + std::to_string(hello->protocol) + ", this client " +
                      std::to_string(protocol::kProtocolVersion),
                  kNoServerOfOurs});
    }
    reached_ = Reached::kServer;
    framer_.limit(kMaxLineBytes);
    watch(patience_, "no welcome within " + std::to_string(patience_.count()) + " s");
    protocol::Join join = asked_of(*hello, join_);
    write(protocol::encode(protocol::ClientMessage(join)));
    if (join.stream == protocol::Stream::kInputs) by_frames_ = by_frames(std::move(join));
  } else if (const auto* welcome = std::get_if<protocol::Welcome>(&message)) {
    welcome_ = *welcome;
    joined_ = true;
  } else if (const auto* error = std::get_if<protocol::ErrorMessage>(&message);
             error != nullptr && (error->fatal || !joined_)) {
    if (!error->fatal && by_frames_ && error->code == protocol::code::kBadField) {
      write(protocol::encode(protocol::ClientMessage(*std::exchange(by_frames_, std::nullopt))));
      return;
    }
    farewell_ = Closing{error->text, error->code, {}, {}, error->address};
    if (error->retry_after_ms) farewell_->retry_after = std::chrono::milliseconds(*error->retry_after_ms);
    if (!joined_) return end(*farewell_);
  } else if (const auto* bye = std::get_if<protocol::Bye>(&message)) {
    if (!farewell_) farewell_ = Closing{bye->text, bye->code, {}, {}, bye->address};
    // Whoever is sent on need not wait until this server has ended the line, too.
    if (farewell_->code == protocol::code::kMoved) return end(*farewell_);
  }
  if (listener_ != nullptr) listener_->on_message(message, std::chrono::steady_clock::now());
}

void Link::send(const protocol::ClientMessage& message) {
  if (joined_) write(protocol::encode(message));
}

void Link::write(const std::string& line) {
  if (listener_ == nullptr) return;
  if (unsent_.size() + line.size() > kMaxUnsentBytes) return end({"the server takes nothing any more"});
  unsent_ += line;
  if (sending_.empty()) flush();
}

void Link::flush() {
  std::swap(sending_, unsent_);
  boost::asio::async_write(socket_, boost::asio::buffer(sending_),
                           [self = shared_from_this()](error_code error, std::size_t) {
                             self->sending_.clear();
                             if (self->listener_ == nullptr) return;
                             // A failing write: the read that is under way brings the reason, the server's
                             // bye before it.
                             if (!error && !self->unsent_.empty()) self->flush();
                           });
}

void Link::watch(std::chrono::seconds patience, std::string reason) {
  watchdog_.expires_after(patience);
  watchdog_.async_wait([self = shared_from_this(), reason = std::move(reason)](error_code error) {
    if (error) return;
    // Who was asleep wakes up with the alarm, and with all that has come meanwhile.
    error_code gone;
    if (self->joined_ && self->socket_.available(gone) > 0) return self->watch(kSilence, reason);
    self->end({reason});
  });
}

void Link::end(Closing closing) {
  LinkListener* const listener = listener_;
  closing.reached = reached_;
  close();
  if (listener != nullptr) listener->on_closed(closing);
}

int Link::descriptor() { return socket_.is_open() ? socket_.native_handle() : -1; }

void Link::close() {
  listener_ = nullptr;
  resolver_.cancel();
  watchdog_.cancel();
  error_code nothing_to_do_about_it;
  socket_.close(nothing_to_do_about_it);
}

}  // namespace woodlouse::client
