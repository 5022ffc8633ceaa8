// Tables of a run as HDF5 groups, one array a field.
#include "store/run_file_tables_hdf5.hpp"

#include <string>

#include "base/error.hpp"

namespace talus {
namespace {

std::string path_of(const char* group, const char* field) {
  return std::string(group) + "/" + field;
}

// `row(i)`: row i of n.
template <class Row, class RowAt>
void write_field(H5Writer& file, const char* group, const StoredField<Row>& field, std::size_t n,
                 const RowAt& row) {
  Row fresh;
  const auto write = [&]<class T>(T* unchanged) {
    const auto value = [&](std::size_t i) { return *std::get<T*>(field.at(row(i))); };
    bool any = field.kept != Kept::where_any;
    for (std::size_t i = 0; i < n && !any; ++i) any = value(i) != *unchanged;
    if (!any) return;
    file.column<T>(
        path_of(group, field.name), {"row", n},
        [&](std::size_t first, std::span<T> values) {
          for (std::size_t i = 0; i < values.size(); ++i) values[i] = value(first + i);
        },
        field.unit, field.title);
  };
  std::visit(write, field.at(fresh));
}

// Rows first..first + n - 1 of the file become rows 0..n - 1.
template <class Row, class RowAt>
void read_field(const H5Reader& file, const char* group, const StoredField<Row>& field,
                std::size_t first, std::size_t n, const RowAt& row) {
  Row fresh;
  const auto read = [&]<class T>(T*) {
    const std::vector<T> values = file.rows<T>(path_of(group, field.name), 1, first, n);
    for (std::size_t i = 0; i < n; ++i) *std::get<T*>(field.at(row(i))) = values[i];
  };
  std::visit(read, field.at(fresh));
}

}  // namespace

template <class Row>
void write_table(H5Writer& file, const std::vector<Row>& rows) {
  write_table<Row>(file, rows.size(), [&](std::size_t i) -> const Row& { return rows[i]; });
}

template <class Row>
void write_table(H5Writer& file, std::size_t n,
                 const std::function<const Row&(std::size_t)>& row_at) {
  const Table<Row>& table = table_of<Row>();
  file.group(table.name, table.title);
  Row copy;
  const auto row = [&](std::size_t i) -> Row& { return copy = row_at(i); };
  for (const StoredField<Row>& field : table.fields) write_field(file, table.name, field, n, row);
}

template void write_table(H5Writer&, std::size_t,
                          const std::function<const Passage&(std::size_t)>&);

template <class Row>
std::vector<Row> read_table(const H5Reader& file, bool only_faults) {
  const Table<Row>& table = table_of<Row>();
  std::vector<Row> rows(file.shape(path_of(table.name, table.fields.front().name))[0]);
  const auto row = [&rows](std::size_t i) -> Row& { return rows[i]; };
  for (const StoredField<Row>& field : table.fields) {
    const std::string path = path_of(table.name, field.name);
    if (only_faults && field.kept != Kept::as_fault) continue;
    if (field.kept == Kept::where_any && !file.has(path)) continue;
    if (const std::size_t n = file.shape(path)[0]; n != rows.size())
      throw InputError({path}, "has " + std::to_string(n) + " rows, the columns beside it have " +
                                   std::to_string(rows.size()));
    read_field(file, table.name, field, 0, rows.size(), row);
  }
  return rows;
}

template void write_table(H5Writer&, const std::vector<Passage>&);
template void write_table(H5Writer&, const std::vector<Crossing>&);
template void write_table(H5Writer&, const std::vector<ObjectHit>&);
template void write_table(H5Writer&, const std::vector<RoofHit>&);
template void write_table(H5Writer&, const std::vector<PanelRow>&);
template void write_table(H5Writer&, const std::vector<FenceHit>&);
template void write_table(H5Writer&, const std::vector<TreeHitRow>&);
template void write_table(H5Writer&, const std::vector<HealthRow>&);
template void write_table(H5Writer&, const std::vector<Break>&);
template void write_table(H5Writer&, const std::vector<CrushedBlock>&);
template void write_table(H5Writer&, const std::vector<DeepRow>&);
template std::vector<Passage> read_table(const H5Reader&, bool);
template std::vector<Crossing> read_table(const H5Reader&, bool);
template std::vector<ObjectHit> read_table(const H5Reader&, bool);
template std::vector<RoofHit> read_table(const H5Reader&, bool);
template std::vector<PanelRow> read_table(const H5Reader&, bool);
template std::vector<FenceHit> read_table(const H5Reader&, bool);
template std::vector<TreeHitRow> read_table(const H5Reader&, bool);
template std::vector<HealthRow> read_table(const H5Reader&, bool);
template std::vector<Break> read_table(const H5Reader&, bool);
template std::vector<CrushedBlock> read_table(const H5Reader&, bool);
template std::vector<DeepRow> read_table(const H5Reader&, bool);

void write_part_rows(H5Writer& file, const std::vector<PartRow>& rows) {
  file.group("rows", "one row per cell, run and block that passed it");
  std::vector<std::int32_t> run;
  for (const PartRow& row : rows) run.push_back(row.run);
  file.array<std::int32_t>("rows/run", run, {{"row", run.size()}}, "1", "index of the run");
  Passage copy;
  const auto row = [&](std::size_t i) -> Passage& { return copy = rows[i].passage; };
  for (const StoredField<Passage>& field : table_of<Passage>().fields)
    if (std::string(field.name) != "cell")  // those of the group cells
      write_field(file, "rows", field, rows.size(), row);
}

std::vector<PartRow> read_part_rows(const H5Reader& file, std::size_t first, std::size_t n) {
  std::vector<PartRow> rows(n);
  const std::vector<std::int32_t> run = file.rows<std::int32_t>("rows/run", 1, first, n);
  for (std::size_t i = 0; i < n; ++i) rows[i].run = run[i];
  const auto row = [&rows](std::size_t i) -> Passage& { return rows[i].passage; };
  for (const StoredField<Passage>& field : table_of<Passage>().fields)
    if (std::string(field.name) != "cell") read_field(file, "rows", field, first, n, row);
  return rows;
}

}  // namespace talus
