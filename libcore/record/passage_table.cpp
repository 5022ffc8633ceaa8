// The table of passages: a row a block and cell.
#include "record/passage_table.hpp"

#include <algorithm>
#include <cmath>

namespace talus {
namespace {

std::size_t hash_of(std::int32_t block, std::int32_t cell) {
  std::uint64_t key = static_cast<std::uint64_t>(static_cast<std::uint32_t>(block)) << 32 |
                      static_cast<std::uint32_t>(cell);
  key = (key ^ (key >> 29)) * 0xbf58476d1ce4e5b9ULL;  // mixing of splitmix64
  return static_cast<std::size_t>(key ^ (key >> 32));
}

void grow(PassageTable& table) {
  table.slots.assign(std::max<std::size_t>(64, 2 * table.slots.size()), 0);
  const std::size_t mask = table.slots.size() - 1;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    std::size_t slot = hash_of(table.rows[row].block, table.rows[row].cell) & mask;
    while (table.slots[slot] != 0) slot = (slot + 1) & mask;
    table.slots[slot] = static_cast<std::uint32_t>(row + 1);
  }
}

// The slot that holds a block and cell, or the empty one where they would go.
std::size_t slot_of(const PassageTable& table, std::int32_t block, std::int32_t cell) {
  const std::size_t mask = table.slots.size() - 1;
  std::size_t slot = hash_of(block, cell) & mask;
  for (; table.slots[slot] != 0; slot = (slot + 1) & mask) {
    const Passage& row = table.rows[table.slots[slot] - 1];
    if (row.block == block && row.cell == cell) break;
  }
  return slot;
}

Passage* row_at(PassageTable& table, std::size_t slot) {
  return table.slots[slot] == 0 ? nullptr : &table.rows[table.slots[slot] - 1];
}

float larger(float a, float b) { return a >= b || std::isnan(b) ? a : b; }

}  // namespace

void PassageValues::raise(const PassageValues& other) {
  speed = larger(speed, other.speed);
  translational_energy = larger(translational_energy, other.translational_energy);
  total_energy = larger(total_energy, other.total_energy);
  centroid_height = larger(centroid_height, other.centroid_height);
  top_height = larger(top_height, other.top_height);
}

Passage* PassageTable::earlier(std::int32_t block, std::int32_t cell, float time) {
  if (slots.empty()) return nullptr;
  Passage* row = row_at(*this, slot_of(*this, block, cell));
  return row && row->first_time <= time ? row : nullptr;
}

void PassageTable::raise(const Passage& visit) {
  if (4 * (rows.size() + 1) > 3 * slots.size()) grow(*this);
  const std::size_t slot = slot_of(*this, visit.block, visit.cell);
  if (Passage* known = row_at(*this, slot)) {
    Passage& row = *known;
    PassageValues largest = row.largest;
    largest.raise(visit.largest);
    if (visit.first_time < row.first_time) row = visit;
    row.largest = largest;
    return;
  }
  rows.push_back(visit);
  slots[slot] = static_cast<std::uint32_t>(rows.size());
}

std::vector<Passage> sorted(const PassageTable& table) {
  std::vector<Passage> rows = table.rows;
  std::sort(rows.begin(), rows.end(), [](const Passage& a, const Passage& b) {
    return a.block != b.block ? a.block < b.block : a.cell < b.cell;
  });
  return rows;
}

}  // namespace talus
