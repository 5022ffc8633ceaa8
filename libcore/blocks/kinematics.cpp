// Kinematic analysis: shares of a slope's face that are free to slide or topple.
#include "blocks/kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/percentile.hpp"
#include "base/units.hpp"
#include "blocks/area_clip.hpp"
#include "blocks/removability.hpp"
#include "geometry/plan2d.hpp"

namespace talus {
namespace {

constexpr double pi = std::numbers::pi;

double slope_of(const Vec3& face) { return std::acos(std::clamp(face.z(), -1.0, 1.0)); }

Attitude draw_of(const KinematicSet& set, size_t draw) {
  return set.draws.empty() ? set.mean : set.draws[draw % set.draws.size()];
}

FaceShare share_over_draws(const std::vector<double>& shares) {
  FaceShare out;
  std::vector<WeightedValue> sorted;
  for (const double share : shares) {
    out.mean += share / static_cast<double>(shares.size());
    sorted.push_back({share, 1});
  }
  sort_values(sorted);
  out.p10 = weighted_percentile(sorted, 0.1);
  out.p90 = weighted_percentile(sorted, 0.9);
  return out;
}

// Share of the face where `is_free` holds.
template <class Free>
double share_where(const std::vector<FacePiece>& face, Free is_free) {
  double all = 0, free = 0;
  for (const FacePiece& piece : face) {
    all += piece.area;
    if (is_free(piece.normal)) free += piece.area;
  }
  return all > 0 ? free / all : 0;
}

bool is_lateral(const Attitude& plane, const Vec3& face) {
  return angle_between(plane.dip_direction, aspect_of(face)) <= lateral_limit_deg * degree;
}

// A set on whose planes columns can rest and move out: it dips out of the slope, less steeply.
bool is_base(const Attitude& plane, const Vec3& face) {
  return is_lateral(plane, face) && plane.dip < slope_of(face);
}

}  // namespace

std::vector<FacePiece> face_in(const Trn& ground, const Area& area) {
  std::vector<FacePiece> face;
  for (const TriangleInArea& one : triangles_in(ground, area)) {
    if (!is_known(ground, one.triangle)) continue;
    FacePiece piece;
    piece.normal = triangle_plane(ground, one.triangle).normal;
    for (const auto& ring : one.pieces) piece.area += std::abs(ring_area(ring)) / piece.normal.z();
    face.push_back(piece);
  }
  return face;
}

double aspect_of(const Vec3& normal) { return std::atan2(normal.x(), normal.y()); }

double angle_between(double azimuth, double other) {
  const double turn = std::fmod(std::abs(azimuth - other), 2 * pi);
  return std::min(turn, 2 * pi - turn);
}

Vec3 dip_vector(double dip, double dip_direction) {
  return {std::cos(dip) * std::sin(dip_direction), std::cos(dip) * std::cos(dip_direction),
          -std::sin(dip)};
}

bool slides_on_plane(const Attitude& plane, const Vec3& face, double friction) {
  return plane.dip > friction && dip_vector(plane.dip, plane.dip_direction).dot(face) > 0;
}

bool topples(const Attitude& plane, const Vec3& face, double friction) {
  const double slope = slope_of(face), aspect = aspect_of(face);
  if (slope <= friction) return false;
  if (angle_between(aspect, plane.dip_direction + pi) > toppling_limit_deg * degree) return false;
  return -pole(plane.dip, plane.dip_direction).dot(pole(slope - friction, aspect)) >= 0;
}

Wedge wedge_of(const Attitude& first, const Attitude& second, double first_friction,
               double second_friction) {
  Wedge wedge;
  const std::array<RestPlane, 2> planes = {
      {{pole(first.dip, first.dip_direction), first_friction, 0},
       {pole(second.dip, second.dip_direction), second_friction, 0}}};
  Vec3 line = planes[0].normal.cross(planes[1].normal);
  if (line.norm() < 1e-9) return wedge;
  line.normalize();
  wedge.line = line.z() > 0 ? Vec3(-line) : line;
  wedge.plunge = std::asin(std::clamp(-wedge.line.z(), -1.0, 1.0));
  wedge.trend = std::atan2(wedge.line.x(), wedge.line.y());
  const BlockMode mode = block_mode(-Vec3::UnitZ(), planes);
  wedge.on_both = mode.bearing.size() == 2;
  wedge.factor = mode.factor();
  return wedge;
}

bool slides(const Wedge& wedge, const Vec3& face) {
  return wedge.on_both && wedge.plunge > 0 && wedge.factor < 1 && wedge.line.dot(face) > 0;
}

bool columns_topple(const Wedge& wedge, const Vec3& face, double friction) {
  if (wedge.line.isZero()) return false;
  if (wedge.plunge > pi / 2 - friction) return true;  // upright: to any side
  const bool dips_in =
      angle_between(wedge.trend, aspect_of(face) + pi) <= lateral_limit_deg * degree;
  return dips_in && wedge.plunge >= pi / 2 - slope_of(face);
}

std::vector<Attitude> drawn_attitudes(const JointSet& set) {
  if (!(set.fisher_k > 0)) return {};
  std::vector<Attitude> draws;
  Random random(1, "kinematics of " + set.name);
  const Vec3 mean = pole(set.dip, set.dip_direction);
  for (int k = 0; k < n_kinematic_draws; ++k)
    draws.push_back(attitude(draw_fisher(mean, set.fisher_k, random)));
  return draws;
}

Kinematics kinematics_of(const std::vector<FacePiece>& face,
                         const std::vector<KinematicSet>& sets) {
  size_t n_draws = 1;
  for (const KinematicSet& set : sets) n_draws = std::max(n_draws, set.draws.size());
  Kinematics result;
  const auto over = [&](size_t n, auto is_free_in) {
    std::vector<double> shares;
    for (size_t k = 0; k < n; ++k) shares.push_back(share_where(face, is_free_in(k)));
    return share_over_draws(shares);
  };
  for (const KinematicSet& set : sets) {
    const double friction = std::atan(set.friction);
    const size_t n = std::max<size_t>(1, set.draws.size());
    const auto sliding = [&](size_t k) {
      return [plane = draw_of(set, k), friction](const Vec3& m) {
        return slides_on_plane(plane, m, friction);
      };
    };
    const auto lateral = [&](size_t k) {
      return [plane = draw_of(set, k), friction](const Vec3& m) {
        return is_lateral(plane, m) && slides_on_plane(plane, m, friction);
      };
    };
    const auto toppling = [&](size_t k) {
      return [plane = draw_of(set, k), friction](const Vec3& m) {
        return topples(plane, m, friction);
      };
    };
    result.sets.push_back({set.name, over(n, sliding), over(n, lateral), over(n, toppling)});
  }
  for (size_t i = 0; i < sets.size(); ++i)
    for (size_t j = i + 1; j < sets.size(); ++j) {
      const auto wedge_in = [&](size_t k) {
        return wedge_of(draw_of(sets[i], k), draw_of(sets[j], k), sets[i].friction,
                        sets[j].friction);
      };
      const auto sliding = [&](size_t k) {
        return [wedge = wedge_in(k)](const Vec3& m) { return slides(wedge, m); };
      };
      const double friction = std::atan(std::min(sets[i].friction, sets[j].friction));
      const auto toppling = [&](size_t k) {
        return [&, wedge = wedge_in(k), friction, k](const Vec3& m) {
          const bool has_base = std::any_of(sets.begin(), sets.end(), [&](const KinematicSet& s) {
            return is_base(draw_of(s, k), m);
          });
          return has_base && columns_topple(wedge, m, friction);
        };
      };
      result.pairs.push_back(
          {static_cast<int>(i), static_cast<int>(j),
           wedge_of(sets[i].mean, sets[j].mean, sets[i].friction, sets[j].friction),
           over(n_draws, sliding), over(n_draws, toppling)});
    }
  return result;
}

}  // namespace talus
