// libcore/store/run_file_pieces_hdf5.hpp
// Data that run files and parts of many runs have in common: blocks, lines, the grid of passages,
// the reach of blocks, and checks of the indices in their rows.
//
// Within the module: run_file_hdf5.cpp and part_file_hdf5.cpp put them together.
#pragma once

#include <string>
#include <vector>

#include "io/h5_hdf5.hpp"
#include "record/run_file.hpp"

namespace talus {

/// Texts on a run: attributes or texts of a run file, columns of the group runs of a part.
struct InfoText {
  const char *name, *long_name;
  std::string RunInfo::*field;
  enum Kind { attribute, text, words } kind = text;  ///< words: of RunParts
  bool is_optional = false;                          ///< a run file leaves it out where it is empty
};
struct InfoNumber {
  const char *name, *units, *long_name;
  double RunInfo::*field;
};
struct InfoFlag {
  const char *name, *long_name;
  bool RunInfo::*field;
};
inline constexpr InfoText info_texts[] = {
    {"run_id", "digest of version, settings and inputs", &RunInfo::run_id, InfoText::attribute},
    {"trn_sha256", "of the terrain that the blocks slid on", &RunInfo::trn_sha256,
     InfoText::attribute},
    {"blocks_hash", "of the block set", &RunInfo::blocks_hash, InfoText::attribute},
    {"law", "talus or paper", &RunInfo::law, InfoText::attribute},
    {"status", "done or failed; running: not ended", &RunInfo::status, InfoText::attribute},
    {"reason", "why it failed", &RunInfo::reason, InfoText::attribute},
    {"terrain_digest", "of the terrain before the slide, where beds differ",
     &RunInfo::terrain_digest, InfoText::text, true},
    {"case", "variant of the settings", &RunInfo::case_name, InfoText::text, true},
    {"warnings", "what inputs and settings were warned of, a line each", &RunInfo::warnings,
     InfoText::text, true},
    {"config", "effective settings as TOML, each with its origin", &RunInfo::config,
     InfoText::words},
    {"made_with", "options beside the settings, digests of the files read, a line each",
     &RunInfo::made_with, InfoText::words, true},
    {"plan", "what was computed and what was left out, JSON", &RunInfo::plan, InfoText::words}};
inline constexpr InfoNumber info_numbers[] = {
    {"duration_s", "s", "simulated time asked for", &RunInfo::duration},
    {"time_s", "s", "simulated time reached", &RunInfo::time}};
inline constexpr InfoFlag info_flags[] = {
    {"independent",
     "1: each block moved as if it were alone, among fences and trees as at the start",
     &RunInfo::independent},
    {"weights_are_frequencies", "1: weights of blocks are events a year",
     &RunInfo::weights_are_frequencies}};
inline constexpr InfoFlag seed_draws = {"seed_draws", "0: another seed gives the same run",
                                        &RunInfo::seed_draws};

[[nodiscard]] std::vector<Vec3> as_points(const std::vector<double>& list);
void put_points(H5Writer& file, const std::string& path, const std::vector<Vec3>& points,
                const std::string& dimension, const std::string& units,
                const std::string& long_name);
void put_indices(H5Writer& file, const std::string& path, const std::vector<int>& values,
                 const std::string& dimension, const std::string& long_name);
/// Throws InputError unless `begin` starts at 0, does not decrease, ends at `end` and has n + 1
/// entries.
void check_begin(const std::vector<int>& begin, std::size_t n, std::size_t end, const Where& where);

/// Meaning of the numbers of Phase, for readers of a file.
inline constexpr const char* phase_numbers =
    "at the end: 0 near the ground, 1 in flight, 2 asleep, 3 left the terrain, 4 stopped for want "
    "of finite numbers, 5 not there yet, 6 crushed, 7 broken into fragments";
/// Throws InputError for a number that no phase has.
[[nodiscard]] std::vector<Phase> phases_of(const std::vector<std::uint8_t>& numbers,
                                           const Where& where);

void write_blocks(H5Writer& file, const RunBlocks& blocks);
[[nodiscard]] RunBlocks read_blocks(const H5Reader& file, const std::string& path);

/// As attributes of `group`.
void write_grid(H5Writer& file, const std::string& group, const PassageGrid& grid,
                const Vec3& origin, bool by_centroid);
[[nodiscard]] PassageGrid read_grid(const H5Reader& file, const std::string& group,
                                    const std::string& path);

void write_objects(H5Writer& file, const std::vector<RecordObject>& objects);
[[nodiscard]] std::vector<RecordObject> read_objects(const H5Reader& file, const std::string& path);
/// Throws InputError when a hit names a block or object that does not exist.
void check_object_hits(const RunFile& run, const std::string& path);
void check_roof_hits(const RunFile& run, const std::string& path);
void write_lines(H5Writer& file, const std::vector<RecordLine>& lines);
[[nodiscard]] std::vector<RecordLine> read_lines(const H5Reader& file, const std::string& path);

/// Reach, largest speed and energy of blocks; the rest of a RunReach stays empty.
void write_block_reach(H5Writer& file, const std::string& group, const RunReach& reach);
[[nodiscard]] RunReach read_block_reach(const H5Reader& file, const std::string& group);

/// Each throws InputError for a row that refers to a missing entry of the run. The first also tells
/// crossings beside a line from those of the line.
void check_crossings(RunFile& run, const std::string& path);
void check_fences(const RunFile& run, const std::string& path);
void check_tree_hits(const RunFile& run, const std::string& path);
void check_breaks(const RunFile& run, const std::string& path);
void check_crushed(const RunFile& run, const std::string& path);
void check_deep(const RunFile& run, const std::string& path);
void check_reach(const RunReach& reach, std::size_t n_blocks, const std::string& path);

}  // namespace talus
