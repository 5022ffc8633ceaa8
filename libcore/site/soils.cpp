#include "site/soils.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.hpp"
#include "base/units.hpp"
#include "site/number_key.hpp"

namespace talus {
namespace {

constexpr const char* calibrated = "calibrated at one site";
constexpr const char* estimated = "estimate, not calibrated";

constexpr const char* from_tschamut =
    "18 runs at Tschamut (Volkwein and Gerber 2018, doi 10.16904/envidat.34), blocks of 40 to 79 "
    "kg as hulls of 20 points, by a prototype of this program";
constexpr const char* from_judgement =
    "cor and cor_half_speed_m_s for what a hull of 20 points returns in all, rolling_resistance by "
    "judgement between bare rock and meadow; no field test";

constexpr std::array<Soil, 8> table = {{
    {"rock", 35, 0.9, 100, 0.02, estimated, from_judgement},
    {"thin_soil", 35, 0.9, 24, 0.05, estimated, from_judgement},
    {"talus", 38, 0.9, 15, 0.08, estimated, from_judgement},
    {"scree", 35, 0.9, 11, 0.12, estimated, from_judgement},
    {"meadow", 35, 0.9, 10, 0.17, calibrated, from_tschamut},
    {"soft_soil", 35, 0.9, 6, 0.25, estimated, from_judgement},
    {"swamp", 30, 0, not_given, 0.5, estimated, from_judgement},
    {"asphalt", 35, 0.9, 13, 0.02, estimated, from_judgement},
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
    {"cor_half_speed_m_s", &GroundSettings::cor_half_speed_m_s, &Soil::cor_half_speed_m_s,
     &GroundSettings::cor_half_energy_kj},
    {"rolling_resistance", &GroundSettings::rolling_resistance, &Soil::rolling_resistance,
     &GroundSettings::bearing_kpa},
}};

std::string key_of(const GroundSettings& ground, const char* key) {
  return "ground." + ground.name + "." + key;
}

// What an earlier soil filled is not given.
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
struct GroundCheck {
  const Site& site;
  const GroundSettings& ground;

  [[nodiscard]] bool is_given(const char* key) const {
    return !std::isnan(number_key(site, key_of(ground, key))->value);
  }
  [[noreturn]] void refuse(const char* key, const std::string& finding,
                           const std::string& hint) const {
    throw InputError(where_of(site, key_of(ground, key)), "[ground." + ground.name + "] " + finding,
                     hint);
  }
  void exclude(const char* a, const char* b, const char* hint) const {
    if (is_given(a) && is_given(b))
      refuse(b, std::string("has ") + a + " and " + b + ", which exclude each other", hint);
  }
  void need(const char* a, const char* b) const {
    if (is_given(a) && !is_given(b))
      refuse(a, std::string("has ") + a + " without " + b, std::string("give ") + b + " too");
  }

  void check() const {
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

std::span<const Soil> soils() { return table; }

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
  for (const GroundSettings& ground : site.grounds) GroundCheck{site, ground}.check();
}

}  // namespace talus
