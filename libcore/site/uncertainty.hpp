// libcore/site/uncertainty.hpp: public
// The quantities of [uncertainty.*]: keys that may be drawn, the values that a sample draws, and
// those that cut the rock anew.
// in:    the site file, the number of a sample
// out:   the same site with the values of that sample, each with its origin
//
// Rock keys (joints, source, bodies) change the blocks, motion keys how they move. With rock_masses
// = N the rock keys are drawn N times and runs take the masses in turn: run i has mass (i - 1) mod
// N + 1. Runs of one mass are not independent, so statistics then count masses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "site/site.hpp"

namespace talus {

/// Whether a key changes the blocks that are cut or placed.
[[nodiscard]] bool is_rock_key(const std::string& path);
[[nodiscard]] bool is_rock(const QuantitySettings& quantity);

/// Throws InputError for a quantity that cannot be drawn: an unknown key or one that does not hold
/// a number, a distribution without its parameters or with impossible ones, values outside of the
/// range of the key, rock keys without rock_masses, a key that is drawn twice.
void check_uncertainty(const Site& site);

/// A value that a sample gives to a key.
struct DrawnKey {
  std::string quantity, key;
  double value = 0;
};
/// Rock keys alone, as talus-blocks needs them, or all.
enum class DrawScope { rock, all };

/// Values that [uncertainty] sample draws, in the order of the file; nothing for sample 0. A key
/// that the command line gives is held. Throws InputError for a sample that a hypercube does not
/// have.
[[nodiscard]] std::vector<DrawnKey> drawn_keys(const Site& site, DrawScope scope);

/// Gives these values to the site. Seeds of rock and bodies differ from mass to mass. All samples
/// of one mass give the same site by DrawScope::rock: that of the first of them.
void apply_draws(Site& site, DrawScope scope);

/// The rock mass of the sample, from 1; 0: there is but one, or no sample.
[[nodiscard]] std::int64_t rock_mass(const UncertaintySettings& settings);

/// Keys that are drawn, in every sample: "joints.J1.dip_deg" and "joints.J1.dip_direction_deg"
/// for an orientation.
[[nodiscard]] std::vector<std::string> keys_drawn(const QuantitySettings& quantity);

/// The keys that are drawn with the values that they have now.
[[nodiscard]] std::vector<DrawnKey> values_in_effect(const Site& site);

/// "ground.slope.friction_deg: drawn from normal, mean 28, standard deviation 2, 20 to 36
/// (back-analysis of 3 events)".
[[nodiscard]] std::string text_of(const Site& site, const QuantitySettings& quantity);

}  // namespace talus
