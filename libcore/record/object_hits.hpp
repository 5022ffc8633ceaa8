// libcore/record/object_hits.hpp: public
// Which blocks come onto which endangered objects, and how: at the first touch and while over them.
// in:    the solver's segments; objects in plan
// out:   one row per block and object
//
// A block touches an object when its footprint, the polygon of record/passages.hpp, comes within a
// millimetre of it in plan. Objects stop nothing: a block that flies over one touches it too, and
// its heights say so. The moment is found by steps of at most the time that the gap allows at a
// speed that no point of the footprint can exceed.
//
// What lies under the roof of a gallery is touched by nothing above it: the part of a footprint
// over the roof does not count. Where a block comes off a roof the moment is found by halving steps
// of a quarter of the block.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "record/motion.hpp"
#include "terrain/trn.hpp"

namespace talus {

struct Scene;

/// A piece of an object: an area, or a line or point with a radius about it.
struct ObjectPart {
  std::vector<Vec2> points;  ///< local [m]; of an area its outline, without the first again
  bool is_area = false;
};
struct RecordObject {
  std::string name, kind;
  std::vector<ObjectPart> parts;
  double radius = 0;                       ///< about lines and points; 0 for areas [m]
  std::vector<std::vector<Vec2>> roofs{};  ///< over it: convex rings, counter-clockwise, local [m]
};

struct ObjectHit {
  std::int32_t block = 0, object = 0;
  // at the first touch
  double time = 0;                  ///< [s]
  Vec3 position = Vec3::Zero();     ///< of the centroid, local [m]
  double speed = 0;                 ///< [m/s]
  double translational_energy = 0;  ///< [J]
  double total_energy = 0;          ///< with rotation [J]
  double top_height = 0;            ///< highest vertex above the ground below the centroid [m]
  double bottom_height = 0;         ///< lowest vertex above it [m]
  // largest while over the object; of the steps and, in flight, of moments close to each other
  double largest_speed = 0;                 ///< [m/s]
  double largest_translational_energy = 0;  ///< [J]
  double largest_total_energy = 0;          ///< [J]
  double largest_top_height = 0;            ///< [m]
};

/// Distance in plan of a convex polygon from an object, 0 where they overlap [m]. The part of the
/// polygon over a roof of the object does not count; infinite where there is no other.
[[nodiscard]] double gap_to(const RecordObject& object, const std::vector<Vec2>& convex);
/// Of a point; 0 on the object [m]; infinite over a roof of it.
[[nodiscard]] double gap_to(const RecordObject& object, const Vec2& point);

struct ObjectRecorder {
  std::vector<RecordObject> objects;
  std::vector<ObjectHit> rows;       ///< in the order of the first touch
  std::vector<std::int32_t> row_of;  ///< of block b and object o at [b * n_objects + o], -1 none
  std::vector<double> clearance;     ///< block b meets no object before it moves so far [m]
  std::vector<Vec2> footprint;       ///< scratch
};

[[nodiscard]] ObjectRecorder start_objects(const Scene& scene, std::vector<RecordObject> objects);

/// The next segment of a block, which `motion` follows; segments of one block come in the order of
/// time.
void record_objects(ObjectRecorder& recorder, const Scene& scene, SegmentMotion& motion);

/// Takes back the rows of a run in progress.
void restore(ObjectRecorder& recorder, const std::vector<ObjectHit>& rows);

/// Rows to be written, in the order of object, then block.
[[nodiscard]] std::vector<ObjectHit> sorted(const ObjectRecorder& recorder);

/// Largest values of both; the first touch is the earlier one's.
[[nodiscard]] ObjectHit joined(const ObjectHit& a, const ObjectHit& b);

}  // namespace talus
