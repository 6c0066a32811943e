#include "client/play/join_request.h"

#include <cassert>

#include "client/play/view_state.h"

namespace woodlouse::client {
namespace {

constexpr std::uint32_t kStreamHz = 20;  // parts of the stream a second

}  // namespace

protocol::Join make_join(protocol::Role role, const std::string& name, const std::string& room,
                         Hashes hashes) {
  protocol::Join join;
  join.role = role;
  join.may_resume = role != protocol::Role::kSpectator;
  join.name = name;
  join.room = room;
  join.fields = wanted_columns();
  if (hashes == Hashes::kVerified) {
    join.fields = protocol::all_columns();
    join.format = protocol::Format::kExact;
  }
  return join;
}

protocol::Join by_inputs(protocol::Join join) {
  assert(join.role == protocol::Role::kSpectator);
  join.stream = protocol::Stream::kInputs;
  join.state_hz = kStreamHz;
  return join;
}

}  // namespace woodlouse::client
