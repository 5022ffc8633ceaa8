// Joint faces in contact and overlapping blocks before anything moves.
#include "contact/start_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "contact/neighbours.hpp"
#include "contact/separating_axis.hpp"
#include "geometry/face_overlap.hpp"

namespace talus {
namespace {

// The box of each part, wider by `margin` all around.
std::vector<Box> boxes_of(const Hulls& hulls, const PlacedHulls& placed, double margin) {
  std::vector<Box> boxes;
  for (int p = 0; p < n_parts(hulls); ++p) {
    Box box = box_of_part(hulls, placed, p);
    box.low.array() -= margin;
    box.high.array() += margin;
    boxes.push_back(box);
  }
  return boxes;
}

// Pairs of parts of different bodies whose boxes come closer than `distance`.
std::vector<std::array<int, 2>> close_parts(const Hulls& hulls, const PlacedHulls& placed,
                                            double distance) {
  const std::vector<Box> boxes = boxes_of(hulls, placed, distance / 2);
  std::vector<BoxInStrip> strips;
  std::vector<std::array<int, 2>> pairs;
  find_overlaps(boxes, hulls.body, strips, pairs);
  return pairs;
}

// Pairs of a part of a body below number `n_moving` and a part of a fixed one, whose boxes overlap.
// Moving bodies may lie in one place by the thousand, so their pairs must not be looked at.
std::vector<std::array<int, 2>> close_to_standing(const Hulls& hulls, const PlacedHulls& placed,
                                                  int n_moving) {
  const std::vector<Box> boxes = boxes_of(hulls, placed, 0);
  const auto first = static_cast<std::size_t>(
      std::lower_bound(hulls.body.begin(), hulls.body.end(), n_moving) - hulls.body.begin());
  std::vector<std::array<int, 2>> pairs;
  if (first == boxes.size()) return pairs;
  Box reach = boxes[first];
  for (std::size_t s = first; s < boxes.size(); ++s) {
    reach.low = reach.low.cwiseMin(boxes[s].low);
    reach.high = reach.high.cwiseMax(boxes[s].high);
  }
  for (std::size_t m = 0; m < first; ++m) {
    if (!overlap(boxes[m], reach)) continue;
    for (std::size_t s = first; s < boxes.size(); ++s)
      if (overlap(boxes[m], boxes[s])) pairs.push_back({static_cast<int>(m), static_cast<int>(s)});
  }
  return pairs;
}

std::vector<Vec3> corners_of(const Hulls& hulls, const PlacedHulls& placed, int part, int slot) {
  std::vector<Vec3> corners;
  for (int k = hulls.loop_begin[slot]; k < hulls.loop_begin[slot + 1]; ++k)
    corners.push_back(placed.vertices[hulls.vertex_begin[part] + hulls.loop_vertices[k]]);
  return corners;
}

void add_joint_contacts(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b,
                        double tolerance, double opposed, std::vector<JointContact>& contacts) {
  for (int i = 0; i < hulls.n_faces[part_a]; ++i)
    for (int k = 0; k < hulls.n_faces[part_b]; ++k) {
      const int face_a = hulls.face_begin[part_a] + i, face_b = hulls.face_begin[part_b] + k;
      if (hulls.cover[face_a] == FaceCover::all || hulls.cover[face_b] == FaceCover::all) continue;
      const Vec3 normal_a = normal_at(placed, face_a), normal_b = normal_at(placed, face_b);
      if (normal_a.dot(normal_b) > -opposed) continue;
      FaceOverlap common = face_overlap(corners_of(hulls, placed, part_a, face_a), normal_a,
                                        corners_of(hulls, placed, part_b, face_b));
      if (!(common.area > tolerance * tolerance)) continue;
      if (std::abs(normal_b.dot(common.centre) - placed.offset[face_b]) > tolerance) continue;
      contacts.push_back({hulls.body[part_a], hulls.body[part_b], hulls.joint_set[face_a],
                          hulls.joint_set[face_b], normal_b, common.centre, common.area,
                          std::move(common.outline)});
    }
}

// Common part of two placed parts; no faces when there is none.
Polyhedron common_part(const Hulls& hulls, const PlacedHulls& placed, int part_a, int part_b) {
  Polyhedron common = placed_part(hulls, placed, part_a);
  const double on_plane = 1e-9 * std::min(hulls.thickness[part_a], hulls.thickness[part_b]);
  for (int f = 0; f < hulls.n_faces[part_b] && n_faces(common) > 0; ++f) {
    const int slot = hulls.face_begin[part_b] + f;
    common = clip_convex(common, {normal_at(placed, slot), placed.offset[slot]}, 0, on_plane);
  }
  return common;
}

}  // namespace

std::vector<JointContact> joint_contacts(const Hulls& hulls, const PlacedHulls& placed,
                                         double tolerance, double angle) {
  std::vector<JointContact> contacts;
  for (const auto& [a, b] : close_parts(hulls, placed, 2 * tolerance))
    add_joint_contacts(hulls, placed, a, b, tolerance, std::cos(angle), contacts);
  return contacts;
}

std::vector<BlockOverlap> block_overlaps(const Hulls& hulls, const PlacedHulls& placed,
                                         double tolerance, int n_moving, bool among_moving) {
  std::vector<BlockOverlap> overlaps;
  std::map<std::pair<int, int>, std::size_t> place_of;  // of a pair in the list
  AxisScratch scratch;
  for (const auto& [a, b] :
       among_moving ? close_parts(hulls, placed, 0) : close_to_standing(hulls, placed, n_moving)) {
    if (hulls.body[a] >= n_moving && hulls.body[b] >= n_moving) continue;
    const AxisChoice axis = find_axis(hulls, placed, a, b, -tolerance, {}, scratch);
    if (!axis.touches) continue;
    const Moments common = moments(common_part(hulls, placed, a, b));
    if (!(common.volume > 0)) continue;
    const int block_a = hulls.body[a], block_b = hulls.body[b];
    const auto [known, is_new] = place_of.try_emplace({block_a, block_b}, overlaps.size());
    if (is_new) overlaps.push_back({block_a, block_b, 0, 0, Vec3::Zero(), Vec3::Zero()});
    BlockOverlap& sum = overlaps[known->second];
    sum.point =
        (sum.volume * sum.point + common.volume * common.centroid) / (sum.volume + common.volume);
    sum.volume += common.volume;
    if (-axis.separation <= sum.depth) continue;
    sum.depth = -axis.separation;
    sum.normal = axis.normal;
  }
  std::stable_sort(overlaps.begin(), overlaps.end(),
                   [](const BlockOverlap& p, const BlockOverlap& q) { return p.depth > q.depth; });
  return overlaps;
}

Polyhedron placed_part(const Hulls& hulls, const PlacedHulls& placed, int p) {
  Polyhedron part;
  const int first = hulls.vertex_begin[p];
  for (int v = first; v < hulls.vertex_begin[p + 1]; ++v)
    part.vertices.push_back(placed.vertices[v]);
  for (int f = hulls.face_begin[p]; f < hulls.face_begin[p] + hulls.n_faces[p]; ++f)
    add_face(part,
             std::span(hulls.loop_vertices)
                 .subspan(hulls.loop_begin[f], hulls.loop_begin[f + 1] - hulls.loop_begin[f]),
             hulls.joint_set[f]);
  return part;
}

}  // namespace talus
