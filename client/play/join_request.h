// What our client asks for when it joins.
#pragma once

#include <string>

#include "client/play/keyframe_verifier.h"
#include "shared/protocol/messages.h"

namespace woodlouse::client {

/// The join of our client: its columns, its format; its louse is to wait for it.
protocol::Join make_join(protocol::Role role, const std::string& name, const std::string& room,
                         Hashes hashes = Hashes::kIgnored);
/// The same of a watcher by inputs, where the server offers that.
protocol::Join by_inputs(protocol::Join join);

}  // namespace woodlouse::client
