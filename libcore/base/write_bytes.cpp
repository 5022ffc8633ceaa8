// Writes bytes to a new file and syncs it to the disk.
#include "base/write_bytes.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/error.hpp"

namespace talus {

namespace {

// A new file, or an existing device. Links are not followed: under a name that other people know, a
// link may lead to any file of the user's.
int open_new(const std::string& path) {
  constexpr int flags = O_WRONLY | O_CLOEXEC | O_NOFOLLOW;
  struct stat there {};
  const bool is_there = lstat(path.c_str(), &there) == 0;
  if (is_there && !S_ISREG(there.st_mode) && !S_ISLNK(there.st_mode))
    return open(path.c_str(), flags);
  if (is_there && unlink(path.c_str()) != 0) return -1;
  return open(path.c_str(), flags | O_CREAT | O_EXCL, 0666);
}

}  // namespace

void write_bytes(const std::string& path, std::span<const unsigned char> bytes,
                 std::span<const unsigned char> end) {
  const int descriptor = open_new(path);
  const auto remove = [&] {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) std::filesystem::remove(path, error);
  };
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    if (descriptor >= 0) {
      close(descriptor);
      remove();
    }
    throw InputError({path}, std::string(what) + ": " + reason,
                     "make room, or name an output elsewhere");
  };
  if (descriptor < 0) fail("cannot be opened for writing");
  for (const std::span<const unsigned char> part : {bytes, end})
    for (std::size_t done = 0; done < part.size();) {
      const ssize_t n = write(descriptor, part.data() + done, part.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("cannot be written");
      done += static_cast<std::size_t>(n);
    }
  if (fsync(descriptor) != 0 && errno != EINVAL) fail("cannot be synced to the disk");
  if (close(descriptor) == 0) return;
  remove();
  throw InputError({path}, "cannot be closed after writing");
}

}  // namespace talus
