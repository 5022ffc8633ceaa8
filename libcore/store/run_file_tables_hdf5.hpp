// libcore/store/run_file_tables_hdf5.hpp
// The tables of a run file: passages, crossings, fence panels and hits, health. A row is a struct,
// a column one of its fields, stored as an array with its unit. docs/reference/formats.md#run
//
// Within the module: run_file_hdf5.cpp writes and reads what stands beside them and checks what
// rows refer to.
#pragma once

#include <vector>

#include "io/h5_hdf5.hpp"
#include "record/part_file.hpp"
#include "record/run_file.hpp"

namespace talus {

void write_passage_table(H5Writer& file, const std::vector<Passage>& rows);
/// The group rows of a part: run and passage without its cell.
void write_part_rows(H5Writer& file, const std::vector<PartRow>& rows);
void write_object_hit_table(H5Writer& file, const std::vector<ObjectHit>& rows);
void write_crossing_table(H5Writer& file, const std::vector<Crossing>& rows);
void write_panel_table(H5Writer& file, const std::vector<PanelRow>& rows);
void write_hit_table(H5Writer& file, const std::vector<FenceHit>& rows);
void write_break_table(H5Writer& file, const std::vector<Break>& rows);
void write_crushed_table(H5Writer& file, const std::vector<CrushedBlock>& rows);
void write_deep_table(H5Writer& file, const std::vector<DeepRow>& rows);
void write_health_table(H5Writer& file, const std::vector<HealthRow>& rows);

/// Each throws InputError for a column that is missing or not as long as the first.
[[nodiscard]] std::vector<Passage> read_passage_table(const H5Reader& file);
/// `n` rows from `first` on; cells stay 0.
[[nodiscard]] std::vector<PartRow> read_part_rows(const H5Reader& file, std::size_t first,
                                                  std::size_t n);
[[nodiscard]] std::vector<ObjectHit> read_object_hit_table(const H5Reader& file);
[[nodiscard]] std::vector<Crossing> read_crossing_table(const H5Reader& file);
[[nodiscard]] std::vector<PanelRow> read_panel_table(const H5Reader& file);
[[nodiscard]] std::vector<FenceHit> read_hit_table(const H5Reader& file);
[[nodiscard]] std::vector<Break> read_break_table(const H5Reader& file);
[[nodiscard]] std::vector<CrushedBlock> read_crushed_table(const H5Reader& file);
void write_tree_hit_table(H5Writer& file, const std::vector<TreeHitRow>& rows);
[[nodiscard]] std::vector<TreeHitRow> read_tree_hit_table(const H5Reader& file);
[[nodiscard]] std::vector<DeepRow> read_deep_table(const H5Reader& file);
/// `only_faults`: as RunParts says; the other fields stay zero.
[[nodiscard]] std::vector<HealthRow> read_health_table(const H5Reader& file, bool only_faults);

}  // namespace talus
