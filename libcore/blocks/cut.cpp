// Cells of a cut mass as polyhedra.
#include "blocks/cut.hpp"

#include <unordered_map>

namespace talus {

std::vector<Polyhedron> cells_as_polyhedra(const CellComplex& complex) {
  std::vector<Polyhedron> cells(complex.cell_leaf.size());
  std::vector<int> loop;
  std::unordered_map<int, int> local;  // of the cell whose faces are being added
  int current = -1;
  for (size_t f = 0; f < complex.face_dart.size(); ++f) {
    Polyhedron& cell = cells[complex.face_cell[f]];
    if (complex.face_cell[f] != current) local.clear();  // faces are ordered by cell
    current = complex.face_cell[f];
    loop.clear();
    int d = complex.face_dart[f];
    do {
      const auto [entry, is_new] =
          local.try_emplace(complex.dart_vertex[d], static_cast<int>(cell.vertices.size()));
      if (is_new) cell.vertices.push_back(complex.vertices[complex.dart_vertex[d]]);
      loop.push_back(entry->second);
      d = complex.dart_next[d];
    } while (d != complex.face_dart[f]);
    add_face(cell, loop, complex.face_made_by[f]);
  }
  return cells;
}

}  // namespace talus
