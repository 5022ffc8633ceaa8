// libcore/record/passage_rows.hpp: public
// Passages of a run that are more than memory should hold: in a file without a name, which is gone
// with its process.
// in:    rows in their order (record/passage_table.hpp)
// out:   the same, read a piece at a time; run files that begin with them
#pragma once

#include <string>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

class PassageRows {
 public:
  /// The file is in `folder`. Functions throw InputError with the system's reason.
  explicit PassageRows(std::string folder) : folder_(std::move(folder)) {}
  ~PassageRows();
  PassageRows(const PassageRows&) = delete;
  PassageRows& operator=(const PassageRows&) = delete;

  void append(const std::vector<Passage>& rows);
  [[nodiscard]] std::size_t size() const { return size_; }
  /// Fast in ascending order. Not for several threads.
  [[nodiscard]] const Passage& operator[](std::size_t i) const;

 private:
  std::string folder_;
  int file_ = -1;
  std::size_t size_ = 0;
  mutable std::size_t first_ = 0;  // row that `piece_` begins with
  mutable std::vector<Passage> piece_ = {};
};

/// As write_run_file() and replace_run_file(); `earlier`, which may be null, come before the
/// passages of `run`.
void write_run_file(const std::string& path, const RunFile& run, const PassageRows* earlier);
void replace_run_file(const std::string& path, const RunFile& run, const PassageRows* earlier);

}  // namespace talus
