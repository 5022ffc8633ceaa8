// libcore/site/soils.hpp: public
// Kinds of ground by name, with values of the keys of [ground.*] and where these are from.
// in:    `soil` of a section
// out:   the keys of the section that are not given
#pragma once

#include <span>
#include <string>

#include "site/site.hpp"

namespace talus {

/// A kind of ground. NaN: the key is not set.
struct Soil {
  const char* name;
  double friction_deg, cor, cor_half_energy_kj, bearing_kpa;
  const char* mark;    ///< whether a field test supports the values
  const char* source;  ///< which one, or where they are from
  double heaviest_t;   ///< block of these tests [t]

  [[nodiscard]] bool is_tested() const;
};

[[nodiscard]] std::span<const Soil> soils();

/// The soil of that name; nullptr: there is none.
[[nodiscard]] const Soil* soil_named(const std::string& name);

/// Friction that falls with the speed of slip, of [solver] friction = "weakening": mu(v) = fast +
/// (at_rest - fast) / (1 + v / speed), on all ground and between all blocks. Sections that give
/// less friction at rest keep it.
struct Weakening {
  double at_rest, fast;  ///< tan(phi) [-]
  double speed_m_s;      ///< at which half of the drop is reached
  const char* mark;      ///< as of Soil
  const char* source;
};
[[nodiscard]] const Weakening& weakening();

/// Fills the keys of each ground that its soil sets and that are not given, and notes in
/// Site::sources that they are from there. A key that excludes one that is given is left out.
void fill_from_soils(Site& site);

/// Throws InputError for keys of a section [ground.*] that exclude each other, or that need one
/// that is not given.
void check_grounds(const Site& site);

}  // namespace talus
