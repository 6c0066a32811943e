#include "client/net/unreachable.h"

#include <string>
#include <string_view>

#include "shared/protocol/codes.h"

namespace woodlouse::client {
namespace {

/// The server's words name a field first, which is for programs.
std::string for_people(const Closing& closing) {
  constexpr std::string_view kField = "join.room: ";
  const bool has_field = closing.reason.starts_with(kField);
  return has_field ? closing.reason.substr(kField.size()) : closing.reason;
}

}  // namespace

core::Error why_not_joined(const Address& address, const Closing& closing) {
  const std::string port = std::to_string(address.port);
  const std::string where = "cannot connect to " + address.text();
  switch (closing.reached) {
    case Reached::kNothing:
      return {where, closing.reason,
              "is the name spelt as it should be? HOST:PORT, for example localhost:7777"};
    case Reached::kName:
      if (closing.reason == kConnectionRefused)
        return {where, closing.reason,
                "is the server up?   try:  woodlouse-server --map volcano --listen 0.0.0.0:" + port};
      return {where, closing.reason,
              "is that machine on, and does a firewall let port " + port + " through?"};
    case Reached::kHost:
      return {where, closing.reason,
              "is " + port +
                  " another program's port, or one for TLS or web pages? Players come to that of  "
                  "woodlouse-server --listen"};
    case Reached::kServer:
      break;
  }
  const bool is_room = closing.code == protocol::code::kUnknownRoom;
  return {address.text() + " does not let you in", for_people(closing),
          is_room ? "name one of them:  woodlouse " + address.text() + "/ROOM" : ""};
}

}  // namespace woodlouse::client
