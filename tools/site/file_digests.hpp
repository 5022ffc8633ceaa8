// tools/site/file_digests.hpp
// Digests of files by content, remembered from one start of make to the next: a file whose size,
// times and place on the disk are those of before is not read again.
#pragma once

#include <map>
#include <string>

namespace talus {

class FileDigests {
 public:
  /// `memory`: an earlier as_text(), or empty.
  explicit FileDigests(const std::string& memory);
  /// SHA-256 of the content of a file; "none" where there is none.
  [[nodiscard]] std::string of(const std::string& path);
  /// Digests that were asked for, to be remembered. A file that changed within the last seconds is
  /// left out: it could change again without another time.
  [[nodiscard]] std::string as_text() const;

 private:
  struct Entry {
    std::string stamp;  ///< size, times, inode
    std::string sha256;
    bool settled = false;
  };
  std::map<std::string, Entry> before_, now_;
};

}  // namespace talus
