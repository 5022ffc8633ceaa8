// libcore/contact/block_pairs.hpp: public
// Contacts between blocks, step by step: a list of close pairs and an axis for each pair, each kept
// while its motion budget lasts; features that meet, for a thousandth of the thickness.
// in:    placed hulls, and how far the bodies may move in the coming step
// out:   manifolds sorted by part of A, then part of B
// theory: docs/theory/theory.md 2.1-2.3, 2.6
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/workers.hpp"
#include "contact/body_grid.hpp"
#include "contact/hulls.hpp"
#include "contact/manifold.hpp"
#include "contact/neighbours.hpp"
#include "contact/separating_axis.hpp"

namespace talus {

struct PairSettings {
  double margin = 0;  ///< points are reported up to this gap plus the coming step's motion [m]
  bool with_areas = false;  ///< for bonds and rough joints
  /// A body that slides over a floor of several blocks grazes the sides of those that it has just
  /// reached: a contact is dropped as grazing when the parts overlap by less than this part of
  /// their thickness (plus graze_m) along another face normal, and another block already supports
  /// the body in that direction.
  double graze_ratio = 5e-3;
  double graze_m = 0;          ///< at least the penetration that the solver leaves under load [m]
  bool use_cache = true;       ///< off: list and axes are searched anew each time, for tests
  double closing = 0;          ///< points that come so near close, see PairMotion::closing_only [m]
  Workers* workers = nullptr;  ///< share the listed pairs; nullptr: there are none
};

/// A fixed body that has moved from its first place, for one free body alone.
struct ShiftedBody {
  int body = 0;
  Pose at_first, now;
};
/// Says which do, where free bodies that do not meet push fixed bodies each for itself.
class ShiftedBodies {
 public:
  virtual ~ShiftedBodies() = default;
  /// Appends those of free body `free`.
  virtual void of(int free, std::vector<ShiftedBody>& out) const = 0;
};

/// How far each body moves in the coming step, for margins and for the list's range. The last
/// bodies of the hulls may be fixed: they need no contacts of their own, and only those near a free
/// body are looked at.
struct PairMotion {  // clang-format off
  std::span<const Vec3> step;       ///< displacement of the centroid [m]; empty: none  (n_free)
  std::span<const double> turn;     ///< bound on motion by turning [m]; empty: none    (n_free)
  std::span<const std::uint8_t> awake;  ///< 0: needs no contacts of its own; empty: all (n_free)
  int n_fixed = 0;                  ///< the last bodies
  const BodyGrid* grid = nullptr;   ///< the fixed bodies, in their first places
  std::span<const int> shifted = {};  ///< the fixed bodies that have moved from their first places
  bool free_meet = true;            ///< free bodies meet each other
  const ShiftedBodies* own = nullptr;  ///< then none are in `shifted`, and travel of a fixed body
                                       ///< (PairState) is as long as all pushes together
  std::span<const std::uint8_t> absent = {};  ///< 1: touches nothing; empty: none      (n_free)
  std::span<const std::uint8_t> closing_only = {};  ///< 1: needs no points with its like that do
                                                    ///< not close in the step; empty: none (n_free)
  std::span<const Vec3> rotation = {};  ///< rotation vector of those [rad]              (n_free)
};  // clang-format on

/// When a listed pair must be looked at again.
struct PairWatch {
  double wake = 0;  ///< at a sum of PairState::travel and reach of both bodies above this [m]
  int part_a = 0, part_b = 0;
};

/// Data of a listed pair of parts, and where the bodies were then.
struct ListedPair {
  PairAxis axis;                ///< kind none: not searched yet
  bool touches = false;         ///< along that axis; else it separates the parts
  PairAxis near_edges;          ///< see AxisChoice
  int incident = -1;            ///< incident_face of a face axis
  double hold = -1;             ///< < 0: search; touching: see AxisChoice; apart: separation [m]
  double other_face = 0;        ///< bound on AxisChoice::other_face [m]
  Vec3 between = Vec3::Zero();  ///< position of B less that of A, last clipped or searched [m]
  double turned = 0;            ///< sum of PlacedHulls::turned of both then [m]
  double area = 0;              ///< of the clipped polygon [m2]
  int held_begin = 0, held_end = 0;  ///< its features in PairState::held
};

/// State from step to step. All of it, and PlacedHulls::turned, is needed to resume bit for bit.
struct PairState {  // clang-format off
  std::vector<PairWatch> watch;       ///< sorted by part_a, part_b                      (n_pairs)
  std::vector<ListedPair> pairs;      ///<                                               (n_pairs)
  std::vector<HeldPoint> held;        ///< features of the pairs that touch
  bool in_frame = true;               ///< motion is relative to the mean; false with fixed bodies
  Vec3 frame = Vec3::Zero();          ///< mean position when listed [m]
  std::vector<Vec3> listed_at;        ///< positions when listed [m]                     (n_bodies)
  std::vector<double> listed_turned;  ///< PlacedHulls::turned when listed [m]           (n_bodies)
  std::vector<Box> budget;            ///< motion that the list allows, relative to the frame [m] (n_free)
  double fixed_budget = 0;            ///< the same for fixed bodies, each path [m]
  Vec3 last_frame = Vec3::Zero();     ///< mean position of the last step [m]
  std::vector<Vec3> last_at;          ///< positions of the last step [m]                (n_bodies)
  std::vector<double> last_turned;    ///< PlacedHulls::turned of the last step [m]      (n_bodies)
  std::vector<double> travel;         ///< path relative to the frame, and turning, since listed [m] (n_bodies)
};  // clang-format on

struct PairReport {
  int n_listed = 0;      ///< pairs in the list
  int n_searched = 0;    ///< pairs whose axis was searched
  int n_clipped = 0;     ///< pairs whose features were searched
  int n_grazing = 0;     ///< manifolds dropped as grazing
  int n_fixed_near = 0;  ///< fixed bodies looked at for the list, summed over the free parts
  bool relisted = false;
};

/// Findings at consecutive pairs of the list, and the scratch of one thread.
struct ListLook {
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;
  std::vector<HeldPoint> held;
  std::vector<int> shallow;    ///< manifolds that may be grazing
  std::vector<int> looked_at;  ///< of the list; where threads share it
  int n_searched = 0, n_clipped = 0;
  AxisScratch axis;
  ClipScratch clip;
};

struct PairWork {
  /// Sorted by part_a, part_b. Parts within the margin of which no features lie above each other
  /// yet have a manifold without points: along another axis they may meet all the same.
  std::vector<PairManifold> manifolds;
  std::vector<PairPoint> points;  ///< manifold by manifold
  // scratch
  std::vector<ListLook> looks;  ///< one without further threads
  AxisScratch axis;
  std::vector<BoxInStrip> strips;
  std::vector<Box> boxes;
  std::vector<std::array<int, 2>> close;
  std::vector<PairWatch> next_watch;
  std::vector<ListedPair> next_pairs;
  std::vector<double> reach;  ///< how far each body may reach for contacts [m]
  std::vector<int> shallow;   ///< manifolds that may be grazing
  std::vector<int> bearing, dropped;
  std::vector<int> support_begin, supports;
  std::vector<int> near;             ///< fixed bodies near the part at hand
  std::vector<ShiftedBody> shifted;  ///< of the free body at hand
};

/// All contacts between blocks at the placed poses with gap <= margin + motion of the coming step,
/// one manifold for each pair of parts of different bodies of which one is awake.
///
/// The list is made anew when a body has used up its budget, with boxes grown along the motion
/// ahead and measured in a frame that moves with the bodies' mean, so that a mass that slides as a
/// whole uses none. Deterministic; allocates only while its arrays still grow. `placed` is changed
/// temporarily where motion.own is given, and restored.
PairReport find_pair_contacts(const Hulls& hulls, PlacedHulls& placed, const PairMotion& motion,
                              const PairSettings& settings, PairState& state, PairWork& work);

}  // namespace talus
