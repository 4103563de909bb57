/// Files that are either the old one or the new one, whole, at any moment: written beside and then renamed.
/// A reader has the one that it opened for as long as it likes, and needs no lock.
#pragma once

#include <string>
#include <string_view>

namespace fpi::output {

/// When a file is to outlive a crash of the machine; one of this process it outlives in any case.
enum class Durable { now, after_sync };

/// What a file that will replace `path` is called before.
inline std::string temporary_name(const std::string& path) { return path + ".new"; }

/// Gives `temporary_name(path)`, written and closed, the name `path`. Throws Error.
void replace_file(const std::string& path, Durable durable = Durable::now);

/// Writes a text file in that way. Throws Error.
void replace_text(const std::string& path, std::string_view text, Durable durable = Durable::now);

/// Brings a folder, its files and folders to the disk. Throws Error naming what cannot be.
void sync_folder(const std::string& folder);

}  // namespace fpi::output
