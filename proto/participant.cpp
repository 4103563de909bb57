#include "proto/participant.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace fpi::proto {

std::string_view content(const std::vector<File>& files, const std::string& name) {
  const auto found = std::ranges::find(files, name, &File::name);
  require(found != files.end(),
          "the file {} is required, as the scene names it; it was not sent with the scene", name);
  return {reinterpret_cast<const char*>(found->bytes.data()), found->bytes.size()};
}

}  // namespace fpi::proto
