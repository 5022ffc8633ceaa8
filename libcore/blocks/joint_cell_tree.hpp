// libcore/blocks/joint_cell_tree.hpp
// The binary tree of joint cells: which joint divides which of them, and in what order.
// in:    one joint cell around the mass with all pieces of rock, joints, the sides of the outline
//        of the mass, and a cutter of pieces
// out:   the joint cells that no joint divides any more, each cut by the sides that cross it into
//        convex leaves, with their pieces
//
// Within the module, for cut_cgal.cpp, which keeps and cuts the pieces.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "blocks/area_clip.hpp"
#include "blocks/cut.hpp"
#include "blocks/joint_sets.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {

/// A joint cell or a part of one: convex, with the pieces of rock that lie in it.
template <class Piece>
struct JointCell {
  Polyhedron body;
  std::vector<Piece> pieces;
  std::vector<int> candidates;  ///< joints that may still cut it, those that are whole first
  std::vector<int> sides;       ///< of the outline, that may still cut it
  int joint_cell = -1;          ///< its number, once no joint divides it any more
};

/// `Cutter` is asked of one piece and joint j; side s of the outline is n_joints + s there:
///   sides_of(piece, j)           which sides of the joint it reaches: bit 1 inside, bit 2 outside
///   has_wall_on(piece, j)        whether a wall on the joint has rock on its other side
///   is_covered(piece, j)         whether the joint's discs cover its section through the piece
///   cut(piece, j, inner, outer)  cuts it in two; false when it could not be done
///   mark_faces_on(piece, j)      makes faces that lie on the joint the joint's
/// `tolerance`: points nearer to a joint lie on it [m].
template <class Piece, class Cutter>
class JointCellTree {
 public:
  using Leaf = JointCell<Piece>;

  JointCellTree(Cutter& cutter, const std::vector<Joint>& joints,
                const std::vector<AreaSide>& sides, double tolerance,
                const ProgressFunction& progress)
      : cutter_(cutter),
        joints_(joints),
        sides_(sides),
        tolerance_(tolerance),
        progress_(progress) {}

  /// Finished joint cells go to `leaves`, each with its pieces.
  void grow(Leaf root, std::vector<Leaf>& leaves) {
    std::vector<std::pair<Leaf, double>> open;  // with its share of the work
    open.emplace_back(std::move(root), 1.0);
    double done = 0;
    while (!open.empty()) {
      auto [leaf, share] = std::move(open.back());
      open.pop_back();
      const int j = take_cut(leaf);
      if (j < 0) {
        leaves.push_back(std::move(leaf));
        done += share;
        if (progress_) progress_(std::min(done, 1.0));
        continue;
      }
      auto [inner, outer] = divide(std::move(leaf), j);
      for (Leaf* half : {&outer, &inner})
        if (!half->pieces.empty())
          open.emplace_back(std::move(*half), share / 2);
        else
          done += share / 2;
    }
  }

 private:
  // The next joint that cuts the leaf; when there is none left, the next side; -1 when that
  // neither.
  int take_cut(Leaf& leaf) {
    std::erase_if(leaf.sides,
                  [&](int s) { return !runs_through(sides_[s], leaf.body, tolerance_); });
    if (leaf.joint_cell < 0) {
      const int j = take_joint(leaf);
      if (j >= 0) return j;
      leaf.joint_cell = n_joint_cells_++;
    }
    const int s = take_side(leaf);
    return s < 0 ? s : n_joints() + s;
  }

  // Sides first that leave the rock whole: they may spare it the remaining ones.
  int take_side(Leaf& leaf) {
    if (leaf.sides.empty()) return -1;
    auto at = std::find_if(leaf.sides.begin(), leaf.sides.end(),
                           [&](int s) { return !parts_rock(leaf, n_joints() + s); });
    if (at == leaf.sides.end()) at = leaf.sides.begin();
    const int s = *at;
    leaf.sides.erase(at);
    return s;
  }

  bool parts_rock(const Leaf& leaf, int j) {
    int sides = 0;
    for (const Piece& piece : leaf.pieces) {
      sides |= cutter_.sides_of(piece, j);
      if (sides == 3) return true;
    }
    return false;
  }

  // The next joint that cuts the leaf, taken off its list: of the joints that are whole, the one in
  // the middle of the list, so that the tree stays low. Joints that miss the leaf are dropped.
  int take_joint(Leaf& leaf) {
    std::erase_if(leaf.candidates, [&](int j) { return !crosses(leaf.body, joints_[j].plane); });
    const auto take = [&](std::vector<int>::iterator at) {
      const int j = *at;
      leaf.candidates.erase(at);
      return j;
    };
    const auto first_partial = std::find_if(leaf.candidates.begin(), leaf.candidates.end(),
                                            [&](int j) { return !joints_[j].is_through; });
    const auto n_through = first_partial - leaf.candidates.begin();
    if (n_through > 0) return take(leaf.candidates.begin() + n_through / 2);
    for (auto it = first_partial; it != leaf.candidates.end(); ++it)
      if (separates(leaf, *it)) return take(it);
    return -1;
  }

  bool crosses(const Polyhedron& body, const Plane& plane) const {
    bool inside = false, outside = false;
    for (const Vec3& v : body.vertices) {
      const double side = distance(plane, v);
      inside |= side < -tolerance_;
      outside |= side > tolerance_;
      if (inside && outside) return true;
    }
    return false;
  }

  // Whether an incomplete joint parts the rock of the leaf: everywhere it runs through it.
  bool separates(const Leaf& leaf, int j) {
    bool inside = false, outside = false;
    for (const Piece& piece : leaf.pieces) {
      const int sides = cutter_.sides_of(piece, j);
      inside |= (sides & 1) != 0;
      outside |= (sides & 2) != 0;
      const bool is_crossed = sides == 3 || cutter_.has_wall_on(piece, j);
      if (is_crossed && !cutter_.is_covered(piece, j)) return false;
    }
    return inside && outside;
  }

  std::pair<Leaf, Leaf> divide(Leaf leaf, int j) {
    Leaf inner, outer;
    const bool is_side = j >= n_joints();
    const Plane& plane = is_side ? sides_[j - n_joints()].plane : joints_[j].plane;
    const int made_by = is_side ? int{cut_side} : j;
    inner.body = clip_convex(leaf.body, plane, made_by, tolerance_);
    outer.body = clip_convex(leaf.body, flipped(plane), made_by, tolerance_);
    for (const Piece& piece : leaf.pieces) {
      const int sides = cutter_.sides_of(piece, j);
      if (sides == 3) {
        Piece below, above;
        if (cutter_.cut(piece, j, below, above)) {
          inner.pieces.push_back(below);
          outer.pieces.push_back(above);
        } else {
          inner.pieces.push_back(piece);
        }
        continue;
      }
      if (!is_side) cutter_.mark_faces_on(piece, j);
      (sides == 2 ? outer : inner).pieces.push_back(piece);
    }
    inner.joint_cell = outer.joint_cell = leaf.joint_cell;
    inner.sides = leaf.sides;
    outer.sides = std::move(leaf.sides);
    inner.candidates = leaf.candidates;
    outer.candidates = std::move(leaf.candidates);
    return {std::move(inner), std::move(outer)};
  }

  int n_joints() const { return static_cast<int>(joints_.size()); }

  Cutter& cutter_;
  const std::vector<Joint>& joints_;
  const std::vector<AreaSide>& sides_;
  int n_joint_cells_ = 0;
  double tolerance_;
  const ProgressFunction& progress_;
};

}  // namespace talus
