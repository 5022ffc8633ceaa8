// libcore/record/part_file.hpp: public
// Many runs as one file, exactly, without their frames: docs/reference/formats.md#part
// in:    runs whose frames are the first and the last alone (RunFile::reach), rows of passages
// out:   a file that has the same bytes in whatever order the runs came
//
// Rows of passages are ordered by cell, then run, then block, so that a map takes a range of cells
// of many parts, each read once from front to end. Runs of the same blocks, the same lines or
// objects share them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

/// The runs of a part, by run id, without their passages.
struct Part {
  double path_tolerance = 0;  ///< of the reach of all runs [m]
  PassageGrid grid;           ///< 0 rows: the runs recorded no passages
  bool passages_by_centroid = false;
  std::vector<std::string> name;  ///< file of the run before, with its folder (n_runs)
  std::vector<RunFile> runs;  ///< without blocks, lines, objects, passages, checkpoint  (n_runs)
  std::vector<RunBlocks> blocks;   ///< different ones
  std::vector<int> blocks_of_run;  ///< index into `blocks`                               (n_runs)
  std::vector<std::vector<RecordLine>> lines;  ///< different ones
  std::vector<int> lines_of_run;               ///< index into `lines`                    (n_runs)
  std::vector<std::vector<RecordObject>> objects;  ///< different ones
  std::vector<int> objects_of_run;                 ///< index into `objects`              (n_runs)
};
[[nodiscard]] inline int n_runs(const Part& part) { return static_cast<int>(part.runs.size()); }

/// A run with all that the part keeps of it.
[[nodiscard]] RunFile run_of(const Part& part, int run);

/// Adds a run at the end: its blocks and lines are kept once. Passages and checkpoint are dropped.
/// The run's `reach` must be given, and its pieces merged (record/pieces.hpp).
struct PartBuilder {
  Part part;
  std::vector<std::pair<std::string, int>> known_blocks, known_lines,
      known_objects;  ///< digest, index; sorted
};
void add_run(PartBuilder& builder, const std::string& name, RunFile run);

struct PartRow {
  std::int32_t run = 0;  ///< in the order of the part's runs
  Passage passage;
};
/// By cell, then run, then block.
void sort_rows(std::vector<PartRow>& rows);

/// Writes to `path` itself, synced. `part` by run id, `rows` sorted.
void write_part_file(const std::string& path, const Part& part, const std::vector<PartRow>& rows);

/// A part, opened. Throws InputError for a file that is damaged or contradicts itself.
class PartFile {
 public:
  explicit PartFile(const std::string& path);
  ~PartFile();
  PartFile(PartFile&&) noexcept;
  PartFile& operator=(PartFile&&) noexcept;

  Part part;
  std::vector<std::int32_t> cell;   ///< that were passed, ascending                 (n_cells)
  std::vector<std::int64_t> begin;  ///< rows of cell i: [i], [i + 1)                (n_cells + 1)

  /// Rows of the cells from number `first` to before number `end` of `cell`.
  [[nodiscard]] std::vector<PartRow> rows(std::size_t first, std::size_t end) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a sealed HDF5 file says that it is a part. Throws InputError when it is not a file of
/// Talus.
[[nodiscard]] bool is_part_file(const std::string& path);

}  // namespace talus
