#include "shared/protocol/codes.h"

#include <array>

namespace woodlouse::protocol {
namespace {

constexpr std::array kCodes = {
    CodeEntry{code::kBadJson, "error, bye", Ends::kRepeated,
              "the line is not JSON: syntax, invalid UTF-8, NaN, a number no double can hold"},
    CodeEntry{code::kNotAnObject, "error", Ends::kNo, "the line is JSON, but not an object"},
    CodeEntry{code::kDuplicateKey, "error", Ends::kNo, "an object holds the same key twice"},
    CodeEntry{code::kTooDeep, "error", Ends::kNo, "objects and arrays are nested deeper than 8"},
    CodeEntry{code::kUnknownType, "error", Ends::kNo,
              "no message has this `type`; the text lists those there are"},
    CodeEntry{code::kMissingField, "error", Ends::kNo, "a required field is not there"},
    CodeEntry{code::kBadField, "error", Ends::kNo, "a field has the wrong kind or is out of range"},
    CodeEntry{code::kBadProtocol, "error, bye", Ends::kYes,
              "the client speaks another version of the protocol"},
    CodeEntry{code::kLineTooLong, "error, bye", Ends::kYes, "a line is longer than `limits.line` bytes"},
    CodeEntry{code::kNotJoined, "error", Ends::kNo, "this message needs a `join` first"},
    CodeEntry{code::kAlreadyJoined, "error", Ends::kNo, "a session joins once"},
    CodeEntry{code::kUnknownRoom, "error", Ends::kNo,
              "no room has this name; the text lists those there are"},
    CodeEntry{code::kRoomFull, "error", Ends::kNo, "the room has no place for another one of that role"},
    CodeEntry{
        code::kTooManyConnections, "error, bye", Ends::kYes,
        "the address has `limits.per_address` connections already, or the server `limits.max_connections`"},
    CodeEntry{code::kRateLimited, "error", Ends::kNo,
              "more than a limit allows to the session, its address or the room; this message was dropped, "
              "`retry_after_ms` says for how long"},
    CodeEntry{code::kFlood, "error, bye", Ends::kYes, "messages kept coming long after `rate_limited`"},
    CodeEntry{code::kHandshakeTimeout, "error, bye", Ends::kYes, "no `join` within `limits.handshake_s`"},
    CodeEntry{code::kIdle, "error, bye", Ends::kYes,
              "nothing read and nothing written for `limits.idle_s`, or nobody came back for "
              "`limits.vacant_s` and `resume_s`"},
    CodeEntry{code::kSlow, "error, bye", Ends::kYes, "the client reads too slowly, even for keys alone"},
    CodeEntry{code::kBanned, "error, bye", Ends::kYes,
              "the operator has banned the address or the name; the text says until when"},
    CodeEntry{code::kKicked, "error, bye", Ends::kYes,
              "the operator or a moderator has ended the connection"},
    CodeEntry{code::kMuted, "error", Ends::kNo,
              "the operator or a moderator has muted the player: chat is dropped"},
    CodeEntry{
        code::kBadToken, "error", Ends::kNo,
        "the server has passwords: `join.token` is none of them, or is not to be said over this connection"},
    CodeEntry{code::kNoRight, "error", Ends::kNo,
              "`moderate` is for who joined with the token of a moderator or admin"},
    CodeEntry{code::kNotModerated, "error", Ends::kNo,
              "nobody in the room is called so, or it can't be done; the text says which"},
    CodeEntry{code::kStaleSeq, "error", Ends::kNo, "input dropped: `seq` is not above the last one"},
    CodeEntry{code::kQueueFull, "error", Ends::kNo,
              "input dropped: too many of this player's inputs wait, or came later for the same step"},
    CodeEntry{code::kTooFar, "error", Ends::kNo, "input dropped: `tick` is more than 2 s ahead"},
    CodeEntry{code::kNoLouse, "error", Ends::kNo, "the session has no louse: it is a spectator"},
    CodeEntry{code::kNoRecords, "error", Ends::kNo,
              "the room keeps no records, or its board has no row of that rank"},
    CodeEntry{code::kNoVote, "error", Ends::kNo,
              "the room plays one game alone, or the session has no vote: it is a bot"},
    CodeEntry{code::kOnlyShown, "error", Ends::kNo,
              "the room is played at another server and only shown here: what was said reaches nobody"},
    CodeEntry{code::kLeft, "bye", Ends::kYes, "the client sent `leave`, or ended its sending side"},
    CodeEntry{code::kShutdown, "bye", Ends::kYes, "the server stops"},
    CodeEntry{code::kReplaced, "bye", Ends::kYes, "the player came back over another connection"},
    CodeEntry{code::kMoved, "error, bye", Ends::kYes,
              "the room is at another server now, at `address` where that is known: join it there, with the "
              "`resume_token` of the `welcome`"},
    CodeEntry{code::kRateLowered, "notice", Ends::kNo,
              "frames come at half the rate: the client reads slowly"},
    CodeEntry{code::kKeysOnly, "notice", Ends::kNo, "only keys come: the client reads very slowly"},
    CodeEntry{code::kRateRestored, "notice", Ends::kNo, "frames come at the full rate again"},
    CodeEntry{code::kDraining, "error, notice", Ends::kNo,
              "the server will stop soon, the text says when; nobody joins any more but who comes back"},
    CodeEntry{
        code::kPaused, "error, notice", Ends::kNo,
        "no tick passes: the operator has paused the room, or, in a cluster of mode strict, nothing can be "
        "stored. As an error: too many have joined or asked for something meanwhile"},
    CodeEntry{code::kResumed, "notice", Ends::kNo, "the room goes on"},
    CodeEntry{code::kModerated, "notice", Ends::kNo, "what a moderator asked for is done"},
    CodeEntry{code::kOperator, "notice", Ends::kNo, "the operator or a moderator says the text to all"},
    CodeEntry{code::kRecordingEnded, "notice", Ends::kNo,
              "the game goes on, but is no longer recorded: the disk is full or too slow, or its share is "
              "used up. Whoever joins later hears it behind the welcome"},
    CodeEntry{
        code::kNotDurable, "notice", Ends::kNo,
        "nothing that is played reaches the cluster's log: it would be lost with this server, and the game "
        "goes on. Whoever joins later hears it behind the welcome"},
    CodeEntry{code::kDurable, "notice", Ends::kNo, "what is played is in the cluster's log again"},
};

}  // namespace

std::span<const CodeEntry> codes() { return kCodes; }

}  // namespace woodlouse::protocol
