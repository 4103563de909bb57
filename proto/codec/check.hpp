/// What makes a message usable beyond its form: finite numbers, lengths that belong together, values in
/// range.
#pragma once

#include "proto/messages.hpp"

namespace fpi::proto {

/// Throws Error naming the message, the member and what was required of it.
void check(const Message& message);

}  // namespace fpi::proto
