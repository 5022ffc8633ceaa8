// libcore/blocks/kinematics.hpp: public
// Kinematic analysis: on which share of a slope's face a joint set, or a pair of sets, is free to
// slide or to topple.
// in:    the face as triangles of the ground, the attitudes and friction of the sets
// out:   shares by area, with their spread where attitudes scatter
// refs:  Goodman 1989; Hocking 1976 (sliding on one plane of a wedge); Wyllie and Mah 2004
//
// It looks at the face alone. A mass is held by the bed at its foot: a slope that is free all over
// by these shares may be stable. docs/tools/talus-check.md
#pragma once

#include <string>
#include <vector>

#include "blocks/area.hpp"
#include "blocks/joint_sets.hpp"
#include "terrain/trn.hpp"

namespace talus {

/// How far the dip direction may lie beside the fall line for a mass to slide, or to topple [deg].
inline constexpr double lateral_limit_deg = 20, toppling_limit_deg = 30;
/// Attitudes drawn of a set that scatters.
inline constexpr int n_kinematic_draws = 1000;

/// A triangle of the ground, as far as it lies in the area.
struct FacePiece {
  Vec3 normal = Vec3::UnitZ();  ///< unit, upward
  double area = 0;              ///< sloping [m2]
};
/// The ground in the area.
[[nodiscard]] std::vector<FacePiece> face_in(const Trn& ground, const Area& area);

/// Azimuth of the steepest descent of a face [rad].
[[nodiscard]] double aspect_of(const Vec3& normal);
/// Angle between two azimuths, 0 to pi [rad].
[[nodiscard]] double angle_between(double azimuth, double other);

/// The direction down the dip of a plane: unit.
[[nodiscard]] Vec3 dip_vector(double dip, double dip_direction);

/// Plane sliding: the plane daylights in the face and is steeper than friction [rad].
[[nodiscard]] bool slides_on_plane(const Attitude& plane, const Vec3& face, double friction);
/// Flexural toppling: layers that dip steeply into the slope bend over.
[[nodiscard]] bool topples(const Attitude& plane, const Vec3& face, double friction);

/// Two planes under a wedge.
struct Wedge {
  Vec3 line = Vec3::Zero();  ///< their intersection, unit, downward; zero where they are parallel
  double plunge = 0, trend = 0;  ///< of the line [rad]
  double factor = 0;             ///< friction over driving force along the line [-]
  bool on_both = false;          ///< both planes are in contact; else the rock slides on one of
                                 ///< them alone
};
/// `friction`: tangents.
[[nodiscard]] Wedge wedge_of(const Attitude& first, const Attitude& second, double first_friction,
                             double second_friction);
/// The wedge slides on both planes and comes out of the face.
[[nodiscard]] bool slides(const Wedge& wedge, const Vec3& face);
/// Columns between two sets topple out of the face along the line of the sets; [rad].
[[nodiscard]] bool columns_topple(const Wedge& wedge, const Vec3& face, double friction);

/// A joint set as kinematics sees it.
struct KinematicSet {
  std::string name;
  Attitude mean;
  std::vector<Attitude> draws;  ///< attitudes drawn for it; empty: the mean alone
  double friction = 0;          ///< tangent
};
/// Attitudes of a set with Fisher scatter about its mean, the same for the same set.
[[nodiscard]] std::vector<Attitude> drawn_attitudes(const JointSet& set);

/// A share of the face, over the draws.
struct FaceShare {
  double mean = 0, p10 = 0, p90 = 0;
};

struct SetKinematics {
  std::string name;
  FaceShare sliding;          ///< on its plane, whatever the direction
  FaceShare sliding_lateral;  ///< within the lateral limit of the fall line
  FaceShare toppling;         ///< flexural
};
struct PairKinematics {
  int first = 0, second = 0;  ///< sets
  Wedge wedge;                ///< of the mean attitudes
  FaceShare sliding;          ///< as a wedge on both planes
  FaceShare toppling;         ///< as columns over any set that dips out of the slope
};
struct Kinematics {
  std::vector<SetKinematics> sets;
  std::vector<PairKinematics> pairs;
};
/// Draw k of all sets is taken together: the same attitudes for all modes.
[[nodiscard]] Kinematics kinematics_of(const std::vector<FacePiece>& face,
                                       const std::vector<KinematicSet>& sets);

}  // namespace talus
