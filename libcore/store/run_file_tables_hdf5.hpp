// libcore/store/run_file_tables_hdf5.hpp
// Tables (record/tables.hpp) as groups of a file, one array a field.
//
// Within the module: run_file_hdf5.cpp and part_file_hdf5.cpp write and read the other data and
// check the indices in rows.
#pragma once

#include <functional>
#include <vector>

#include "io/h5_hdf5.hpp"
#include "record/part_file.hpp"
#include "record/tables.hpp"

namespace talus {

template <class Row>
void write_table(H5Writer& file, const std::vector<Row>& rows);
/// The same of `n` rows: `row_at(i)`.
template <class Row>
void write_table(H5Writer& file, std::size_t n,
                 const std::function<const Row&(std::size_t)>& row_at);
/// `only_faults`: the fields that are kept as faults, the rest stays zero. Throws InputError for
/// a field that is missing or not as long as the first.
template <class Row>
[[nodiscard]] std::vector<Row> read_table(const H5Reader& file, bool only_faults = false);

/// The group rows of a part: run and passage without its cell.
void write_part_rows(H5Writer& file, const std::vector<PartRow>& rows);
/// `n` rows from `first` on; cells stay 0.
[[nodiscard]] std::vector<PartRow> read_part_rows(const H5Reader& file, std::size_t first,
                                                  std::size_t n);

}  // namespace talus
