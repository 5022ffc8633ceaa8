// libcore/solver/mass_rows.hpp
// Bodies and contacts of a mass as its solver reads them, in single precision: one by one, and side
// by side in lanes of eight.
#pragma once

namespace talus {

inline constexpr int mass_lanes = 8;

/// Change of a body's velocity and spin, local axes [m/s, rad/s].
struct alignas(32) MassBody {
  float velocity[3]{}, spin[3]{}, unused[2]{};
};

/// How hard a body is to move: inverse of the inertia, local axes [1/(kg m2)], and of the mass.
struct alignas(32) MassInertia {
  float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  float inverse_mass = 0;  ///< [1/kg]
  float radius = 0;        ///< of the ball around the body [m]
};

/// A contact. Vectors are local; velocities are those of A's point relative to B's. The solver
/// reads eight floats at a time.
struct alignas(32) MassRow {
  float normal[3]{};    ///< unit, from B to A
  float arm_a[3]{};     ///< from the centroid of A [m]
  float friction = 0;   ///< tan(phi) [-]
  float limit = 0;      ///< of the normal impulse [N s]
  float arm_b[3]{};     ///< from the centroid of B [m]
  float velocity[3]{};  ///< v: at the end without contact, and the bias along the normal [m/s]
  float unused[2]{};
  float slip_start[3]{};  ///< unit direction of sliding at the start, or zero
  float impulse[3]{};     ///< in: of the last step, over this one; out: on A [N s]
  float damping = 0;      ///< out: D_n [kg]
  float unused_too = 0;
};
static_assert(sizeof(MassRow) == 96);

/// Up to eight pairs without a body in common, lane by lane.
struct MassBatch {
  int a[mass_lanes], b[mass_lanes];  ///< bodies; of a lane without one, one that is not
  int row_begin[mass_lanes];
  int n_rows[mass_lanes];    ///< 0: the lane is empty
  int first = 0, count = 0;  ///< points, and the most rows of a lane
};

/// Batches of one colour: no two of them share a body, unless they are `in_turn`.
struct MassColour {
  int begin = 0, end = 0;
  bool in_turn = false;
};

/// Rows side by side, as the sweeps read them.
struct alignas(32) MassPoint {
  float normal[3][mass_lanes], arm_a[3][mass_lanes], arm_b[3][mass_lanes];
  float velocity[3][mass_lanes], slip_start[3][mass_lanes], impulse[3][mass_lanes];
  float friction[mass_lanes], limit[mass_lanes];
  float normal_give[mass_lanes], normal_step[mass_lanes];  ///< 1 / D_n; 1 / (W_n + 1 / D_n)
  float shear_give[mass_lanes], shear_step[mass_lanes];    ///< the same across the normal
};

}  // namespace talus
