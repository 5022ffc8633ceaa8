// libcore/site/base_motion.hpp: public
// How the ground shakes: a record of accelerations, from a CSV or a harmonic one.
// theory 1.5: the terrain's frame, body force rho (g - a_base)
#pragma once

#include <string>

#include "site/acceleration_record.hpp"
#include "site/site.hpp"

namespace talus {

/// Reads columns time_s, ax_m_s2, ay_m_s2, az_m_s2, named in the first line in any order and
/// separated by commas; lines that start with # are left out. Throws InputError with the line for
/// a missing column, a number that is none, and times that do not increase.
[[nodiscard]] AccelerationRecord read_acceleration_csv(const std::string& path);

/// The record that [base_motion] asks for, times `scale`; empty when it asks for none. A harmonic
/// motion a sin(2 pi f (t - start)) lasts from its start to its end and nothing longer. Throws
/// InputError when the samples of a file end before `duration` [s] or start after 0, for both a
/// file and an amplitude, and for a frequency without amplitude or the reverse.
[[nodiscard]] AccelerationRecord base_motion(const Site& site, double duration);

}  // namespace talus
