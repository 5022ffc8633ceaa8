// Kinds of ground by name, with values of the keys of [ground.*] and their sources.
#include "site/soils.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"
#include "site/number_key.hpp"

namespace talus {
namespace {

constexpr const char* tested = "field test";
constexpr const char* untested = "no field test";

constexpr const char* at_tschamut =
    "18 runs at Tschamut (Volkwein and Gerber 2018, doi 10.16904/envidat.34), 11 hits at Chant "
    "Sura (doi 10.16904/envidat.174), blocks of 40 to 780 kg as hulls of 20 points";
constexpr const char* at_authume =
    "41 boulders of 0.2 to 1.8 t at the Authume quarry (Bourrier et al. 2021), as hulls of 20 "
    "points";
constexpr const char* as_meadow = "values of meadow";
constexpr const char* by_judgement = "by judgement between the soils with field tests";

// The field tests agree with one ground of 2 kJ and 4 MPa. Hard ground has twice the energy, soft
// ground half of both.
constexpr std::array<Soil, 8> table = {{
    {"rock", 35, 0.9, 4, 4000, tested, at_authume, 1.8},
    {"thin_soil", 35, 0.9, 2, 4000, tested, at_authume, 1.8},
    {"talus", 35, 0.9, 2, 4000, untested, as_meadow, not_given},
    {"scree", 35, 0.9, 2, 4000, untested, as_meadow, not_given},
    {"meadow", 35, 0.9, 2, 4000, tested, at_tschamut, 0.78},
    {"soft_soil", 35, 0.9, 1, 2000, untested, by_judgement, not_given},
    {"swamp", 30, 0, not_given, 500, untested, by_judgement, not_given},
    {"asphalt", 35, 0.9, 4, 4000, untested, by_judgement, not_given},
}};

/// The keys that soils set.
struct SoilKey {
  const char* name;
  double GroundSettings::*field;
  double Soil::*value;
  double GroundSettings::*instead;  // excludes it
};
constexpr std::array<SoilKey, 4> keys = {{
    {"friction_deg", &GroundSettings::friction_deg, &Soil::friction_deg, nullptr},
    {"cor", &GroundSettings::cor, &Soil::cor, nullptr},
    {"cor_half_energy_kj", &GroundSettings::cor_half_energy_kj, &Soil::cor_half_energy_kj,
     &GroundSettings::cor_half_speed_m_s},
    {"bearing_kpa", &GroundSettings::bearing_kpa, &Soil::bearing_kpa,
     &GroundSettings::rolling_resistance},
}};

std::string key_of(const GroundSettings& ground, const char* key) {
  return "ground." + ground.name + "." + key;
}

// Removes the values that an earlier soil filled.
void take_back(Site& site, GroundSettings& ground) {
  const GroundSettings defaults;
  for (const SoilKey& key : keys) {
    const auto found = site.sources.find(key_of(ground, key.name));
    if (found == site.sources.end() || found->second.kind != ValueSource::from_soil) continue;
    ground.*key.field = defaults.*key.field;
    site.sources.erase(found);
  }
}

/// Checks of one section.
struct SectionCheck {
  const Site& site;
  std::string section;

  [[nodiscard]] double value(const char* key) const {
    return number_key(site, section + "." + key)->value;
  }
  [[nodiscard]] bool is_given(const char* key) const { return !std::isnan(value(key)); }
  [[noreturn]] void refuse(const char* key, const std::string& finding,
                           const std::string& hint) const {
    throw InputError(where_of(site, section + "." + key), "[" + section + "] " + finding, hint);
  }
  void exclude(const char* a, const char* b, const char* hint) const {
    if (is_given(a) && is_given(b))
      refuse(b, std::string("has ") + a + " and " + b + ", which exclude each other", hint);
  }
  void need(const char* a, const char* b) const {
    if (is_given(a) && !is_given(b))
      refuse(a, std::string("has ") + a + " without " + b, std::string("give ") + b + " too");
  }

  // Strength of Barton and Bandis, of joints and of ground.
  void check_roughness() const {
    need("jrc", "jcs_mpa");
    need("jcs_mpa", "jrc");
    need("jrc", "friction_deg");
    if (!is_given("jrc")) return;
    if (value("cohesion_pa") > 0 || value("tension_pa") > 0)
      refuse("jrc", "has jrc and cohesion or tension, which exclude each other",
             "a rough joint has its strength at low stress from its roughness");
    if (value("friction_deg") == 0)
      refuse("friction_deg", "has jrc, and friction_deg is 0",
             "friction_deg is the residual angle there, e.g. 28");
    if (site.solver.friction == "weakening")
      refuse("jrc", "has jrc, and weakening friction of [solver] follows the speed",
             "leave one out");
  }

  void check_ground(const GroundSettings& ground) const {
    check_roughness();
    exclude("jrc", "scar_friction", "friction follows the normal stress, or the slid distance");
    exclude("jrc", "friction_weak_deg", "friction follows the normal stress, or the speed");
    exclude("cor_half_speed_m_s", "cor_half_energy_kj",
            "one says how COR falls: by speed, or by energy");
    exclude("rolling_resistance", "bearing_kpa",
            "bearing_kpa gives the rolling resistance by the size of the block");
    exclude("scar_friction", "friction_weak_deg",
            "friction follows the slid distance, or the speed");
    need("scar_friction", "scar_rate_1_m");
    need("scar_friction", "scar_decay_1_s");
    need("scar_rate_1_m", "scar_friction");
    need("scar_decay_1_s", "scar_friction");
    need("friction_weak_deg", "weakening_speed_m_s");
    need("weakening_speed_m_s", "friction_weak_deg");
    const double friction = std::tan(ground.friction_deg * degree);
    if (ground.scar_friction < friction)
      refuse("scar_friction",
             "has scar_friction " + text(ground.scar_friction) +
                 ", below the tangent of friction_deg, " + text(friction, 4),
             "friction grows from tan(friction_deg) to scar_friction as a block slides");
    if (ground.friction_weak_deg > ground.friction_deg)
      refuse("friction_weak_deg",
             "has friction_weak_deg " + text(ground.friction_weak_deg) + ", above friction_deg, " +
                 text(ground.friction_deg),
             "friction falls from friction_deg at rest to friction_weak_deg at high speed");
  }
};

}  // namespace

bool Soil::is_tested() const { return mark == tested; }

std::span<const Soil> soils() { return table; }

const Weakening& weakening() {
  static constexpr Weakening fitted = {
      0.84, 0.11, 4, untested,
      "Lucas, Mangeney and Ampuero 2014 (Nature Communications 5, 3417), back-analysed landslides"};
  return fitted;
}

const Soil* soil_named(const std::string& name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Soil& soil) { return name == soil.name; });
  return found == table.end() ? nullptr : &*found;
}

void fill_from_soils(Site& site) {
  for (GroundSettings& ground : site.grounds) {
    take_back(site, ground);
    const Soil* soil = soil_named(ground.soil);
    if (soil == nullptr) continue;
    for (const SoilKey& key : keys) {
      const double value = soil->*key.value;
      if (std::isnan(value) || site.sources.contains(key_of(ground, key.name))) continue;
      if (key.instead != nullptr && !std::isnan(ground.*key.instead)) continue;
      ground.*key.field = value;
      site.sources[key_of(ground, key.name)] = {ValueSource::from_soil, 0};
    }
  }
}

void check_grounds(const Site& site) {
  for (const GroundSettings& ground : site.grounds)
    SectionCheck{site, "ground." + ground.name}.check_ground(ground);
  for (const JointSettings& joints : site.joints)
    SectionCheck{site, "joints." + joints.name}.check_roughness();
}

}  // namespace talus
