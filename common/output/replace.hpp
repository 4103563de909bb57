/// Files that are either the old one or the new one, whole, at any moment: written beside and then renamed.
#pragma once

#include <string>
#include <string_view>

namespace fpi::output {

/// Brings `temporary` (written and closed) to the disk and gives it the name `path`. Throws Error.
void replace_file(const std::string& temporary, const std::string& path);

/// Writes a text file in that way. Throws Error.
void replace_text(const std::string& path, std::string_view text);

}  // namespace fpi::output
