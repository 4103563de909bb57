/// The token of a run: a random text that every participant without keys must show. The coupler writes it to
/// a file that its owner alone can read, and whoever may read that file may take part.
#pragma once

#include <string>

namespace fpi::proto {

/// 256 random bits as 64 hexadecimal digits.
std::string make_token();

/// Reads a token file. Throws Error where it is missing, open to others or holds something else.
std::string read_token(const std::string& path);

/// The file of a new token, there as long as this object.
class TokenFile {
 public:
  /// Writes FOLDER/.token; where that file system keeps no permissions, a file in the folder for temporary
  /// ones. Throws Error where neither can be written.
  explicit TokenFile(const std::string& folder);
  ~TokenFile();
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;

  const std::string& path() const { return path_; }  ///< absolute
  const std::string& token() const { return token_; }

 private:
  void write(const std::string& path);

  std::string token_ = make_token(), path_;
};

}  // namespace fpi::proto
