// Joint sets: from dip, spacing and scatter to planes, and from measured orientations to sets.
#include "blocks/joint_sets.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.hpp"

namespace talus {
namespace {

constexpr double pi = std::numbers::pi;

double cleaned(double component) { return std::abs(component) < 1e-15 ? 0 : component; }

// Two unit vectors that make a right-handed frame with `axis`.
std::pair<Vec3, Vec3> frame_across(const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

// Half the side of the square around the ball's section, wide enough that discs from outside reach
// in.
double half_square(const JointSet& set, double radius) { return radius + set.disc_diameter / 2; }

// Centres of discs on a unit of area: they leave the share 1 - persistence of it whole.
double disc_density(const JointSet& set) {
  const double disc_radius = set.disc_diameter / 2;
  return -std::log1p(-set.persistence) / (pi * disc_radius * disc_radius);
}

// Open discs of one plane inside the ball: Poisson centres in the square around its section.
std::vector<Disc> draw_discs(const JointSet& set, const Plane& plane, const Vec3& centre,
                             double radius, Random& random) {
  const double disc_radius = set.disc_diameter / 2;
  const Vec3 middle = centre - distance(plane, centre) * plane.normal;
  const auto [u, v] = frame_across(plane.normal);
  const double half = half_square(set, radius);
  const double density = disc_density(set);
  std::vector<Disc> discs;
  // A Poisson process row by row: exponential steps along a line of unit density.
  for (double along = random.exponential(); along < density * 4 * half * half;
       along += random.exponential())
    discs.push_back(
        {middle + random.uniform(-half, half) * u + random.uniform(-half, half) * v, disc_radius});
  return discs;
}

// Largest |n . c|: the group that an axis belongs to.
int nearest_group(const Vec3& pole, const std::vector<PoleGroup>& groups) {
  int best = 0;
  for (int g = 1; g < static_cast<int>(groups.size()); ++g)
    if (std::abs(pole.dot(groups[g].mean)) > std::abs(pole.dot(groups[best].mean))) best = g;
  return best;
}

Vec3 upward(const Vec3& axis) {
  return axis.z() < 0 || (axis.z() == 0 && axis.y() < 0) ? Vec3(-axis) : axis;
}

// Main axis of sum n n^T.
Vec3 mean_axis(const std::vector<Vec3>& poles, const std::vector<int>& members) {
  Mat3 tensor = Mat3::Zero();
  for (const int i : members) tensor += poles[i] * poles[i].transpose();
  return upward(Eigen::SelfAdjointEigenSolver<Mat3>(tensor).eigenvectors().col(2));
}

std::vector<PoleGroup> farthest_apart(const std::vector<Vec3>& poles, int n_groups) {
  std::vector<PoleGroup> groups(1);
  std::vector<int> all(poles.size());
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  const Vec3 mean = mean_axis(poles, all);
  groups[0].mean = mean;
  // The first centre is the pole nearest to the common mean; each next one is the farthest.
  for (const Vec3& pole : poles)
    if (std::abs(pole.dot(mean)) > std::abs(groups[0].mean.dot(mean))) groups[0].mean = pole;
  while (static_cast<int>(groups.size()) < n_groups) {
    const Vec3* farthest = &poles[0];
    double smallest = std::numeric_limits<double>::infinity();
    for (const Vec3& pole : poles) {
      const double nearest = std::abs(pole.dot(groups[nearest_group(pole, groups)].mean));
      if (nearest < smallest) smallest = nearest, farthest = &pole;
    }
    groups.push_back({*farthest, 0, {}});
  }
  return groups;
}

void find_concentration(const std::vector<Vec3>& poles, PoleGroup& group) {
  Vec3 resultant = Vec3::Zero();
  for (const int i : group.members)
    resultant += poles[i].dot(group.mean) < 0 ? Vec3(-poles[i]) : poles[i];
  const double n = static_cast<double>(group.members.size());
  const double spread = n - resultant.norm();
  group.fisher_k = spread > 1e-12 * n ? (n - 1) / spread : std::numeric_limits<double>::infinity();
}

}  // namespace

Vec3 pole(double dip, double dip_direction) {
  const Vec3 n(cleaned(std::sin(dip) * std::sin(dip_direction)),
               cleaned(std::sin(dip) * std::cos(dip_direction)), cleaned(std::cos(dip)));
  return n.normalized();
}

Attitude attitude(const Vec3& normal) {
  const Vec3 n = upward(normal);
  const double horizontal = std::hypot(n.x(), n.y());
  double direction = horizontal > 0 ? std::atan2(n.x(), n.y()) : 0;
  if (direction < 0) direction += 2 * pi;
  return {std::atan2(horizontal, n.z()), direction};
}

double draw_spacing(const JointSet& set, Random& random) {
  switch (set.spacing) {
    case Spacing::fixed:
      return set.mean_spacing;
    case Spacing::uniform:
      return random.uniform(set.spacing_a, set.spacing_b);
    case Spacing::exponential:
      return set.mean_spacing * random.exponential();
    case Spacing::lognormal:
      break;
  }
  const double ratio = set.spacing_a / set.mean_spacing;
  const double sigma_sq = std::log1p(ratio * ratio);
  return set.mean_spacing * std::exp(std::sqrt(sigma_sq) * random.normal() - sigma_sq / 2);
}

Vec3 draw_fisher(const Vec3& mean, double k, Random& random) {
  // Inverse of the distribution of cos t, written so that large k does not overflow.
  const double drawn = random.uniform();
  const double cosine =
      k < 1e-3 ? 1 + std::log1p((1 - drawn) * std::expm1(-2 * k)) / k  // 1 + small: digits lost
               : 1 + std::log(drawn + (1 - drawn) * std::exp(-2 * k)) / k;
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double turn = random.uniform(0, 2 * pi);
  const auto [u, v] = frame_across(mean);
  return (cosine * mean + sine * (std::cos(turn) * u + std::sin(turn) * v)).normalized();
}

std::vector<Joint> draw_joints(const JointSet& set, int index, const Vec3& centre, double radius,
                               std::uint64_t seed) {
  Random random(seed, "joints " + set.name);
  const Vec3 mean = pole(set.dip, set.dip_direction);
  std::vector<Joint> joints;
  const auto add = [&](double along) {
    Joint joint;
    joint.set = index;
    const Vec3 normal = set.fisher_k > 0 ? draw_fisher(mean, set.fisher_k, random) : mean;
    joint.plane = plane_through(centre + along * mean, normal);
    joint.is_through = set.persistence >= 1;
    if (!joint.is_through) joint.discs = draw_discs(set, joint.plane, centre, radius, random);
    if (std::abs(distance(joint.plane, centre)) < radius) joints.push_back(std::move(joint));
  };
  // Scattered planes may start outside the ball and still cross it, hence twice the radius.
  const double reach = set.fisher_k > 0 ? 2 * radius : radius;
  // From a plane far away the path to the ball is not walked joint by joint.
  const double offset =
      std::abs(set.offset) > reach ? std::fmod(set.offset, set.mean_spacing) : set.offset;
  for (double along = offset; along < reach; along += draw_spacing(set, random))
    if (along > -reach) add(along);
  for (double along = offset - draw_spacing(set, random); along > -reach;
       along -= draw_spacing(set, random))
    if (along < reach) add(along);
  return joints;
}

double expected_discs(const JointSet& set, double radius) {
  if (set.persistence >= 1) return 0;
  const double half = half_square(set, radius);
  return 2 * radius / set.mean_spacing * disc_density(set) * 4 * half * half;
}

double expected_cells(const std::vector<JointSet>& sets, const MassMeasure& mass) {
  // Along a direction: the visible area is half of that of all faces, as each line enters and
  // leaves.
  const auto area_along = [&](const Vec3& direction) {
    double shown = 0;
    for (const Vec3& area : mass.area_vectors) shown += std::abs(area.dot(direction));
    return shown / 2;
  };
  const auto width_along = [&](const Vec3& direction) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& v : mass.vertices)
      low = std::min(low, direction.dot(v)), high = std::max(high, direction.dot(v));
    return std::max(0.0, high - low);
  };
  double points = 0, prisms = 0, slabs = 0;
  std::vector<Vec3> normals;
  std::vector<double> spacings;
  for (const JointSet& set : sets) {
    const Vec3 normal = pole(set.dip, set.dip_direction);
    const double n_joints = width_along(normal) / set.mean_spacing;
    if (n_joints < 1) continue;
    slabs += n_joints;
    normals.push_back(normal);
    spacings.push_back(set.mean_spacing);
  }
  const size_t n = normals.size();
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 1; j < n; ++j) {
      prisms += area_along(normals[i].cross(normals[j])) / (spacings[i] * spacings[j]);
      for (size_t k = j + 1; k < n; ++k)
        points += std::abs(normals[i].dot(normals[j].cross(normals[k]))) /
                  (spacings[i] * spacings[j] * spacings[k]);
    }
  points *= mass.volume;
  return std::max(1.0, points > 0 ? points : prisms > 0 ? prisms : slabs);
}

std::vector<PoleGroup> group_poles(const std::vector<Vec3>& poles, int n_groups) {
  if (static_cast<int>(poles.size()) < n_groups)
    throw InputError({},
                     std::to_string(poles.size()) + " measured orientations cannot make " +
                         std::to_string(n_groups) + " sets",
                     "measure more, or ask for fewer sets with n_sets");
  std::vector<PoleGroup> groups = farthest_apart(poles, n_groups);
  std::vector<int> group_of(poles.size(), -1);
  for (int round = 0; round < 200; ++round) {
    bool has_changed = false;
    for (PoleGroup& group : groups) group.members.clear();
    for (size_t i = 0; i < poles.size(); ++i) {
      const int g = nearest_group(poles[i], groups);
      has_changed |= g != group_of[i];
      group_of[i] = g;
      groups[g].members.push_back(static_cast<int>(i));
    }
    if (!has_changed) break;
    for (PoleGroup& group : groups)
      if (!group.members.empty()) group.mean = mean_axis(poles, group.members);
  }
  std::erase_if(groups, [](const PoleGroup& group) { return group.members.empty(); });
  for (PoleGroup& group : groups) find_concentration(poles, group);
  std::stable_sort(groups.begin(), groups.end(), [](const PoleGroup& a, const PoleGroup& b) {
    return a.members.size() > b.members.size();
  });
  return groups;
}

}  // namespace talus
