// Why a server could not be joined, in words: what failed, and what to try.
#pragma once

#include "client/net/address.h"
#include "client/net/closing.h"
#include "shared/core/error.h"

namespace woodlouse::client {

/// where: a sentence's beginning with the address in it. Pure.
core::Error why_not_joined(const Address& address, const Closing& closing);

}  // namespace woodlouse::client
