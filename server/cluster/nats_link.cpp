#include "server/cluster/nats_link.h"

#include <nats/nats.h>

#include <algorithm>
#include <cassert>
#include <deque>
#include <utility>
#include <vector>

#include "server/cluster/ear.h"
#include "server/timing/clock.h"
#include "shared/core/joined.h"

namespace woodlouse::server {
namespace {

using core::joined;

constexpr std::int64_t kReadWithinMs = 300;
constexpr std::int64_t kAckWithinMs = 2000;
constexpr std::int64_t kManageWithinMs = 10'000;  // of a stream with replicas

template <typename Thing, void (*Destroy)(Thing*)>
struct Destroyed {
  void operator()(Thing* thing) const { Destroy(thing); }
};
template <typename Thing, void (*Destroy)(Thing*)>
using Owned = std::unique_ptr<Thing, Destroyed<Thing, Destroy>>;
using OwnedMessage = Owned<natsMsg, natsMsg_Destroy>;
using OwnedOptions = Owned<natsOptions, natsOptions_Destroy>;
using OwnedInfo = Owned<jsStreamInfo, jsStreamInfo_Destroy>;
using OwnedSubscription = Owned<natsSubscription, natsSubscription_Destroy>;

core::Error error_of(natsStatus status, const std::string& what) {
  if (status == NATS_INSUFFICIENT_BUFFER || status == NATS_CONNECTION_DISCONNECTED)
    return {what, "NATS is not connected"};
  const char* detail = nats_GetLastError(nullptr);
  std::string text = natsStatus_GetText(status);
  if (detail != nullptr && *detail != 0) text += joined({": ", detail});
  return {what, text};
}

std::string bytes_of(natsMsg* message) {
  return {natsMsg_GetData(message), static_cast<std::size_t>(natsMsg_GetDataLength(message))};
}

core::Error connection_error(natsStatus status, const ClusterSettings& settings) {
  std::string servers;
  for (const std::string& server : settings.nats) servers += joined({servers.empty() ? "" : ", ", server});
  core::Error error = error_of(status, "NATS at " + servers);
  const bool is_refused = status == NATS_CONNECTION_AUTH_FAILED || status == NATS_SSL_ERROR ||
                          status == NATS_SECURE_CONNECTION_REQUIRED ||
                          status == NATS_SECURE_CONNECTION_WANTED || status == NATS_PROTOCOL_ERROR;
  return {error.where, error.what,
          is_refused
              ? "do nats, tls and credentials in the cluster's file fit what NATS asks for? its log says"
              : "is nats-server running there, with -js?"};
}

class Link final : public NatsLink {
 public:
  explicit Link(const ClusterSettings& settings, Told told)
      : stream_(settings.stream()),
        subject_(settings.log_subject()),
        settings_(settings),
        ear_(Ear::make(std::move(told), {})) {}

  ~Link() override {
    ear_->close();
    unfollow();
    for (Ear* ear : ears_) ear->close();
    // First of all, so that libnats' reading thread has ended before anything that it may look at is freed.
    if (connection_ != nullptr) natsConnection_Close(connection_);
    left_.clear();
    subscriptions_.clear();
    if (context_ != nullptr) jsCtx_Destroy(context_);
    if (connection_ != nullptr) natsConnection_Destroy(connection_);
  }

  core::Expected<void> connect(const std::string& purpose) {
    natsOptions* made = nullptr;
    if (const natsStatus status = natsOptions_Create(&made); status != NATS_OK)
      return tl::unexpected(error_of(status, "NATS"));
    const OwnedOptions options(made);
    if (const natsStatus status = set_options(made, purpose); status != NATS_OK)
      return tl::unexpected(error_of(status, "NATS"));
    if (const natsStatus status = natsConnection_Connect(&connection_, made); status != NATS_OK)
      return tl::unexpected(connection_error(status, settings_));
    jsOptions asked;
    jsOptions_Init(&asked);
    asked.Wait = kReadWithinMs;
    asked.PublishAsync.StallWait = 1;
    asked.PublishAsync.AckHandler = [](jsCtx*, natsMsg* message, jsPubAck* ack, jsPubAckErr* refusal,
                                       void* self) {
      auto* ear = static_cast<Ear*>(self);
      if (ack != nullptr)
        ear->on_stored(ack->Sequence);
      else
        ear->on_refused(refusal != nullptr && refusal->ErrText != nullptr ? refusal->ErrText : "no answer");
      natsMsg_Destroy(message);
    };
    asked.PublishAsync.AckHandlerClosure = ear_;
    if (const natsStatus status = natsConnection_JetStream(&context_, connection_, &asked); status != NATS_OK)
      return tl::unexpected(error_of(status, "JetStream"));
    return {};
  }

  core::Expected<void> append(std::string_view bytes, std::uint64_t after) override {
    assert(after > 0);  // 0 would expect nothing; the stream's first message is its maker's
    jsPubOptions options;
    jsPubOptions_Init(&options);
    options.ExpectLastSeq = after;
    options.MaxWait = kAckWithinMs;
    const natsStatus status =
        js_PublishAsync(context_, subject_.c_str(), bytes.data(), static_cast<int>(bytes.size()), &options);
    if (status != NATS_OK) return tl::unexpected(error_of(status, subject_));
    return {};
  }

  core::Expected<Message> last() override {
    natsMsg* found = nullptr;
    jsErrCode code{};
    // Of any subject: another stream's consumer may deliver into this one, under the subject that it had
    // there, and what stands last is what the next publish has to expect.
    const natsStatus status = js_GetLastMsg(&found, context_, stream_.c_str(), ">", nullptr, &code);
    if (status != NATS_NOT_FOUND) return message_of(status, found);
    // Empty, or damaged. What is added between the two answers has the fence refuse who goes by this one.
    const auto state = stream_state();
    if (!state || state->messages == 0) return message_of(status, found);
    return read(state->last);
  }
  core::Expected<Message> read(std::uint64_t sequence) override {
    natsMsg* found = nullptr;
    jsErrCode code{};
    const natsStatus status = js_GetMsg(&found, context_, stream_.c_str(), sequence, nullptr, &code);
    if (status == NATS_NOT_FOUND) return Message{sequence, {}};
    return message_of(status, found);
  }

  core::Expected<void> follow(std::uint64_t from, NatsMessageTaken taken) override {
    unfollow();
    following_ = Ear::make({}, std::move(taken));
    jsSubOptions options;
    jsSubOptions_Init(&options);
    options.Ordered = true;
    options.Stream = stream_.c_str();
    options.Config.DeliverPolicy = js_DeliverByStartSequence;
    options.Config.OptStartSeq = from;
    natsSubscription* made = nullptr;
    jsErrCode code{};
    const natsStatus status = js_Subscribe(
        &made, context_, subject_.c_str(),
        [](natsConnection*, natsSubscription*, natsMsg* message, void* closure) {
          const OwnedMessage owned(message);
          jsMsgMetaData* data = nullptr;
          if (natsMsg_GetMetaData(&data, message) != NATS_OK) return;
          const std::uint64_t sequence = data->Sequence.Stream;
          jsMsgMetaData_Destroy(data);
          static_cast<Ear*>(closure)->on_message(natsMsg_GetSubject(message), bytes_of(message), sequence);
        },
        following_, nullptr, &options, &code);
    if (status != NATS_OK) return tl::unexpected(error_of(status, stream_));
    log_ = OwnedSubscription(made);
    return {};
  }
  void unfollow() override {
    if (following_ != nullptr) std::exchange(following_, nullptr)->close();
    if (log_ == nullptr) return;
    // The reading thread of libnats 3.4 may have found a subscription and not locked it yet: were it freed
    // now, that would be a lock in freed memory (nats.c 637). It is freed a while later.
    constexpr Duration kLongAgo = std::chrono::seconds(60);
    const Time now = Clock::now();
    while (!left_.empty() && now - left_.front().first > kLongAgo) left_.pop_front();
    natsSubscription_Unsubscribe(log_.get());
    left_.emplace_back(now, std::move(log_));
  }

  core::Expected<bool> make_stream(std::string_view first) override {
    if (const auto state = stream_state(); state && state->messages > 0) return false;
    jsStreamConfig config;
    jsStreamConfig_Init(&config);
    const char* subjects[] = {subject_.c_str()};
    config.Name = stream_.c_str();
    config.Subjects = subjects;
    config.SubjectsLen = 1;
    config.Storage = js_FileStorage;
    config.Replicas = settings_.replicas;
    config.MaxAge = std::chrono::duration_cast<std::chrono::nanoseconds>(settings_.keep).count();
    config.DenyDelete = true;
    config.Duplicates = 0;
    jsOptions asked;
    jsOptions_Init(&asked);
    asked.Wait = kManageWithinMs;
    jsErrCode code{};
    jsStreamInfo* made = nullptr;
    const natsStatus status = js_AddStream(&made, context_, &config, &asked, &code);
    const OwnedInfo info(made);
    if (status != NATS_OK) {
      const core::Error error = error_of(status, stream_);
      return core::fail(
          error.where, error.what,
          status == NATS_TIMEOUT ? "NATS does not answer who may not ask: its log says so" : "");
    }
    if (info->State.Msgs > 0) return false;
    jsPubAck* ack = nullptr;
    jsPubOptions options;
    jsPubOptions_Init(&options);
    options.MaxWait = kManageWithinMs;
    const natsStatus stored = js_Publish(&ack, context_, subject_.c_str(), first.data(),
                                         static_cast<int>(first.size()), &options, &code);
    if (stored != NATS_OK) return tl::unexpected(error_of(stored, stream_));
    jsPubAck_Destroy(ack);
    return true;
  }

  core::Expected<StreamState> stream_state() override {
    jsErrCode code{};
    jsStreamInfo* found = nullptr;
    const natsStatus status = js_GetStreamInfo(&found, context_, stream_.c_str(), nullptr, &code);
    const OwnedInfo info(found);
    if (status != NATS_OK) return tl::unexpected(error_of(status, stream_));
    StreamState state{
        info->State.FirstSeq, info->State.LastSeq, info->State.Msgs, info->State.Bytes, 1, 1, {}};
    if (const jsClusterInfo* cluster = info->Cluster) {
      state.leader = cluster->Leader != nullptr ? cluster->Leader : "";
      for (int k = 0; k < cluster->ReplicasLen; ++k) {
        ++state.replicas;
        state.current += cluster->Replicas[k]->Current ? 1 : 0;
      }
    }
    return state;
  }

  core::Expected<void> publish(const std::string& subject, std::string_view bytes) override {
    const natsStatus status =
        natsConnection_Publish(connection_, subject.c_str(), bytes.data(), static_cast<int>(bytes.size()));
    if (status != NATS_OK) return tl::unexpected(error_of(status, subject));
    return {};
  }

  core::Expected<void> subscribe(const std::string& subject, NatsMessageTaken taken) override {
    Ear* const ear = ears_.emplace_back(Ear::make({}, std::move(taken)));
    natsSubscription* made = nullptr;
    const natsStatus status = natsConnection_Subscribe(
        &made, connection_, subject.c_str(),
        [](natsConnection*, natsSubscription*, natsMsg* message, void* closure) {
          const OwnedMessage owned(message);
          static_cast<Ear*>(closure)->on_message(natsMsg_GetSubject(message), bytes_of(message), 0);
        },
        ear);
    if (status != NATS_OK) return tl::unexpected(error_of(status, subject));
    subscriptions_.emplace_back(made);
    return {};
  }

 private:
  static core::Expected<Message> message_of(natsStatus status, natsMsg* found) {
    const OwnedMessage owned(found);
    if (status != NATS_OK) return tl::unexpected(error_of(status, "the log"));
    return Message{natsMsg_GetSequence(found), bytes_of(found)};
  }

  natsStatus set_options(natsOptions* options, const std::string& purpose) {
    std::vector<const char*> servers;
    for (const std::string& server : settings_.nats) servers.push_back(server.c_str());
    const std::string name = joined({"woodlouse ", settings_.host, " ", purpose});
    natsStatus status = natsOptions_SetServers(options, servers.data(), static_cast<int>(servers.size()));
    const auto then = [&status](natsStatus next) { status = status == NATS_OK ? next : status; };
    then(natsOptions_SetName(options, name.c_str()));
    then(natsOptions_SetTimeout(options, 2000));
    then(natsOptions_SetAllowReconnect(options, true));
    then(natsOptions_SetMaxReconnect(options, -1));
    then(natsOptions_SetReconnectWait(options, 50));
    then(natsOptions_SetReconnectJitter(options, 20, 20));
    then(natsOptions_SetPingInterval(options, 1000));
    then(natsOptions_SetMaxPingsOut(options, 2));
    then(natsOptions_SetSendAsap(options, true));
    then(natsOptions_SetWriteDeadline(options, 250));
    // What could not be sent is old when the line is back: the log goes again by its own rules, beats are
    // told anew.
    then(natsOptions_SetReconnectBufSize(options, 0));
    then(natsOptions_SetDisconnectedCB(
        options, [](natsConnection*, void* self) { static_cast<Ear*>(self)->on_connected(false); }, ear_));
    then(natsOptions_SetReconnectedCB(
        options, [](natsConnection*, void* self) { static_cast<Ear*>(self)->on_connected(true); }, ear_));
    then(natsOptions_SetClosedCB(
        options, [](natsConnection*, void* self) { static_cast<Ear*>(self)->on_closed(); }, ear_));
    // Else libnats writes it to standard error.
    then(natsOptions_SetErrorHandler(
        options, [](natsConnection*, natsSubscription*, natsStatus, void*) {}, nullptr));
    if (!settings_.credentials.empty())
      then(natsOptions_SetUserCredentialsFromFiles(options, settings_.credentials.c_str(), nullptr));
    if (!settings_.authority.empty()) {
      then(natsOptions_SetSecure(options, true));
      then(natsOptions_LoadCATrustedCertificates(options, settings_.authority.c_str()));
    }
    if (!settings_.certificate.empty())
      then(natsOptions_LoadCertificatesChain(options, settings_.certificate.c_str(), settings_.key.c_str()));
    return status;
  }

  const std::string stream_, subject_;
  const ClusterSettings settings_;
  Ear* const ear_;
  natsConnection* connection_ = nullptr;
  jsCtx* context_ = nullptr;
  Ear* following_ = nullptr;
  OwnedSubscription log_;
  std::deque<std::pair<Time, OwnedSubscription>> left_;  ///< when; not freed yet
  std::vector<Ear*> ears_;
  std::vector<OwnedSubscription> subscriptions_;
};

}  // namespace

core::Expected<std::unique_ptr<NatsLink>> NatsLink::open(const ClusterSettings& settings,
                                                         const std::string& purpose, Told told) {
  assert(!settings.nats.empty() && !settings.host.empty());
  auto link = std::make_unique<Link>(settings, std::move(told));
  if (auto connected = link->connect(purpose); !connected) return tl::unexpected(connected.error());
  return link;
}

}  // namespace woodlouse::server
