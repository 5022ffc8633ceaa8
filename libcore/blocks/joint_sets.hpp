// libcore/blocks/joint_sets.hpp: public
// Joint sets: from dip, dip direction, spacing and scatter to the planes that cut the mass, and
// from measured orientations to sets.
//
// in:    the geologist's convention: dip 0-90 below the horizontal, dip direction clockwise from
//        north
// out:   planes in a ball around the mass, the same for the same seed
// refs:  Fisher 1953 (scatter); Scheidegger 1965 (mean of axes); Hall 1988 (coverage by discs)
#pragma once

#include <string>
#include <vector>

#include "base/random.hpp"
#include "geometry/plane.hpp"

namespace talus {

enum class Spacing { fixed, uniform, exponential, lognormal };

struct JointSet {
  std::string name;
  double dip = 0;            ///< [rad]
  double dip_direction = 0;  ///< clockwise from north (y) [rad]
  Spacing spacing = Spacing::fixed;
  double mean_spacing = 1;              ///< > 0 [m]
  double spacing_a = 0, spacing_b = 0;  ///< uniform: ends; lognormal: a = standard deviation [m]
  double fisher_k = 0;                  ///< 0 = all planes parallel
  double persistence = 1;               ///< share of each plane that is open, 0 to 1
  double disc_diameter = 0;             ///< of the open discs, used where persistence < 1 [m]
  double offset = 0;                    ///< of one plane from the centre, along the normal [m]
};

struct Disc {
  Vec3 centre = Vec3::Zero();  ///< on its plane [m]
  double radius = 0;           ///< [m]
};

/// One joint: a whole plane, or the discs in it that are open.
struct Joint {
  Plane plane;
  int set = 0;
  bool is_through = true;
  std::vector<Disc> discs;  ///< empty when `is_through`
};

/// Unit normal of a plane that dips so, upward: (sin d sin a, sin d cos a, cos d). Components below
/// 1e-15 are exactly 0, so that vertical and axis-parallel joints are exactly so.
[[nodiscard]] Vec3 pole(double dip, double dip_direction);

/// Dip and dip direction of a plane by its normal, of either sign [rad].
struct Attitude {
  double dip = 0, dip_direction = 0;
};
[[nodiscard]] Attitude attitude(const Vec3& normal);

/// One spacing of the set's distribution [m].
[[nodiscard]] double draw_spacing(const JointSet& set, Random& random);

/// A direction around `mean` with the Fisher density, exp(k cos t) sin t.
[[nodiscard]] Vec3 draw_fisher(const Vec3& mean, double k, Random& random);

/// The joints of set number `index` that cross the ball around `centre`.
///
/// Planes follow each other along the mean normal from `offset` on, in both directions. Open discs
/// are a Boolean model: centres at random with density -ln(1 - persistence) / (pi r^2), which
/// leaves the share `persistence` of the plane open.
[[nodiscard]] std::vector<Joint> draw_joints(const JointSet& set, int index, const Vec3& centre,
                                             double radius, std::uint64_t seed);

/// Measures of a mass that determine its number of joint cells.
struct MassMeasure {
  double volume = 0;               ///< [m3]
  std::vector<Vec3> vertices;      ///< of its surface [m]
  std::vector<Vec3> area_vectors;  ///< of the faces of its surface, of either sign [m2]
  double plan_area = 0;            ///< [m2]
  double max_depth = 0;            ///< vertical [m]
};

/// Mean number of discs that draw_joints() draws for a ball [m]; 0 for a persistence of 1.
[[nodiscard]] double expected_discs(const JointSet& set, double radius);

/// Mean number of joint cells in a mass, taking every joint as through-going; 1 at least. Sets of
/// which less than one joint is expected to cross the mass are left out. For the rest, with
/// spacings s and normals n, the first kind that exists is counted:
/// - points where joints of three sets meet: volume times |n1 . (n2 x n3)| / (s1 s2 s3),
/// - prisms of two sets: area of the mass seen along them times |n1 x n2| / (s1 s2),
/// - slabs of one set: width of the mass along its normal over s,
/// summed over all sets that make them. Cells cut off at the surface of the mass come on top.
[[nodiscard]] double expected_cells(const std::vector<JointSet>& sets, const MassMeasure& mass);

/// A set found among measured poles.
struct PoleGroup {
  Vec3 mean = Vec3::UnitZ();  ///< unit, upward
  double fisher_k = 0;        ///< (n - 1) / (n - R); infinity when all are the same
  std::vector<int> members;   ///< indices of the poles
};

/// Groups poles, which are axes (n and -n the same), into `n_groups` by k-means on the sphere:
/// first centres are the poles farthest apart, means the main axis of the orientation tensor.
/// Groups come largest first. Throws InputError for fewer poles than groups.
[[nodiscard]] std::vector<PoleGroup> group_poles(const std::vector<Vec3>& poles, int n_groups);

}  // namespace talus
