// Which blocks can leave a mass, by projections on joint pyramids, round by round.
#include "blocks/removability.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/units.hpp"

namespace talus {
namespace {

constexpr double parallel = 1e-12;      // length of the cross product of unit normals
constexpr double tolerance = 1e-9;      // of products of unit vectors
constexpr double least_contact = 0.02;  // area over V^(2/3)
const double merging_cosine = std::cos(degree);

bool leaves(const Vec3& direction, std::span<const Vec3> normals) {
  return std::all_of(normals.begin(), normals.end(),
                     [&](const Vec3& n) { return n.dot(direction) >= -tolerance; });
}

// Whether the planes allow `direction`, which has the size of the force.
bool leaves(const Vec3& direction, double force, std::span<const RestPlane> planes) {
  return std::all_of(planes.begin(), planes.end(), [&](const RestPlane& plane) {
    return plane.normal.dot(direction) >= -tolerance * force;
  });
}

// The mode of contact with these planes, if it is the projection; keeps that of the largest
// resistance.
void consider(const Vec3& direction, std::vector<int> bearing, double resistance, double force,
              std::span<const RestPlane> planes, BlockMode& best, bool& found) {
  if (!leaves(direction, force, planes)) return;
  const double driving = direction.norm();
  if (!(driving > tolerance * force)) return;
  // Projections are one and the same; a shorter one came from a set that rounding let in.
  if (found && driving < best.driving * (1 - 1e-7)) return;
  if (found && driving <= best.driving * (1 + 1e-7) && resistance <= best.resistance) return;
  best = {direction, std::move(bearing), driving, resistance};
  found = true;
}

double resistance_of(const RestPlane& plane, double normal_force) {
  return normal_force * plane.friction + plane.cohesion;
}

}  // namespace

bool can_leave(std::span<const Vec3> normals) {
  if (normals.empty()) return true;
  bool all_parallel = true;
  for (size_t i = 0; i < normals.size(); ++i)
    for (size_t j = i + 1; j < normals.size(); ++j) {
      const Vec3 line = normals[i].cross(normals[j]);
      if (line.norm() < parallel) continue;
      all_parallel = false;
      const Vec3 direction = line.normalized();
      if (leaves(direction, normals) || leaves(-direction, normals)) return true;
    }
  return all_parallel;  // along the planes themselves
}

double BlockMode::factor() const {
  return driving > 0 ? resistance / driving : std::numeric_limits<double>::infinity();
}

BlockMode block_mode(const Vec3& force, std::span<const RestPlane> planes) {
  const double size = force.norm();
  BlockMode best;
  if (!(size > 0)) return best;
  if (leaves(force, size, planes)) return {force, {}, size, 0};
  bool found = false;
  const int n = static_cast<int>(planes.size());
  for (int i = 0; i < n; ++i) {
    const double pressed = -planes[i].normal.dot(force);
    if (pressed < 0) continue;
    consider(force + pressed * planes[i].normal, {i}, resistance_of(planes[i], pressed), size,
             planes, best, found);
  }
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j) {
      const Vec3 line = planes[i].normal.cross(planes[j].normal);
      if (line.norm() < 1e-6) continue;
      const Vec3 along = line.normalized();
      // force + a n_i + b n_j has no part along either normal
      const double c = planes[i].normal.dot(planes[j].normal);
      const double p = -planes[i].normal.dot(force), q = -planes[j].normal.dot(force);
      const double a = (p - c * q) / (1 - c * c), b = (q - c * p) / (1 - c * c);
      if (a < -tolerance * size || b < -tolerance * size) continue;
      consider(
          force.dot(along) * along, {i, j},
          resistance_of(planes[i], std::max(0.0, a)) + resistance_of(planes[j], std::max(0.0, b)),
          size, planes, best, found);
    }
  return best;
}

std::vector<std::vector<BlockContact>> contacts_of(const BlockSet& blocks,
                                                   const FaceFriction& friction) {
  std::vector<std::vector<BlockContact>> contacts(static_cast<size_t>(n_blocks(blocks)));
  const auto add = [&](int block, int other, const Vec3& inward, double tangent, double area) {
    if (area < least_contact * std::pow(blocks.volume[block], 2.0 / 3)) return;
    contacts[block].push_back({other, {inward, tangent, 0}, area});
  };
  for (size_t p = 0; p < blocks.pair_blocks.size(); ++p) {
    const auto [a, b] = blocks.pair_blocks[p];
    const int set = blocks.pair_joint_set[p];
    const bool is_joint = set >= 0 && set < static_cast<int>(friction.of_set.size());
    const double tangent = is_joint ? friction.of_set[set] : friction.of_rock;
    add(a, b, -blocks.pair_normal[p], tangent, blocks.pair_area[p]);
    add(b, a, blocks.pair_normal[p], tangent, blocks.pair_area[p]);
  }
  for (int b = 0; b < n_blocks(blocks); ++b) {
    const Polyhedron shell = block_shell(blocks, b);
    for (int f = 0; f < n_faces(shell); ++f) {
      const int origin = shell.face_tag[f];
      if (origin != face_failure && origin != face_source_side) continue;
      add(b, -1, -face_normal(shell, f),
          origin == face_failure ? friction.of_bed : friction.of_rock, face_area(shell, f));
    }
  }
  return contacts;
}

std::vector<RestPlane> merged(std::span<const BlockContact> contacts) {
  struct Sum {
    Vec3 normal;
    double area, friction, cohesion;
  };
  std::vector<Sum> sums;
  for (const BlockContact& contact : contacts) {
    const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
      return sum.normal.normalized().dot(contact.plane.normal) > merging_cosine;
    });
    const double area = std::max(contact.area, 1e-300);
    if (same == sums.end()) {
      sums.push_back({area * contact.plane.normal, area, area * contact.plane.friction,
                      contact.plane.cohesion});
      continue;
    }
    same->normal += area * contact.plane.normal;
    same->area += area;
    same->friction += area * contact.plane.friction;
    same->cohesion += contact.plane.cohesion;
  }
  std::vector<RestPlane> planes;
  for (const Sum& sum : sums)
    planes.push_back({sum.normal.normalized(), sum.friction / sum.area, sum.cohesion});
  return planes;
}

namespace {

// The remaining part of the mass.
struct Peeling {
  std::span<const std::vector<BlockContact>> contacts;
  std::span<const double> weight;
  std::vector<int> round;

  [[nodiscard]] BlockMode mode_of(int block, std::vector<RestPlane>& planes) const {
    std::vector<BlockContact> left;
    for (const BlockContact& contact : contacts[block])
      if (contact.other < 0 || round[contact.other] < 0) left.push_back(contact);
    planes = merged(left);
    return block_mode(Vec3(0, 0, -weight[block]), planes);
  }
  // Blocks that may have become free when those of `gone` went, ascending.
  [[nodiscard]] std::vector<int> beside(const std::vector<int>& gone) const {
    std::vector<int> found;
    for (const int block : gone)
      for (const BlockContact& contact : contacts[block])
        if (contact.other >= 0 && round[contact.other] < 0) found.push_back(contact.other);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }
};

// Removes free blocks, round by round, beginning with `candidates`; the removed blocks in order.
std::vector<int> peel(Peeling& state, std::vector<int> candidates, int first_round,
                      std::vector<BlockMode>* modes) {
  std::vector<int> all;
  std::vector<RestPlane> planes;
  for (int round = first_round; !candidates.empty(); ++round) {
    std::vector<int> gone;
    for (const int block : candidates) {
      BlockMode mode = state.mode_of(block, planes);
      if (mode.goes()) gone.push_back(block);
      if (modes != nullptr) (*modes)[block] = std::move(mode);
    }
    for (const int block : gone) state.round[block] = round;
    all.insert(all.end(), gone.begin(), gone.end());
    candidates = state.beside(gone);
  }
  return all;
}

bool has_no_direction(const std::vector<RestPlane>& planes) {
  std::vector<Vec3> normals;
  for (const RestPlane& plane : planes) normals.push_back(plane.normal);
  return !can_leave(normals);
}

double sum_of(std::span<const double> weight, const std::vector<int>& blocks) {
  double sum = 0;
  for (const int block : blocks) sum += weight[block];
  return sum;
}

}  // namespace

PeelOff peel_off(std::span<const std::vector<BlockContact>> contacts,
                 std::span<const double> weight) {
  const int n = static_cast<int>(weight.size());
  PeelOff result;
  result.mode.resize(weight.size());
  Peeling state{contacts, weight, std::vector<int>(weight.size(), -1)};
  std::vector<int> everything(weight.size());
  std::iota(everything.begin(), everything.end(), 0);
  const double total = sum_of(weight, everything);
  if (!(total > 0)) return result;
  result.share = sum_of(weight, peel(state, everything, 0, &result.mode)) / total;
  result.round = state.round;
  std::vector<RestPlane> planes;
  for (int b = 0; b < n; ++b) {
    if (result.round[b] >= 0) continue;
    static_cast<void>(state.mode_of(b, planes));
    if (has_no_direction(planes)) result.locked_share += weight[b] / total;
  }
  for (int b = 0; b < n; ++b) {
    if (result.round[b] >= 0) continue;
    state.round[b] = 0;  // as if it were taken away
    const std::vector<int> freed = peel(state, state.beside({b}), 1, nullptr);
    for (const int block : freed) state.round[block] = -1;
    state.round[b] = -1;
    if (!freed.empty()) result.locks.push_back({b, sum_of(weight, freed) / total});
  }
  std::stable_sort(result.locks.begin(), result.locks.end(),
                   [](const Lock& a, const Lock& b) { return a.freed > b.freed; });
  return result;
}

}  // namespace talus
