// Rows of passages in a file without a name, for runs larger than memory.
#include "record/passage_rows.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "base/error.hpp"

namespace talus {
namespace {

static_assert(std::is_trivially_copyable_v<Passage>);
constexpr std::size_t piece_rows = 1 << 14;

[[noreturn]] void fail(const std::string& folder, const char* what) {
  throw InputError({folder}, std::string(what) + ": " + std::strerror(errno),
                   "make room, or name an output elsewhere");
}

// Some file systems have no files without a name.
int open_unnamed(const std::string& folder) {
  const int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (file >= 0) return file;
  std::string name = folder + "/.talus-passages-XXXXXX";
  const int named = mkostemp(name.data(), O_CLOEXEC);
  if (named >= 0) unlink(name.c_str());
  return named;
}

// Calls transfer(done), which returns how many bytes more it took, until all are done.
template <class Transfer>
bool all_done(std::size_t n_bytes, Transfer&& transfer) {
  for (std::size_t done = 0; done < n_bytes;) {
    const ssize_t n = transfer(done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

PassageRows::~PassageRows() {
  if (file_ >= 0) close(file_);
}

void PassageRows::append(const std::vector<Passage>& rows) {
  if (file_ < 0) file_ = open_unnamed(folder_);
  if (file_ < 0) fail(folder_, "passages cannot be kept there");
  const auto* bytes = reinterpret_cast<const char*>(rows.data());
  const std::size_t n_bytes = rows.size() * sizeof(Passage), at = size_ * sizeof(Passage);
  if (!all_done(n_bytes, [&](std::size_t done) {
        return pwrite(file_, bytes + done, n_bytes - done, static_cast<off_t>(at + done));
      }))
    fail(folder_, "passages cannot be kept there");
  size_ += rows.size();
  piece_.clear();
}

const Passage& PassageRows::operator[](std::size_t i) const {
  TALUS_ASSERT(i < size_);
  if (i < first_ || i >= first_ + piece_.size()) {
    first_ = i - i % piece_rows;
    piece_.resize(std::min(piece_rows, size_ - first_));
    auto* bytes = reinterpret_cast<char*>(piece_.data());
    const std::size_t n_bytes = piece_.size() * sizeof(Passage), at = first_ * sizeof(Passage);
    if (!all_done(n_bytes, [&](std::size_t done) {
          return pread(file_, bytes + done, n_bytes - done, static_cast<off_t>(at + done));
        }))
      fail(folder_, "passages that were kept there cannot be read");
  }
  return piece_[i - first_];
}

}  // namespace talus
