// verify/cases/block_cases.hpp
// Cases of several blocks with a closed form; as closed_form.hpp. Where blocks should stay, a
// displacement of more than 0.1 m before they are watched counts too.
#pragma once

#include "verify/cases/closed_form.hpp"

namespace talus::cases {

/// n unit cubes one on the other on a slope whose direction of dip is turned by 30 degrees.
[[nodiscard]] Scene tower(int n, double dip_deg, double friction_deg, const Settings& settings);

/// Three cubes, friction 40 degrees between them and 10 on the ground, on 15 degrees for 1 s: they
/// slide as one. Largest relative error of their displacements down the dip.
CaseResult tower_slide(const CaseSettings& settings);

/// The same three on a ground of 15.5 degrees stay: largest movement of one in the 4 s after the
/// first [m].
CaseResult tower_holds(const CaseSettings& settings);

/// Four cubes, friction 40 degrees: dip at which they topple, tan(dip) = 1 / 4, 14.036 degrees, by
/// bisection: error [deg]. Their support yields under their edge, so it is a little less.
CaseResult pile_topples(const CaseSettings& settings);

/// Cube on a plate that sticks to a slope of 30 degrees, friction 20 between the two, 1.5 s:
/// relative error of its displacement (26), or that of the plate over it, the larger.
CaseResult block_on_block(const CaseSettings& settings);

/// Keel of 90 degrees in the groove of two long blocks on 35 degrees, friction 20, 1.5 s: relative
/// error of its path. Each face carries W cos(dip) / sqrt(2), so a = g (sin(dip) - sqrt(2) tan(phi)
/// cos(dip)).
CaseResult groove(const CaseSettings& settings);

/// Equal cubes meeting face to face at 8 m/s, no friction. `value`: the speed they part with [m/s];
/// error of that speed over 8 m/s, or of the place of one over its path, the larger.
CaseResult head_on(const CaseSettings& settings, double restitution);

/// A stack of n cubes that has had `settling_s` to press itself together: largest movement of a
/// cube in the 4 s after [m].
CaseResult stack_stands(const CaseSettings& settings, int n, double settling_s);

/// Arch of seven stones, radii 4 and 5.5 m, that has had 5 s to settle: largest movement of a stone
/// in the 5 s after [m].
CaseResult arch_stands(const CaseSettings& settings);

/// A cube of 10 m on four cubes of 0.1 m, 1e6 times lighter, for 2 s: largest movement [m].
CaseResult large_on_small(const CaseSettings& settings);

/// Plate of 10 x 10 x 0.1 m on a cube of 2 m that has had 1 s to settle: largest movement in the 4
/// s after [m].
CaseResult thin_plate(const CaseSettings& settings);

/// Eight tumbling boxes thrown at each other far above the ground, 1.5 s: change of momentum and of
/// angular momentum about the local zero beyond gravity's, the larger, over the momentum that the
/// boxes bring [-, 1 m for the angular one]. `value`: energy gained over the kinetic one brought,
/// below 0 for the losses of collisions.
CaseResult collision(const CaseSettings& settings, double restitution);

/// Sixteen columns that dip into the slope, on a stepped base, as in Goodman and Bray (1976): the
/// friction angle from which the toe is stable without help, by bisection: error [deg].
/// Expected: their limit equilibrium, 38.146 degrees.
CaseResult columns_topple(const CaseSettings& settings);

/// Row of 14 upright plates of which the first is pushed: relative error of the time that the wave
/// takes from the fourth to the twelfth. Against angles alone, rigid, contacts by projected
/// Gauss-Seidel at steps of 2e-5 s.
CaseResult dominoes(const CaseSettings& settings);

// --- piles, hits, edges and bodies of several parts (contact_cases.cpp) ------------------------

/// Tower of eight cubes at 1.05 of the dip at which it topples: relative error of the time in which
/// one has turned by 0.2 rad, against one rigid column.
CaseResult tower_topples(const CaseSettings& settings);

struct Pile;
/// A pile that should be stable: largest displacement of a cube within `duration_s`, over its side.
CaseResult pile_moves(const CaseSettings& settings, const Pile& pile, double duration_s);

/// Twelve pairs of tumbling cubes that meet in space, no friction: largest error of the restitution
/// of their hits [-].
CaseResult tumbling_pairs(const CaseSettings& settings, double restitution);

/// Cube that falls from 2 m on a slab of eight times its mass that lies on the ground, COR 0.7:
/// relative error of its speed after, against hits in turn in one dimension.
CaseResult borne_slab(const CaseSettings& settings);

/// Five unequal blocks in a row, 2 cm apart, the first at 10 m/s, 1 s: largest error of a speed as
/// a part of that, against event by event.
CaseResult unequal_row(const CaseSettings& settings, double restitution = 0.9);

/// Six cubes in a row that do not rebound, the first at 10 m/s: largest relative error of a speed
/// at the end, or of a distance of neighbours over the side.
CaseResult plastic_row(const CaseSettings& settings);

/// Eight elastic cubes in a bowl, no friction, 4 s: change of their energy as a part of it.
CaseResult elastic_bowl(const CaseSettings& settings);

/// Height of the ridge below [m].
inline constexpr double ridge_height = 10;
/// A wall along y whose top is a ridge at `x`; its sides are inclined by `half_angle_deg` to the
/// vertical.
[[nodiscard]] Body ridge_wall(double half_angle_deg, double x);
/// A plate on the top of the ridge, cut in two by an upright plane whose normal lies at
/// `azimuth_deg` to x, `off` the middle.
[[nodiscard]] Body split_plate(double azimuth_deg, double off);
/// That plate, cut 0.1 m off its middle at 30 degrees to the ridge, at rest on it for 1 s: how far
/// it sinks, over its size.
CaseResult parts_on_ridge(const CaseSettings& settings, double half_angle_deg);

/// Slab of two parts that falls flat from 1.25 m at 1 m/s sideways, friction 30 degrees, COR 0.5:
/// speed that the hit turns it at, over that of the hit.
CaseResult parts_land_flat(const CaseSettings& settings);

}  // namespace talus::cases
