// libcore/record/tables.hpp: public
// The tables of a run: a row is a struct, and one list names its fields, with unit and title. Run
// files, parts, other formats and docs/reference/fields.md are made from these lists.
#pragma once

#include <variant>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

/// The place of a field in its row.
using Slot = std::variant<std::int32_t*, std::int64_t*, float*, double*>;

enum class Kept {
  always,
  where_any,  ///< left out of a file where no row has another value than a new one
  as_fault    ///< also read by a reader that wants only faults
};

template <class Row>
struct StoredField {
  const char* name;   ///< ends in its unit
  const char* unit;   ///< "1": a number without
  const char* title;  ///< in words
  Slot (*at)(Row&);
  Kept kept = Kept::always;
};

template <class Row>
struct Table {
  const char* name;   ///< of the group in a file
  const char* title;  ///< meaning of a row
  std::vector<StoredField<Row>> fields;
};

/// Of Passage, Crossing, ObjectHit, RoofHit, PanelRow, FenceHit, TreeHitRow, HealthRow, Break,
/// CrushedBlock and DeepRow.
template <class Row>
[[nodiscard]] const Table<Row>& table_of();

template <>
const Table<Passage>& table_of();
template <>
const Table<Crossing>& table_of();
template <>
const Table<ObjectHit>& table_of();
template <>
const Table<RoofHit>& table_of();
template <>
const Table<PanelRow>& table_of();
template <>
const Table<FenceHit>& table_of();
template <>
const Table<TreeHitRow>& table_of();
template <>
const Table<HealthRow>& table_of();
template <>
const Table<Break>& table_of();
template <>
const Table<CrushedBlock>& table_of();
template <>
const Table<DeepRow>& table_of();

}  // namespace talus
