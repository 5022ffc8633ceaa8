// libcore/store/run_file_pieces_hdf5.hpp
// What run files and parts of many runs have in common: blocks, lines, the grid of passages, the
// reach of blocks, and what their rows may refer to.
//
// Within the module: run_file_hdf5.cpp and part_file_hdf5.cpp put them together.
#pragma once

#include <string>
#include <vector>

#include "io/h5_hdf5.hpp"
#include "record/run_file.hpp"

namespace talus {

[[nodiscard]] std::vector<Vec3> as_points(const std::vector<double>& list);
void put_points(H5Writer& file, const std::string& path, const std::vector<Vec3>& points,
                const std::string& dimension, const std::string& units,
                const std::string& long_name);
void put_indices(H5Writer& file, const std::string& path, const std::vector<int>& values,
                 const std::string& dimension, const std::string& long_name);
/// Throws InputError unless `begin` starts at 0, does not decrease, ends at `end` and has n + 1
/// entries.
void check_begin(const std::vector<int>& begin, std::size_t n, std::size_t end, const Where& where);

/// What the numbers of Phase mean, for whoever reads a file.
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
void write_lines(H5Writer& file, const std::vector<RecordLine>& lines);
[[nodiscard]] std::vector<RecordLine> read_lines(const H5Reader& file, const std::string& path);

/// Reach, largest speed and energy of blocks; the rest of a RunReach stays empty.
void write_block_reach(H5Writer& file, const std::string& group, const RunReach& reach);
[[nodiscard]] RunReach read_block_reach(const H5Reader& file, const std::string& group);

/// Each throws InputError for a row that refers to what the run does not have. The first also tells
/// crossings beside a line from those of the line.
void check_crossings(RunFile& run, const std::string& path);
void check_fences(const RunFile& run, const std::string& path);
void check_tree_hits(const RunFile& run, const std::string& path);
void check_breaks(const RunFile& run, const std::string& path);
void check_crushed(const RunFile& run, const std::string& path);
void check_deep(const RunFile& run, const std::string& path);
void check_reach(const RunReach& reach, std::size_t n_blocks, const std::string& path);

}  // namespace talus
