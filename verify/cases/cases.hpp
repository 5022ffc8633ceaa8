// verify/cases/cases.hpp
// Building blocks of scenes with a closed form: planes at any dip and azimuth, V-shaped valleys,
// profiles, prisms and boxes placed on them. Used by the tests and by talus-verify.
#pragma once

#include <functional>
#include <vector>

#include "blocks/block_set.hpp"
#include "scene/make_scene.hpp"
#include "scene/scene.hpp"

namespace talus::cases {

/// A plane through the local zero and its axes: `dip` down the slope, `strike` = normal x dip.
struct SlopeFrame {
  Vec3 dip, strike, normal;
};
/// `azimuth_deg` turns the direction of dip counter-clockwise from +x.
[[nodiscard]] SlopeFrame slope_frame(double dip_deg, double azimuth_deg);

/// Square TRN around `centre`, half its side `reach`, elevations from `height(x, y)` [m].
[[nodiscard]] Trn make_trn(const std::function<double(double, double)>& height, double cell_size,
                           double reach, const Vec2& centre = Vec2::Zero());

/// TRN of the plane of `frame` shifted to pass through `through`.
[[nodiscard]] Trn plane_trn(const SlopeFrame& frame, double cell_size, double reach,
                            const Vec3& through = Vec3::Zero());

/// Body with corners at base + x a + y b + z c of the box corners low..high: a box in a slope's
/// axes when (a, b, c) = (dip, strike, normal).
[[nodiscard]] Polyhedron box_in(const SlopeFrame& frame, const Vec3& base, const Vec3& low,
                                const Vec3& high);

/// Regular prism of n sides and circumradius `radius`, axis along `strike`, lying on a side whose
/// middle is at `base` + (along dip) 0; half its length is `half_length`.
[[nodiscard]] Polyhedron prism_on(const SlopeFrame& frame, const Vec3& base, int n, double radius,
                                  double half_length);

/// Polyhedron from vertices and faces (counter-clockwise from outside).
[[nodiscard]] Polyhedron polyhedron(std::vector<Vec3> vertices,
                                    const std::vector<std::vector<int>>& faces);

/// Turned about `pivot`, then moved.
[[nodiscard]] Polyhedron moved(Polyhedron body, const Mat3& turn, const Vec3& pivot,
                               const Vec3& shift = Vec3::Zero());

/// Bare ground: no cohesion, no damping.
[[nodiscard]] GroundClass ground_of(double friction_deg, double restitution = 0);

/// A convex body in motion.
[[nodiscard]] Body body_of(Polyhedron shape, const Vec3& velocity = Vec3::Zero(),
                           const Vec3& spin = Vec3::Zero());

/// Half a circle of n equal stones between two radii, its ends on the plane z = 0, `depth` long in
/// y.
[[nodiscard]] std::vector<Body> arch_of(int n, double inner, double outer, double depth);

/// Scene of bodies on one ground; g = 10 m/s2 downwards as in the paper.
[[nodiscard]] Scene scene_of(Trn trn, const GroundClass& ground, const std::vector<Body>& bodies,
                             const Settings& settings, const Material& material = {});

}  // namespace talus::cases
