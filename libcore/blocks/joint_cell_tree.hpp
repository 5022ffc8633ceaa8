// libcore/blocks/joint_cell_tree.hpp
// The binary tree of joint cells: which joint divides which of them, and in what order.
// in:    one joint cell around the mass with all pieces of rock, joints, and what cuts a piece
// out:   the joint cells that no joint divides any more, each with its pieces
//
// Within the module, for cut_cgal.cpp: there stands how a piece is kept and cut.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "blocks/joint_sets.hpp"
#include "geometry/polyhedron.hpp"

namespace talus {

/// A joint cell: convex, with the pieces of rock that lie in it.
template <class Piece>
struct JointCell {
  Polyhedron body;
  std::vector<Piece> pieces;
  std::vector<int> candidates;  ///< joints that may still cut it, those that are whole first
};

/// `Cutter` is asked of one piece and joint j:
///   sides_of(piece, j)           which sides of the joint it reaches: bit 1 inside, bit 2 outside
///   has_wall_on(piece, j)        whether a wall on the joint has rock on its other side
///   is_covered(piece, j)         whether the joint's discs cover its section through the piece
///   cut(piece, j, inner, outer)  cuts it in two; false when it could not be done
///   mark_faces_on(piece, j)      makes faces that lie on the joint the joint's
/// `tolerance`: what is nearer to a joint lies on it [m].
template <class Piece, class Cutter>
class JointCellTree {
 public:
  using Leaf = JointCell<Piece>;

  JointCellTree(Cutter& cutter, const std::vector<Joint>& joints, double tolerance,
                const ProgressFunction& progress)
      : cutter_(cutter), joints_(joints), tolerance_(tolerance), progress_(progress) {}

  /// Finished joint cells go to `leaves`, each with its pieces.
  void grow(Leaf root, std::vector<Leaf>& leaves) {
    std::vector<std::pair<Leaf, double>> open;  // with the share of the work that it stands for
    open.emplace_back(std::move(root), 1.0);
    double done = 0;
    while (!open.empty()) {
      auto [leaf, share] = std::move(open.back());
      open.pop_back();
      const int j = take_joint(leaf);
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
    inner.body = clip_convex(leaf.body, joints_[j].plane, j, tolerance_);
    outer.body = clip_convex(leaf.body, flipped(joints_[j].plane), j, tolerance_);
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
      cutter_.mark_faces_on(piece, j);
      (sides == 2 ? outer : inner).pieces.push_back(piece);
    }
    inner.candidates = leaf.candidates;
    outer.candidates = std::move(leaf.candidates);
    return {std::move(inner), std::move(outer)};
  }

  Cutter& cutter_;
  const std::vector<Joint>& joints_;
  double tolerance_;
  const ProgressFunction& progress_;
};

}  // namespace talus
