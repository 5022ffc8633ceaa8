// Cuts blocks into a tree of pieces before anything moves.
#include "blocks/fragments.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/error.hpp"
#include "base/random.hpp"

namespace talus {
namespace {

using std::size_t;

constexpr double farthest_off = 0.2;  // of the width: how far past the centroid a plane may go
constexpr int most_tries = 4;         // planes that leave a piece too small are drawn again
constexpr double on_plane = 1e-9;     // of the size
constexpr size_t most_bodies = 2000000;

Vec3 random_direction(Random& random) {
  const double z = random.uniform(-1, 1), turn = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// A plane, and which joint set it is of.
struct Cut {
  Plane plane;
  int tag = face_terrain;
  double bonded = 1;
};

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
};
Extent extent_along(const Polyhedron& body, const Vec3& direction) {
  Extent extent;
  for (const Vec3& v : body.vertices) {
    extent.low = std::min(extent.low, direction.dot(v));
    extent.high = std::max(extent.high, direction.dot(v));
  }
  return extent;
}

/// Adds pieces to a set; a struct so that its parts share common data.
struct Splitter {
  BlockSet& set;
  const SplitSettings& settings;
  std::vector<Vec3> normals;  // of the joint sets
  std::vector<int> known;     // joint sets that have one
  std::vector<Fragment> fragments;

  [[nodiscard]] Cut draw(const Polyhedron& body, const Vec3& centroid, Random& random) const {
    Cut cut;
    Vec3 normal = random_direction(random);
    if (settings.splitting == Splitting::joints) {
      cut.tag = known[static_cast<size_t>(random.below(known.size()))];
      normal = normals[static_cast<size_t>(cut.tag)];
      if (!settings.bonded.empty()) cut.bonded = settings.bonded[static_cast<size_t>(cut.tag)];
    }
    const Extent extent = extent_along(body, normal);
    const double off = farthest_off * random.uniform(-1, 1) * (extent.high - extent.low);
    cut.plane = {normal, normal.dot(centroid) + off};
    return cut;
  }

  // The two pieces of body b, and their records.
  void add_pieces(int b, const Cut& cut, const Polyhedron& first, const Polyhedron& second) {
    const auto i = static_cast<size_t>(b);
    const int n = n_blocks(set);
    for (const Polyhedron& piece : {first, second}) {
      add_body(set, {{piece}, {}, set.material[i], Vec3::Zero(), Vec3::Zero()});
      Fragment& made = fragments.emplace_back();
      made.parent = b;
      made.released = fragments[i].released;
      made.generation = fragments[i].generation + 1;
    }
    const double both = set.volume[static_cast<size_t>(n)] + set.volume[static_cast<size_t>(n) + 1];
    for (const size_t k : {static_cast<size_t>(n), static_cast<size_t>(n) + 1})
      fragments[k].volume_share = fragments[i].volume_share * set.volume[k] / both;
    Fragment& whole = fragments[i];
    whole.first_piece = n;
    whole.bonded = cut.bonded;
    whole.cut_normal = cut.plane.normal;
    for (int f = 0; f < n_faces(first); ++f) {
      if (face_normal(first, f).dot(cut.plane.normal) < 1 - on_plane) continue;
      if (std::abs(distance(cut.plane, face_centroid(first, f))) > 1e-6 * extent_size(first))
        continue;
      whole.cut_area = face_area(first, f);
      whole.cut_centroid = face_centroid(first, f);
    }
  }

  static double extent_size(const Polyhedron& body) {
    double size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Extent extent = extent_along(body, Vec3::Unit(axis));
      size = std::max(size, extent.high - extent.low);
    }
    return size;
  }

  void split(int b) {
    const auto i = static_cast<size_t>(b);
    const bool is_convex_body = set.convex_part_begin[i + 1] - set.convex_part_begin[i] == 1;
    if (!is_convex_body || fragments[i].generation >= settings.max_generation ||
        set.volume[i] < 2 * settings.min_volume)
      return;
    const Polyhedron body = convex_part(set, set.convex_part_begin[i]);
    Random random(settings.seed, "fragments of body " + std::to_string(fragments[i].released) +
                                     ", " + std::to_string(path_to(b)));
    const double tolerance = on_plane * extent_size(body);
    for (int attempt = 0; attempt < most_tries; ++attempt) {
      const Cut cut = draw(body, set.centroid[i], random);
      const Polyhedron first = clip_convex(body, cut.plane, cut.tag, tolerance),
                       second = clip_convex(body, flipped(cut.plane), cut.tag, tolerance);
      if (n_faces(first) < 4 || n_faces(second) < 4) continue;
      if (std::min(moments(first).volume, moments(second).volume) < settings.min_volume) continue;
      add_pieces(b, cut, first, second);
      if (fragments[i].cut_area > 0) return;
      throw InputError({"", 0, "block " + std::to_string(b)}, "cannot be cut for fragments",
                       "raise [fragmentation] min_volume_m3");
    }
  }

  // Its place in the tree of its block: 1 for the whole, 2 k and 2 k + 1 for the pieces of k.
  [[nodiscard]] std::uint64_t path_to(int b) const {
    const Fragment& piece = fragments[static_cast<size_t>(b)];
    if (piece.parent < 0) return 1;
    const bool is_second = fragments[static_cast<size_t>(piece.parent)].first_piece != b;
    return 2 * path_to(piece.parent) + (is_second ? 1 : 0);
  }
};

}  // namespace

std::vector<Vec3> joint_normals(const BlockSet& set) {
  std::vector<Vec3> sums(set.joint_set_names.size(), Vec3::Zero());
  for (int b = 0; b < n_blocks(set); ++b) {
    const Polyhedron shell = block_shell(set, b);
    for (int f = 0; f < n_faces(shell); ++f) {
      if (shell.face_tag[f] < 0 || shell.face_tag[f] >= static_cast<int>(sums.size())) continue;
      Vec3& sum = sums[static_cast<size_t>(shell.face_tag[f])];
      const Vec3 area = face_area_vector(shell, f);
      sum += sum.dot(area) < 0 ? Vec3(-area) : area;
    }
  }
  for (Vec3& sum : sums)
    if (sum.norm() > 0) sum.normalize();
  return sums;
}

std::vector<Fragment> add_fragments(BlockSet& set, const SplitSettings& settings) {
  Splitter splitter{set, settings, joint_normals(set), {}, {}};
  for (size_t s = 0; s < splitter.normals.size(); ++s)
    if (!splitter.normals[s].isZero(0)) splitter.known.push_back(static_cast<int>(s));
  if (settings.splitting == Splitting::joints && splitter.known.empty())
    throw InputError({"", 0, "fragmentation.splitting"},
                     "is joints, and no face of a block is that of a joint set",
                     "take \"random\", or blocks that talus-blocks cut by [joints.*]");
  for (int b = 0; b < n_blocks(set); ++b) splitter.fragments.emplace_back().released = b;
  for (int b = 0; b < n_blocks(set); ++b) {
    splitter.split(b);
    if (splitter.fragments.size() > most_bodies)
      throw InputError({"", 0, "fragmentation"},
                       "makes more than " + std::to_string(most_bodies) + " pieces",
                       "raise min_volume_m3, or lower max_generation");
  }
  return std::move(splitter.fragments);
}

}  // namespace talus
