// libcore/solver/mass_numbers.hpp: public
// The numbers of the mass step, as solver/law_numbers.hpp has those of the exact step. h is a step,
// dt the nominal step, g gravity, m the mass that a contact feels, tau the time over which overlap
// is pressed out (law::recovery_steps).
#pragma once

namespace talus::mass {

// --- exact or mass? ----------------------------------------------------------------------------

/// [blocks] An island becomes a mass when more than this many of its blocks move. Tried: 8; it
/// saves nothing on 390 blocks, and columns of ten keep more energy of a hit than their hits in
/// turn.
inline constexpr int most_moving = 32;
/// [blocks] A mass is exact again below this size ...
inline constexpr int least_size = 24;
/// [s] ... or where it is calm for this time.
inline constexpr double calm_time = 0.2;

// --- rows --------------------------------------------------------------------------------------

/// [-] Compliance of a contact, relative to the mobility of its point: D_n = 1 / (compliance W_n).
inline constexpr double compliance = 1e-3;
/// [m/s] Contacts farther apart than this closes in h, and than g h^2, are left out.
inline constexpr double reach_speed = 0.5;
// --- solution ----------------------------------------------------------------------------------

/// [-] Sweeps at the default accuracy, and at most eight times as many. In the first step of a run,
/// when no contact knows its load: twice as many, times the square of the layers of blocks, through
/// which support rises as heat does. Tried: 8 times that square; columns of twenty at rest fall at
/// 0.3 g.
inline constexpr int sweeps = 12;
/// [-] A first step that needs more is exact: six layers. 3,900 blocks in seven take twice as long
/// by sweeps.
inline constexpr int most_first_sweeps = 1000;
/// [-] D_t / W: part of the mean tangential mobility by turning that a sweep counts with.
inline constexpr float turning_share = 0.75F;

}  // namespace talus::mass
