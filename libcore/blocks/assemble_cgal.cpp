// blocks/assemble.hpp with CGAL: cells that no joint parts are joined, slivers merged, blocks
// made convex.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "blocks/assemble.hpp"
#include "blocks/convexify.hpp"
#include "blocks/shell.hpp"
#include "blocks/solid.hpp"

namespace talus {
namespace {

// Rock that no joint parts: cells joined through walls, and the sum of their moments.
struct CellPiece {
  std::vector<int> cells;
  Moments sum;
};

// The cells of a piece that lie in one leaf.
struct Share {
  int piece = 0, leaf = 0;
  std::vector<int> cells;
  Moments sum;
};

void add_cell(std::vector<int>& cells, Moments& sum, int cell, const Moments& own) {
  sum = cells.empty() ? own : joined(sum, own);
  cells.push_back(cell);
}

struct Contact {
  double area = 0;
  Vec3 area_vector = Vec3::Zero();  // out of the first piece
  Vec3 weighted_point = Vec3::Zero();
};
// Shared joint faces: (piece, piece, joint set), the first piece the smaller one.
using Contacts = std::map<std::array<int, 3>, Contact>;

struct FaceMeasure {
  Vec3 area_vector = Vec3::Zero();
  Vec3 centroid = Vec3::Zero();
};

FaceMeasure measure_face(const CellComplex& c, int f) {
  Polyhedron one;
  std::vector<int> loop;
  int d = c.face_dart[f];
  do {
    loop.push_back(static_cast<int>(one.vertices.size()));
    one.vertices.push_back(c.vertices[c.dart_vertex[d]]);
    d = c.dart_next[d];
  } while (d != c.face_dart[f]);
  add_face(one, loop, 0);
  return {face_area_vector(one, 0), face_centroid(one, 0)};
}

void add_to(Contact& contact, const FaceMeasure& face) {
  const double area = face.area_vector.norm();
  contact.area += area;
  contact.area_vector += face.area_vector;
  contact.weighted_point += area * face.centroid;
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Cells joined through walls within their joint cell, in the order of the cells.
std::vector<CellPiece> find_pieces(const CellComplex& c, const std::vector<Polyhedron>& bodies,
                                   std::vector<int>& piece_of_cell) {
  const int n_cells = static_cast<int>(c.cell_leaf.size());
  std::vector<int> parent(n_cells);
  std::iota(parent.begin(), parent.end(), 0);
  for (size_t f = 0; f < c.face_dart.size(); ++f) {
    const int other = c.dart_opposite[c.face_dart[f]];
    if (other < 0 || c.face_made_by[f] != cut_wall) continue;
    const int a = root(parent, c.face_cell[f]);
    const int b = root(parent, c.face_cell[c.dart_face[other]]);
    parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<CellPiece> pieces;
  piece_of_cell.assign(n_cells, -1);
  for (int cell = 0; cell < n_cells; ++cell) {
    int& piece = piece_of_cell[cell];
    piece = piece_of_cell[root(parent, cell)];
    if (piece < 0) {
      piece = static_cast<int>(pieces.size());
      pieces.emplace_back();
    }
    add_cell(pieces[piece].cells, pieces[piece].sum, cell, moments(bodies[cell]));
  }
  return pieces;
}

Contacts find_contacts(const CellComplex& c, const std::vector<Joint>& joints,
                       const std::vector<int>& piece_of_cell) {
  Contacts contacts;
  for (size_t f = 0; f < c.face_dart.size(); ++f) {
    const int other = c.dart_opposite[c.face_dart[f]];
    if (other < 0 || c.face_made_by[f] < 0) continue;
    const int a = piece_of_cell[c.face_cell[f]];
    const int b = piece_of_cell[c.face_cell[c.dart_face[other]]];
    if (a >= b) continue;
    add_to(contacts[{a, b, joints[c.face_made_by[f]].set}], measure_face(c, static_cast<int>(f)));
  }
  return contacts;
}

bool is_sliver(const Moments& m, const AssembleOptions& options) {
  if (m.volume < options.min_volume || m.volume <= 0) return true;
  const Vec3 size = extents(m);
  return size.z() < options.min_thickness ||
         (options.max_aspect > 0 && size.x() > options.max_aspect * size.z());
}

// Gives slivers, smallest first, to the neighbour with the largest shared area. owner[p] is the
// piece whose block piece p belongs to; -1 for slivers that have no neighbour.
std::vector<int> merge_slivers(const std::vector<CellPiece>& pieces, const Contacts& contacts,
                               const AssembleOptions& options, AssembleReport& report) {
  const int n = static_cast<int>(pieces.size());
  std::vector<std::map<int, double>> area_with(n);
  for (const auto& [key, contact] : contacts) {
    area_with[key[0]][key[1]] += contact.area;
    area_with[key[1]][key[0]] += contact.area;
  }
  std::vector<Moments> sum(n);
  for (int p = 0; p < n; ++p) sum[p] = pieces[p].sum;
  std::vector<int> parent(n), order(n);
  std::iota(parent.begin(), parent.end(), 0);
  order = parent;
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pieces[a].sum.volume < pieces[b].sum.volume; });
  std::vector<int> dropped;
  for (const int start : order) {
    int p = root(parent, start);
    // A sliver that has taken in smaller ones is judged as it now is.
    if (p != start || !is_sliver(sum[p], options)) continue;
    int best = -1;
    double best_area = 0;
    for (const auto& [q, area] : area_with[p])
      if (area > best_area) best = q, best_area = area;
    if (best < 0) {
      dropped.push_back(p);
      continue;
    }
    ++report.n_merged;
    report.merged_volume += pieces[p].sum.volume;  // cells merged earlier have been counted
    parent[p] = best;
    sum[best] = joined(sum[best], sum[p]);
    for (const auto& [q, area] : area_with[p]) {
      area_with[q].erase(p);
      if (q == best) continue;
      area_with[best][q] += area;
      area_with[q][best] += area;
    }
    area_with[p].clear();
  }
  for (const int p : dropped) {
    ++report.n_dropped;
    report.dropped_volume += sum[p].volume;
  }
  std::vector<int> owner(n);
  for (int p = 0; p < n; ++p) owner[p] = root(parent, p);
  for (int& o : owner)
    if (std::find(dropped.begin(), dropped.end(), o) != dropped.end()) o = -1;
  return owner;
}

int face_origin(int made_by, const std::vector<Joint>& joints) {
  if (made_by >= 0) return joints[made_by].set;
  switch (made_by) {
    case cut_terrain:
      return face_terrain;
    case cut_failure:
      return face_failure;
    case cut_side:
      return face_source_side;
    default:
      return face_internal;
  }
}

// Tags of a polyhedron from CutFace or joint to FaceOrigin or joint set.
void name_faces(Polyhedron& body, const std::vector<Joint>& joints) {
  for (int& tag : body.face_tag) tag = face_origin(tag, joints);
}

class Assembler {
 public:
  Assembler(const CellComplex& complex, const std::vector<Joint>& joints, const Trn& bed,
            const AssembleOptions& options)
      : complex_(complex),
        joints_(joints),
        bed_(bed),
        options_(options),
        reader_(complex),
        cells_(cells_as_polyhedra(complex)) {
    Vec3 low = Vec3::Zero(), high = low;
    if (!complex.vertices.empty()) low = high = complex.vertices[0];
    for (const Vec3& v : complex.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
    tolerance_ = 1e-9 * (high - low).norm();
    cell_face_begin_.assign(complex.cell_leaf.size() + 1, 0);
    for (const int cell : complex.face_cell) ++cell_face_begin_[cell + 1];
    std::partial_sum(cell_face_begin_.begin(), cell_face_begin_.end(), cell_face_begin_.begin());
  }

  AssembleReport run(BlockSet& set, const ProgressFunction& progress) {
    std::vector<int> piece_of_cell;
    const std::vector<CellPiece> pieces = find_pieces(complex_, cells_, piece_of_cell);
    const Contacts contacts = find_contacts(complex_, joints_, piece_of_cell);
    AssembleReport report;
    report.n_cells = static_cast<int>(complex_.cell_leaf.size());
    report.n_pieces = static_cast<int>(pieces.size());
    for (const CellPiece& piece : pieces) report.cut_volume += piece.sum.volume;
    const std::vector<int> owner = merge_slivers(pieces, contacts, options_, report);

    std::vector<std::vector<int>> members(pieces.size());
    std::vector<std::vector<Share>> shares_in(complex_.leaves.size());
    for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
      if (owner[p] >= 0) members[owner[p]].push_back(p);
      if (owner[p] == p) add_shares(pieces[p], p, shares_in);
    }
    std::vector<Draft> drafts;
    for (int p = 0; p < static_cast<int>(pieces.size()); ++p) {
      if (progress) progress(static_cast<double>(p) / static_cast<double>(pieces.size()));
      if (owner[p] == p) drafts.push_back(draft(pieces, p, members[p], shares_in));
    }
    if (!options_.exact) keep_clear_of_exact(drafts);
    block_of_cell_.assign(complex_.cell_leaf.size(), -1);
    for (Draft& block : drafts) add_block(block, set, report);
    add_pairs(set);
    return report;
  }

 private:
  // A block to be: the rock that it is made of, and its convex bodies; none: it stays exact.
  struct Draft {
    int joint_cell = 0;
    std::vector<int> cells;
    double volume = 0;
    std::vector<Polyhedron> parts;
  };

  int joint_cell_of(int cell) const { return complex_.leaf_joint_cell[complex_.cell_leaf[cell]]; }

  void add_shares(const CellPiece& piece, int number,
                  std::vector<std::vector<Share>>& shares_in) const {
    for (const int cell : piece.cells) {
      const int leaf = complex_.cell_leaf[cell];
      std::vector<Share>& shares = shares_in[leaf];
      if (shares.empty() || shares.back().piece != number) shares.push_back({number, leaf, {}, {}});
      add_cell(shares.back().cells, shares.back().sum, cell, moments(cells_[cell]));
    }
  }

  Draft draft(const std::vector<CellPiece>& pieces, int main, const std::vector<int>& members,
              const std::vector<std::vector<Share>>& shares_in) const {
    Moments exact = pieces[members[0]].sum;
    Draft block;
    block.joint_cell = joint_cell_of(pieces[main].cells[0]);
    block.cells = pieces[members[0]].cells;
    for (size_t k = 1; k < members.size(); ++k) {
      const CellPiece& piece = pieces[members[k]];
      exact = joined(exact, piece.sum);
      block.cells.insert(block.cells.end(), piece.cells.begin(), piece.cells.end());
    }
    block.volume = exact.volume;
    if (!options_.exact) block.parts = convex_bodies(pieces[main], main, shares_in, exact.volume);
    return block;
  }

  // Convex blocks keep apart by their rooms, but a block that stays exact may hold rock in the room
  // of another: slivers of that joint cell, or rock that reaches past the middle between blocks of
  // one joint cell. A convex block in such rock stays exact too.
  void keep_clear_of_exact(std::vector<Draft>& drafts) const {
    std::vector<std::vector<int>> in_joint_cell(complex_.leaves.size());
    std::vector<int> exact;
    for (int b = 0; b < static_cast<int>(drafts.size()); ++b) {
      in_joint_cell[drafts[b].joint_cell].push_back(b);
      if (drafts[b].parts.empty()) exact.push_back(b);
    }
    while (!exact.empty()) {
      const Draft& block = drafts[exact.back()];
      exact.pop_back();
      std::map<int, double> shared;
      for (const int cell : block.cells)
        for (const int other : in_joint_cell[joint_cell_of(cell)])
          for (const Polyhedron& part : drafts[other].parts)
            shared[other] += common_volume(part, cells_[cell]);
      for (const auto& [other, volume] : shared) {
        if (volume <= 1e-9 * std::min(block.volume, drafts[other].volume)) continue;
        drafts[other].parts.clear();
        exact.push_back(other);
      }
    }
  }

  void add_block(Draft& block, BlockSet& set, AssembleReport& report) {
    if (!block.parts.empty()) {
      Body body;
      body.parts = std::move(block.parts);
      append(body, block.cells, block.volume, set, report);
      return;
    }
    if (!options_.exact) ++report.n_kept_exact;
    const auto groups = without_rings(block.cells);
    report.n_rings_parted += static_cast<int>(groups.size()) - 1;
    for (const auto& group : groups) {
      const Body body = exact_body(group);
      append(body, group, -1, set, report);
    }
  }

  // `exact_volume` < 0: the body is exact.
  void append(Body body, const std::vector<int>& cells, double exact_volume, BlockSet& set,
              AssembleReport& report) {
    for (const int cell : cells) block_of_cell_[cell] = n_blocks(set);
    body.material = options_.material;
    add_body(set, body);
    const double volume = set.volume.back();
    if (is_sliver({volume, set.centroid.back(), set.second_moment.back()}, options_))
      ++report.n_below_limits;
    const double shortest = min_edge(exact_volume < 0 ? volume : exact_volume);
    if (std::any_of(body.parts.begin(), body.parts.end(),
                    [&](const Polyhedron& part) { return shortest_edge(part) < shortest; }))
      ++report.n_short_edged;
    const double change = exact_volume < 0 ? 0 : volume - exact_volume;
    if (exact_volume >= 0 && body.parts.size() > 1) ++report.n_divided;
    (change > 0 ? report.gained : report.lost) += std::abs(change);
    report.block_volume += volume;
    report.exact_volume.push_back(exact_volume < 0 ? volume : exact_volume);
  }

  // Groups of cells that hang together, each with a shell like a sphere's. A ring, as a failure
  // surface that daylights in the middle of a block leaves it, is parted along walls.
  std::vector<std::vector<int>> without_rings(const std::vector<int>& cells) {
    const SurfaceCheck whole = check_surface(reader_.shell(cells));
    const auto is_sphere = [](int euler) { return euler == 2; };
    if (std::all_of(whole.euler.begin(), whole.euler.end(), is_sphere)) return {cells};
    for (const Vec3& axis :
         {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(1, 1, 0), Vec3(1, -1, 0)})
      for (const double share : {0.5, 0.35, 0.65, 0.2, 0.8}) {
        std::vector<std::vector<int>> groups = reader_.parted(cells, axis, share);
        const bool all_sound = std::all_of(groups.begin(), groups.end(), [&](const auto& group) {
          const SurfaceCheck check = check_surface(reader_.shell(group));
          return check.fault == SurfaceFault::none &&
                 std::all_of(check.euler.begin(), check.euler.end(), is_sphere);
        });
        if (all_sound) return groups;
      }
    return {cells};
  }

  Body exact_body(const std::vector<int>& cells) {
    Body body;
    body.shell = reader_.shell(cells);
    name_faces(body.shell, joints_);
    const double whole = moments(body.shell).volume;
    for (const auto& group : reader_.convex_groups(cells, tolerance_)) {
      Polyhedron part = reader_.shell(group);
      // Dust that rounding leaves between parts is in the shell, but is not a part to collide with.
      if (check_surface(part).fault != SurfaceFault::none || moments(part).volume < 1e-12 * whole)
        continue;
      name_faces(part, joints_);
      body.parts.push_back(std::move(part));
    }
    if (body.parts.size() == 1) body.shell = {};
    return body;
  }

  double largest_along(const Share& share, const Vec3& direction) const {
    double largest = -std::numeric_limits<double>::infinity();
    for (const int cell : share.cells)
      for (const Vec3& v : cells_[cell].vertices) largest = std::max(largest, direction.dot(v));
    return largest;
  }

  // Least length of edges of convex parts of a block of this volume [m].
  double min_edge(double volume) const {
    if (options_.exact) return 0;
    return options_.min_edge < 0 ? 1e-3 * std::cbrt(volume) : options_.min_edge;
  }

  // The leaf, cut off half-way to the other pieces in it.
  Polyhedron room_of(const Share& own, const std::vector<Share>& in_leaf) const {
    Polyhedron room = complex_.leaves[own.leaf];
    name_faces(room, joints_);
    for (const Share& other : in_leaf) {
      if (other.piece == own.piece || n_faces(room) == 0) continue;
      const bool is_first = own.piece < other.piece;
      const Share &first = is_first ? own : other, &second = is_first ? other : own;
      Vec3 apart = second.sum.centroid - first.sum.centroid;
      if (apart.norm() == 0) apart = Vec3::UnitX();
      apart.normalize();
      const double middle = (largest_along(first, apart) - largest_along(second, -apart)) / 2;
      const Plane between{apart, middle};
      room = clip_convex(room, is_first ? between : flipped(between), face_terrain, tolerance_);
    }
    return room;
  }

  // The space in the piece's joint cell in which it may be convex, leaf by leaf; the volume of
  // merged cells is shared out by volume.
  std::vector<ConvexTask> convex_tasks(const CellPiece& piece, int number,
                                       const std::vector<std::vector<Share>>& shares_in,
                                       double volume) const {
    std::map<int, const Share*> shares;
    for (const int cell : piece.cells)
      for (const Share& share : shares_in[complex_.cell_leaf[cell]])
        if (share.piece == number) shares[share.leaf] = &share;
    std::vector<ConvexTask> tasks;
    for (const auto& [leaf, share] : shares) {
      ConvexTask task;
      task.room = room_of(*share, shares_in[leaf]);
      for (const int cell : share->cells) task.cells.push_back(cells_[cell]);
      task.volume = shares.size() == 1 ? volume : volume * share->sum.volume / piece.sum.volume;
      tasks.push_back(std::move(task));
    }
    return tasks;
  }

  std::vector<Polyhedron> convex_bodies(const CellPiece& piece, int number,
                                        const std::vector<std::vector<Share>>& shares_in,
                                        double volume) const {
    ConvexOptions options;
    options.max_loss = options_.max_convex_loss;
    options.tolerance_m = tolerance_;
    options.min_edge = min_edge(volume);
    std::vector<Polyhedron> parts =
        made_convex_parts(convex_tasks(piece, number, shares_in, volume), bed_, options);
    const bool all_sound = std::all_of(parts.begin(), parts.end(), [](const Polyhedron& part) {
      return check_surface(part).fault == SurfaceFault::none;
    });
    return all_sound ? parts : std::vector<Polyhedron>{};
  }

  void add_pairs(BlockSet& set) const {
    Contacts between;
    for (size_t f = 0; f < complex_.face_dart.size(); ++f) {
      const int other = complex_.dart_opposite[complex_.face_dart[f]];
      if (other < 0) continue;
      const int a = block_of_cell_[complex_.face_cell[f]];
      const int b = block_of_cell_[complex_.face_cell[complex_.dart_face[other]]];
      if (a >= 0 && a < b)
        add_to(between[{a, b, face_origin(complex_.face_made_by[f], joints_)}],
               measure_face(complex_, static_cast<int>(f)));
    }
    for (const auto& [key, contact] : between) {
      if (!(contact.area > 0) || !(contact.area_vector.norm() > 0)) continue;
      set.pair_blocks.push_back({key[0], key[1]});
      set.pair_joint_set.push_back(key[2]);
      set.pair_area.push_back(contact.area);
      set.pair_normal.push_back(contact.area_vector.normalized());
      set.pair_point.push_back(contact.weighted_point / contact.area);
    }
  }

  const CellComplex& complex_;
  const std::vector<Joint>& joints_;
  const Trn& bed_;
  const AssembleOptions& options_;
  ShellReader reader_;
  std::vector<Polyhedron> cells_;  // of the complex, face_tag as CutFace
  std::vector<int> cell_face_begin_;
  std::vector<int> block_of_cell_;
  double tolerance_ = 0;
};

}  // namespace

AssembleReport assemble_blocks(const CellComplex& complex, const std::vector<Joint>& joints,
                               const Trn& bed, const AssembleOptions& options, BlockSet& set,
                               const ProgressFunction& progress) {
  return Assembler(complex, joints, bed, options).run(set, progress);
}

}  // namespace talus
