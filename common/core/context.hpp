/// Where an error comes from, said by the caller that knows it.
#pragma once

#include <string>

#include "core/error.hpp"

namespace fpi {

/// What `action` returns. An Error out of it gets "`where`: " in front: a file, or a key.
template <class Action>
auto in_context(const std::string& where, Action action) {
  try {
    return action();
  } catch (const Error& e) {
    fail("{}: {}", where, e.what());
  }
}

}  // namespace fpi
