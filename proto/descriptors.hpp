/// How many files and connections this process may have open at a time.
#pragma once

namespace fpi::proto {

/// Raises the limit as far as the system lets it, to 65536 at most, so that connections of strangers take
/// none that results need. Says so in the log where that leaves few.
void raise_descriptor_limit();

}  // namespace fpi::proto
