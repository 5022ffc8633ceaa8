// libcore/solver/law_numbers.hpp: public
// The numbers of law talus: all that rule the step of an island and that of a lone block. A
// question of stability begins here. Tolerances of one function's geometry or rounding stay with
// it.
//
// Each row: value, [unit], meaning. "Tried": the values that were compared, and the result;
// where a row says nothing of that, no other value is on record. h is a substep, dt the nominal
// step, g gravity, m the mass that a contact feels. Shares of the thickness or radius are those of
// the block, of two blocks those of the smaller.
#pragma once

#include <cstddef>

namespace talus::law {

// --- scales that many rules share --------------------------------------------------------------

/// [thickness] Shallow: a hit that ends deeper is remembered (Tried: none; edges that slide while
/// they turn are hit anew in every step, each time with all overlap as an offset), one of the next
/// substep goes no deeper, bodies with more overlap are measured, a displacement counts as no less
/// when errors are compared with it. [radius] A jump of a gap over one plane is by turning up to
/// this, and left unpressed; a contact that comes fast takes over no memory when it is deeper by
/// more.
inline constexpr double shallow = 1e-2;
/// [thickness] A block is sunk in at this overlap; behind a ridge, it has gone through. Larger
/// overlap is pressed out whatever the force, in full from twice this on, and its contact is
/// stiffer than the heaviest neighbour asks for. An overlap left by a hit is hit anew when a
/// substep deepens it by this; a hit cuts a substep that ends deeper by this.
inline constexpr double sunk = 2e-2;
/// [g h, or the resting speed] Speed that is not a hit where the solver's error or a block's own
/// motion may bring it about, and that a sweep of a mass may still change. Tried for masses: 0.05;
/// a wall that a mass reaches at one end sags by 2 mm in a second at the other, and a block on 400
/// that are 10,000 times lighter comes 2.5 % short of its closed form.
inline constexpr double least_speed = 2e-2;
/// [-] Longest or shortest next substep, step of pseudo-time, or stiffness of a contact that slips
/// or opens: this many times the last. Tried for pseudo-time: 10; half as many steps again.
inline constexpr double largest_change = 4;
/// [blocks] Most blocks of a small island; most blocks faster than g dt of a calm mass.
inline constexpr std::size_t few_blocks = 8;
/// [-] Rounds of a substep until no contact is added that hits left to be stopped; solutions of the
/// first step until contacts are as stiff as their loads need; cuts in a step where a block would
/// end deep in something.
inline constexpr int most_rounds_in_substep = 8;
/// [-] Rounds of hits at one time, and two for each block that they hit; hits in a step of a lone
/// block, or of an island whose hits end substeps; flights of a lone block in a step; half of the
/// looks at a pair in a substep.
inline constexpr int most_hits = 40;
/// [-] Repetitions of a substep: of a lone block, to find an event or to converge; where a yielding
/// body is used up.
inline constexpr int most_repetitions = 24;

// --- stiffness ---------------------------------------------------------------------------------

/// [-] k_n dt^2 / m of the stiffest contact of a lone block. Tried: the block's full mass for m;
/// needles fail.
inline constexpr double stiffest_lone = 400;
/// [-] The same in an island whose matrix is cheap to factor, and of a mass at rest since the
/// start, before a contact knows its load; 1 in all other islands. D of a contact that only stops,
/// over the mass that it feels. Tried: 1 for these; twin towers near the angle at which they topple
/// sway and fall. 30 for all blocks at rest; a mass that comes to rest is thrown up again and
/// again. 400 for all; the forces of masses in motion are not found.
inline constexpr double stiffest_at_rest = 30;
/// [blocks] An island whose contact graph is a tree is small, too, up to this many blocks: a column
/// ...
inline constexpr std::size_t small_tree = 64;
/// [g times the sum of thicknesses] ... whose squared speeds are below this: it is at rest or
/// topples.
inline constexpr double column_falls = 0.1;
/// [thickness] Overlap of a contact at rest under its load: it is as stiff as that asks. A tower
/// leans by the sum of these. Tried: multipliers carried from step to step; they shake towers down.
inline constexpr double most_sag = 1e-6;
/// [thickness] ... and of blocks in motion, else.
inline constexpr double most_sag_in_motion = 1e-5;
/// [g dt^2] Overlap of a contact that slips, opens or is hard to find the force of: it carries
/// little, or is as stiff as that asks. [of that] It is stiffer than the heaviest neighbour asks
/// for where it is sunk in, or at this overlap where that is more. Tried: none; small blocks under
/// a large one that slides sink in.
inline constexpr double soft_sag = 2;
/// [-] k_n dt^2 / m of the stiffest contact by its load.
inline constexpr double stiffest_by_load = 4e5;
/// [-] It is softer by this factor where forces are not found, and stays so for `longest_cooldown`.
/// Tried: 64; it changes little and is in vain ...
inline constexpr double easing = 4096;
/// [-] ... then all of the island is soft, at once where a block moves; then substeps are halved.
inline constexpr int most_eased = 2;
/// [-] A contact at rest becomes stiffer by this factor a step, beyond the stiffness for the
/// masses; one that carries little, slips or opens has that times the stiffness for its own mass.
inline constexpr double stiffens = 2;
/// [g dt] Speed of slip or of opening from which a contact does not rest, nor a block.
inline constexpr double slow = 0.2;
/// [passes] An island whose first solution in a substep takes more is hard: contacts of moving
/// blocks ...
inline constexpr int hard_passes = 10;
/// [-] ... become softer by this factor ...
inline constexpr double relief = 8;
/// [steps] ... and no stiffer for this long. Tried: 5; a mass that topples takes half as many
/// passes again.
inline constexpr int longest_cooldown = 40;
/// [-] Stiffness of a contact whose load asks for more: `stiffens` times the need; times that in
/// the first step, in which all sag at once. Tried: 2; towers sway ...
inline constexpr double ample_at_start = 8;
/// [-] ... and kept until it is this many times the need. Tried: 8; layers of small blocks
/// that slide under a large one grow soft and are squeezed out. 100; a tower of 16 creeps at 20 ms.
/// 300; a tower under a block a thousand times as heavy falls.
inline constexpr double too_much = 30;
/// [-] A contact whose stiffness changes by more than this factor in a step has another law.
inline constexpr double same_law = 1.5;
/// [dt] Overlap is pressed out over this many steps (tau). Tried: Newmark's own damping; contacts
/// ring (lambda near -1). At 2.9 h |lambda| is 0.41 without a change of sign.
inline constexpr double recovery_steps = 3;

// --- touching, and overlap that presses nothing ------------------------------------------------

/// [g h] Speed at which overlap that presses nothing relaxes: slower than gravity, nothing hops ...
inline constexpr double relaxes_by_gravity = 0.25;
/// [m/s] ... and at most this, as deep overlap does in a mass. Tried for masses: all overlap;
/// blocks that come from the exact step are lifted with all blocks on them, again and again.
inline constexpr double fastest_relaxing = 0.3;
/// [weights] Overlap is pressed out in full up to this force, not at all from twice as much on.
/// Tried: without bound; blocks that are jammed are thrown out.
inline constexpr double heavy = 3;
/// [thickness] A jump by turning is left unpressed up to this. Tried: all of it; a needle that
/// spins on its tip sinks in step after step.
inline constexpr double most_of_thickness = 5e-2;

// --- how long a substep may be -----------------------------------------------------------------

/// [rad] A block of an island turns by no more in a substep.
inline constexpr double most_turn = 0.5;
/// [substeps in dt] For this reason, or since a point goes by no more than deep_share relative to a
/// neighbour, no more than this. In a mass it may go by twice that: a hit that returns nothing
/// leaves half of it as overlap. Tried for masses: five times; rocks that are poured end a fifth of
/// their thickness in each other.
inline constexpr double most_substeps = 64;
/// [h] Pairs are searched this far ahead. Tried: at predicted poses; an approach becomes an overlap
/// with the wrong face.
inline constexpr double substeps_ahead = 2;
/// [rad] A lone block that slides on one plane turns by no more in a substep.
inline constexpr double slides_by_turn = 0.05;

// --- hits --------------------------------------------------------------------------------------

/// [g dt] Approaches above the larger of these rebound: at least g dt, which resting contacts
/// reach, at most this much ...
inline constexpr double rebounds_by_gravity = 2;
/// [m/s] ... and in between those faster than this. Tried: 2 g dt at any step; a slide at large
/// steps is too short, since the rebounds that are left out cost rocks their energy.
inline constexpr double rebound_matters = 0.1;
/// [-] Looks at true gaps to find the time of a hit.
inline constexpr int most_looks_for_time = 5;
/// [m g v_r] Power above which a support drives a block: it ends before.
inline constexpr double support_drives = 0.1;
/// [in a substep] Hits of a pair; beyond, it is stopped.
inline constexpr int most_pair_hits = 20;
/// [rad] Longest turn of a flight: bounds the cost of its attitude.
inline constexpr double longest_turn = 60;

// --- check of a substep, and repetitions -------------------------------------------------------

/// [-] Halvings of an island's substep that does not converge; repetitions of a lone block's once
/// no forces were found in the step, so that it ends.
inline constexpr int most_halvings = 4;
/// [h] This long after the hit the substep ends, and a look that found no hit looks on; so shortly
/// after it the supports of a block are unknown, and the rest of the substep is no shorter. Tried
/// for looks: none; the next corner of a pair that parts is missed, and stopped without rebound.
inline constexpr double after_hit = 1.0 / 32;
/// [thickness] A block is deep above this overlap: health counts it, and a hit that ends so cuts
/// the substep.
inline constexpr double deep_share = 0.1;

// --- yielding bodies ---------------------------------------------------------------------------

/// [-] A body with an axis yields to contacts whose normal has at least this cosine with it.
inline constexpr double least_yield_cosine = 0.5;

// --- solution of an island ---------------------------------------------------------------------

/// [g h] Residual at which an island's forces count as found ...
inline constexpr double island_tolerance = 1e-2;
/// [fastest speed] ... but not above this, which is also the least of conjugate gradients, and not
/// below a negligible part of g h.
/// Tried for these: 1e-2; two to four times the steps.
inline constexpr double relative_tolerance = 1e-3;
/// [-] Newton steps before the line search looks at them, of all solvers. Tried for a lone block:
/// bounds of friction held and renewed; they rarely settle.
inline constexpr int free_steps = 3;
/// [-] Halvings of a Newton step, of a lone block too.
inline constexpr int most_step_halvings = 8;
/// [slip stiffness] Change before a pair's tangent is summed again.
inline constexpr double slack = 0.5;
/// [-] In this many steps the smallest residual has to fall by half; else motion is relaxed. A mass
/// that this many steps in a row leave unsettled is exact for mass::calm_time; one that this many
/// substeps follow accurately takes long steps.
inline constexpr int patience = 6;
/// [residual] The next step of pseudo-time is as long as leaves this share of its own equation.
inline constexpr double usually_left = 0.1;

// --- solution of a lone block ------------------------------------------------------------------

/// [promised gain] Least gain of a Newton step.
inline constexpr double least_gain = 0.1;

// --- breakage ----------------------------------------------------------------------------------

/// [s] Loads that crush a block are means over this time, so that hits count and steps do not. It
/// lies between the duration of a hit of rock on rock (about 1 ms) and that of a jam (seconds).
inline constexpr double load_time = 0.1;

// --- rest --------------------------------------------------------------------------------------

/// [steps] A block, or all of an island, stays in place for this long before it is left out. Tried:
/// a limit on speed; one trembling block keeps an island awake.
inline constexpr int steps_before_sleep = 200;
/// [thickness] In place: no point went farther than this, or g dt^2 where that is less. A block has
/// left its place where its centroid is farther from where it was at the start.
inline constexpr double rests_within = 1e-3;

}  // namespace talus::law
