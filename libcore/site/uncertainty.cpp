// Checks and draws the quantities of [uncertainty.*].
#include "site/uncertainty.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/numbers.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "base/words.hpp"
#include "blocks/joint_sets.hpp"
#include "sampling/design.hpp"
#include "sampling/distribution.hpp"
#include "site/number_key.hpp"

namespace talus {
namespace {

constexpr double most_cut = 0.01;    // of a distribution, by the range of a key
constexpr double least_kept = 1e-6;  // of one that is truncated

// --- keys --------------------------------------------------------------------------------------

std::string group_of(const std::string& path) { return path.substr(0, path.find('.')); }
std::string section_of(const std::string& path) { return path.substr(0, path.rfind('.')); }
std::string last_word(const std::string& path) { return path.substr(path.rfind('.') + 1); }

bool is_fisher(const QuantitySettings& q) { return q.distribution == "fisher"; }
bool is_rows(const QuantitySettings& q) { return q.distribution == "rows"; }

bool is_orientation(const std::string& path) {
  return group_of(path) == "joints" && last_word(path) == "orientation";
}

Where where_in(const Site& site, const QuantitySettings& q, const char* key) {
  const std::string path = "uncertainty." + q.name + "." + key;
  return site.sources.contains(path) ? where_of(site, path) : Where{site.file, q.line};
}

[[noreturn]] void refuse(const Site& site, const QuantitySettings& q, const char* key,
                         const std::string& finding, const std::string& hint) {
  throw InputError(where_in(site, q, key), "[uncertainty." + q.name + "]: " + finding, hint);
}

// Why a key is not drawn: runs must share it to be evaluated together, or it follows from the run.
std::string why_not_drawn(const std::string& path) {
  const std::string group = group_of(path), key = last_word(path);
  if (group == "site" || group == "output" || group == "place" || group == "observed" ||
      group == "uncertainty" || group == "fence" || group == "fence_search" || group == "object" ||
      group == "hazard")
    return "[" + group + "] is the same in all runs";
  if (group == "dam") return "a dam stands in the terrain, which is the same in all runs";
  if (group == "terrain")
    return "the terrain is the same in all runs; its error is terrain_rmse_m of [uncertainty]";
  if (key == "seed") return "seeds follow from the run and its rock mass";
  if (path == "solver.n_runs" || key == "max_blocks")
    return "it is a limit of the whole, not of a run";
  return "";
}

const JointSettings* joints_named(const Site& site, const std::string& name) {
  for (const JointSettings& joints : site.joints)
    if (joints.name == name) return &joints;
  return nullptr;
}

std::string nearest_key(const Site& site, const std::string& path) {
  std::vector<std::string> known = number_keys(site);
  for (const JointSettings& joints : site.joints)
    known.push_back("joints." + joints.name + ".orientation");
  std::vector<std::string> drawable;
  for (const std::string& key : known)
    if (why_not_drawn(key).empty()) drawable.push_back(key);
  const std::string nearest = nearest_name(path, drawable);
  return nearest.empty() ? "name a key as --print-config does: ground.slope.friction_deg"
                         : "did you mean " + nearest + "?";
}

void check_orientation(const Site& site, const QuantitySettings& q, const std::string& path) {
  const std::string name = section_of(path).substr(std::string("joints.").size());
  const JointSettings* joints = joints_named(site, name);
  if (joints == nullptr)
    refuse(site, q, "keys", "there is no section [joints." + name + "]", nearest_key(site, path));
  if (!is_fisher(q))
    refuse(site, q, "keys", path + " is an orientation, expected distribution = \"fisher\"",
           "distribution = \"fisher\" with n_measured, or name dip_deg or dip_direction_deg");
  if (std::isnan(joints->dip_deg) || std::isnan(joints->dip_direction_deg))
    refuse(site, q, "keys",
           path + " needs dip_deg and dip_direction_deg of [joints." + name +
               "], which has measured orientations",
           "give the mean orientation (blocks.json has it), and n_measured here");
  if (q.n_measured > 0 && !(joints->fisher_k > 1))
    refuse(site, q, "n_measured",
           "n_measured needs the scatter of what was measured: fisher_k of [joints." + name +
               "] is " + text(joints->fisher_k) + ", expected above 1",
           "give it there, or fisher_k of the mean orientation here");
}

NumberKey checked_key(const Site& site, const QuantitySettings& q, const std::string& path) {
  if (const std::string why = why_not_drawn(path); !why.empty())
    refuse(site, q, "keys", path + " cannot be drawn: " + why, "take it out");
  const auto key = number_key(site, path);
  if (!key)
    refuse(site, q, "keys", "there is no key " + path + " in this site file",
           nearest_key(site, path));
  if (key->kind == NumberKey::other)
    refuse(site, q, "keys", path + " holds no number", nearest_key(site, path));
  const bool is_whole = key->kind == NumberKey::whole_number;
  if (is_whole && ((q.distribution != "discrete" && !is_rows(q)) || q.apply != "set"))
    refuse(site, q, "keys", path + " holds a whole number, expected distribution = \"discrete\"",
           "distribution = \"discrete\", values = [...] and apply = \"set\"");
  if (std::isnan(key->value) && q.apply != "set")
    refuse(site, q, "apply",
           path + " is not given, so nothing can be " +
               (q.apply == "add" ? "added to it" : "a factor on it"),
           "give the key, or apply = \"set\"");
  if (q.apply == "factor" && key->value == 0)
    refuse(site, q, "apply", path + " is 0, on which a factor does nothing", "apply = \"add\"");
  return *key;
}

// An azimuth continues beyond 360 degrees.
bool is_azimuth(const KeyRange& range) { return range.low == 0 && range.high == 360; }

// --- distributions -----------------------------------------------------------------------------

struct Span {
  double low = -infinity, high = infinity;
};

// Span of draws that keeps all keys in their ranges.
Span span_of(const Site& site, const QuantitySettings& q) {
  Span span;
  for (const std::string& path : q.keys) {
    const NumberKey key = checked_key(site, q, path);
    if (is_azimuth(key.range)) continue;
    double low = key.range.low, high = key.range.high;
    if (q.apply == "add") low -= key.value, high -= key.value;
    if (q.apply == "factor") {
      low /= key.value, high /= key.value;
      if (key.value < 0) std::swap(low, high);
    }
    span.low = std::max(span.low, low);
    span.high = std::min(span.high, high);
  }
  return span;
}

std::string text_of(const Span& span) {
  if (span.high == infinity) return span.low == -infinity ? "any" : "at least " + text(span.low);
  return span.low == -infinity ? "at most " + text(span.high)
                               : text(span.low) + " to " + text(span.high);
}

// All that lack at once.
void need(const Site& site, const QuantitySettings& q,
          const std::vector<std::pair<bool, const char*>>& keys) {
  std::string missing;
  for (const auto& [is_given, key] : keys)
    if (!is_given) missing += (missing.empty() ? "" : ", ") + std::string(key);
  if (!missing.empty())
    refuse(site, q, "distribution", "distribution = \"" + q.distribution + "\" needs " + missing,
           "add " + missing);
}

// Parameters that the distribution does not have must not look as if they counted.
void refuse_others(const Site& site, const QuantitySettings& q) {
  const bool is_normal = q.distribution == "normal" || q.distribution == "lognormal",
             has_ends = q.distribution == "uniform" || q.distribution == "triangular",
             is_discrete = q.distribution == "discrete" || is_rows(q);
  const std::pair<const char*, bool> allowed[] = {
      {"mean", is_normal},        {"std", is_normal},
      {"truncate", is_normal},    {"min", has_ends},
      {"max", has_ends},          {"mode", q.distribution == "triangular"},
      {"values", is_discrete},    {"weights", is_discrete},
      {"fisher_k", is_fisher(q)}, {"n_measured", is_fisher(q)}};
  for (const auto& [key, is_allowed] : allowed)
    if (!is_allowed && site.sources.contains("uncertainty." + q.name + "." + key))
      refuse(site, q, key,
             std::string(key) + " does not belong to distribution = \"" + q.distribution + "\"",
             "take it out, or choose another distribution");
}

// The mean that is not given: the key's own value, or the value that changes nothing.
double mean_of(const Site& site, const QuantitySettings& q) {
  if (!std::isnan(q.mean)) return q.mean;
  if (q.apply != "set") return q.apply == "add" ? 0 : 1;
  const double first = number_key(site, q.keys[0])->value;
  for (const std::string& path : q.keys)
    if (const double own = number_key(site, path)->value; own != first || std::isnan(own))
      refuse(site, q, "distribution",
             std::isnan(own) ? "mean is not given, and " + path + " has no value"
                             : "mean is not given, and its keys have different values: " +
                                   text(first) + " and " + text(own),
             std::isnan(own) ? "give mean" : "give mean, or apply = \"add\" or \"factor\"");
  return first;
}

DistributionKind kind_of(const std::string& name) {
  if (name == "normal") return DistributionKind::normal;
  if (name == "lognormal") return DistributionKind::lognormal;
  if (name == "triangular") return DistributionKind::triangular;
  return name == "discrete" || name == "rows" ? DistributionKind::discrete
                                              : DistributionKind::uniform;
}

void read_ends(const Site& site, const QuantitySettings& q, Distribution& d) {
  need(site, q,
       {{!std::isnan(q.min), "min"},
        {!std::isnan(q.max), "max"},
        {d.kind != DistributionKind::triangular || !std::isnan(q.mode), "mode"}});
  d.min = q.min, d.max = q.max;
  if (!(q.min < q.max))
    refuse(site, q, "max", "max is " + text(q.max) + ", expected above min, " + text(q.min),
           "exchange them, or widen the range");
  if (d.kind != DistributionKind::triangular) return;
  d.mode = q.mode;
  if (q.mode < q.min || q.mode > q.max)
    refuse(site, q, "mode",
           "mode is " + text(q.mode) + ", expected between min and max, " + text(q.min) + " to " +
               text(q.max),
           "the most likely value lies between the ends");
}

void read_values(const Site& site, const QuantitySettings& q, Distribution& d) {
  need(site, q, {{!q.values.empty(), "values"}});
  std::vector<double> weights = q.weights;
  if (weights.empty()) weights.assign(q.values.size(), 1);
  if (weights.size() != q.values.size())
    refuse(site, q, "weights",
           "there are " + counted(static_cast<std::int64_t>(weights.size()), "weight") +
               ", expected one for each of " +
               counted(static_cast<std::int64_t>(q.values.size()), "value"),
           "or leave weights out: all values are then alike");
  std::vector<std::pair<double, double>> pairs;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    pairs.emplace_back(q.values[i], weights[i]), sum += weights[i];
  if (!(sum > 0)) refuse(site, q, "weights", "all weights are 0", "one at least must be above 0");
  std::sort(pairs.begin(), pairs.end());
  d.values.clear();
  for (const auto& [value, weight] : pairs) d.values.push_back(value), d.weights.push_back(weight);
}

// Of the numbers of rows, each of which has a value for every key.
void read_rows(const Site& site, const QuantitySettings& q, Distribution& d) {
  need(site, q, {{!q.values.empty(), "values"}});
  const std::size_t n_keys = q.keys.size(), n_rows = q.values.size() / n_keys;
  if (q.values.size() % n_keys != 0)
    refuse(site, q, "values",
           "there are " + counted(std::ssize(q.values), "value") + ", expected rows of " +
               counted(std::ssize(q.keys), "value") + ", one for every key",
           "write them row by row, in the order of keys");
  if (q.apply != "set")
    refuse(site, q, "apply", "apply is " + q.apply + ", expected set: rows are values of the keys",
           "leave apply out");
  QuantitySettings numbers = q;
  numbers.values.clear();
  for (std::size_t row = 0; row < n_rows; ++row) numbers.values.push_back(static_cast<double>(row));
  read_values(site, numbers, d);
  for (std::size_t i = 0; i < q.values.size(); ++i) {
    const std::string& path = q.keys[i % n_keys];
    const NumberKey key = checked_key(site, q, path);
    const bool is_whole = key.kind == NumberKey::whole_number;
    if (contains(key.range, q.values[i]) && (!is_whole || q.values[i] == std::floor(q.values[i])))
      continue;
    refuse(site, q, "values",
           "row " + std::to_string(i / n_keys + 1) + " has " + text(q.values[i]) + " for " + path +
               ", expected " + (is_whole ? "a whole number, " : "") + text_of(key.range),
           "take the row out");
  }
}

// Ends of a bounded distribution, or one of its values, outside of the ranges of the keys.
void check_span(const Site& site, const QuantitySettings& q, const Distribution& d,
                const Span& span) {
  const bool is_discrete = d.kind == DistributionKind::discrete;
  const double low = is_discrete ? d.values.front() : d.min,
               high = is_discrete ? d.values.back() : d.max;
  const char* lowest = is_discrete ? "values" : "min";
  const char* highest = is_discrete ? "values" : "max";
  const std::string hold = ", outside of " + text_of(span) + ", which its keys may hold";
  if (low < span.low) refuse(site, q, lowest, "draws " + text(low) + hold, "draw nothing below it");
  if (high > span.high)
    refuse(site, q, highest, "draws " + text(high) + hold, "draw nothing above it");
}

void truncate(const Site& site, const QuantitySettings& q, const Span& span, Distribution& d) {
  if (q.truncate.empty()) {
    const double kept = probability_between(d, span.low, span.high);
    if (kept < 1 - most_cut)
      refuse(site, q, "std",
             percent(1 - kept) + " of what it draws lies outside of " + text_of(span) +
                 ", which its keys may hold; expected 1 % at most",
             "give truncate = [low, high], or a smaller std");
    d.low = span.low, d.high = span.high;
    return;
  }
  d.low = q.truncate[0], d.high = q.truncate[1];
  if (!(d.low < d.high))
    refuse(
        site, q, "truncate",
        "truncate is [" + text(d.low) + ", " + text(d.high) + "], expected the lowest value first",
        "exchange them");
  if (d.low < span.low || d.high > span.high)
    refuse(site, q, "truncate",
           "truncate is [" + text(d.low) + ", " + text(d.high) + "], expected within " +
               text_of(span) + ", which its keys may hold",
           "narrow it");
  if (!(probability_between(d, d.low, d.high) > least_kept))
    refuse(site, q, "truncate", "truncate leaves nothing of the distribution",
           "its mean is " + text(d.mean) + ", its standard deviation " + text(d.std));
}

Distribution distribution_of(const Site& site, const QuantitySettings& q) {
  Distribution d;
  d.kind = kind_of(q.distribution);
  if (is_rows(q)) {
    read_rows(site, q, d);
    return d;
  }
  const Span span = span_of(site, q);
  if (d.kind == DistributionKind::discrete) {
    read_values(site, q, d);
    for (const std::string& path : q.keys)
      if (checked_key(site, q, path).kind == NumberKey::whole_number)
        for (const double value : d.values)
          if (value != std::floor(value))
            refuse(site, q, "values", path + " holds a whole number, and a value is " + text(value),
                   "give whole numbers");
    check_span(site, q, d, span);
    return d;
  }
  if (d.kind == DistributionKind::uniform || d.kind == DistributionKind::triangular) {
    read_ends(site, q, d);
    check_span(site, q, d, span);
    return d;
  }
  need(site, q, {{!std::isnan(q.std), "std"}});
  d.mean = mean_of(site, q), d.std = q.std;
  if (d.kind == DistributionKind::lognormal && !(d.mean > 0))
    refuse(site, q, "mean", "the mean of a lognormal is " + text(d.mean) + ", expected above 0",
           "it is the mean of the value, not of its logarithm");
  truncate(site, q, span, d);
  return d;
}

double concentration_of(const Site& site, const QuantitySettings& q, const std::string& path) {
  if (!std::isnan(q.fisher_k)) return q.fisher_k;
  const JointSettings* joints = joints_named(site, section_of(path).substr(7));
  return concentration_of_mean(joints->fisher_k, static_cast<double>(q.n_measured));
}

// --- draws -------------------------------------------------------------------------------------

// A quantity of the site: its index among the coordinates of a point.
struct Drawing {
  const Site& site;
  const QuantitySettings& q;
  Design design;
  std::uint64_t point = 0;
  int dimension = 0;

  [[nodiscard]] double unit(int k) const {
    return unit_value(design, point, dimension + k, q.name);
  }
  [[nodiscard]] bool is_held(const std::string& key) const {
    const auto found = site.sources.find(key);
    return found != site.sources.end() && (found->second.kind == ValueSource::from_cli ||
                                           found->second.kind == ValueSource::from_variant);
  }
  void add(const std::string& key, double value, std::vector<DrawnKey>& drawn) const {
    if (!is_held(key)) drawn.push_back({q.name, key, value});
  }
};

// Of an open range the end itself is not reached, whatever the rounding.
double inside(const KeyRange& range, double value, double towards) {
  if (is_azimuth(range)) {
    const double turned = std::fmod(value, 360);
    return turned < 0 ? turned + 360 : turned;
  }
  const double held = std::clamp(value, range.low, range.high);
  return contains(range, held) ? held : std::nextafter(held, towards);
}

void draw_number(const Drawing& drawing, std::vector<DrawnKey>& drawn) {
  const Distribution d = distribution_of(drawing.site, drawing.q);
  const double x = quantile(d, drawing.unit(0));
  if (is_rows(drawing.q)) {
    const std::size_t n = drawing.q.keys.size();
    for (std::size_t k = 0; k < n; ++k)
      drawing.add(drawing.q.keys[k], drawing.q.values[static_cast<std::size_t>(x) * n + k], drawn);
    return;
  }
  for (const std::string& path : drawing.q.keys) {
    const NumberKey key = *number_key(drawing.site, path);
    const double value = drawing.q.apply == "set"   ? x
                         : drawing.q.apply == "add" ? key.value + x
                                                    : key.value * x;
    const double towards = std::isfinite(key.range.low) ? key.range.low + 1 : 0;
    drawing.add(path, inside(key.range, value, towards), drawn);
  }
}

// The mean turned by the drawn angles, as dip and dip direction of the plane that it is normal to.
void draw_orientation(const Drawing& drawing, std::vector<DrawnKey>& drawn) {
  for (const std::string& path : drawing.q.keys) {
    const std::string section = section_of(path);
    const JointSettings& joints = *joints_named(drawing.site, section.substr(7));
    const DirectionDraw turn = fisher_draw(concentration_of(drawing.site, drawing.q, path),
                                           drawing.unit(0), drawing.unit(1));
    const Vec3 mean = pole(joints.dip_deg * degree, joints.dip_direction_deg * degree);
    const Vec3 across =
        (std::abs(mean.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX()).cross(mean).normalized();
    const Vec3 along = mean.cross(across);
    const Vec3 made =
        std::cos(turn.angle) * mean +
        std::sin(turn.angle) * (std::cos(turn.azimuth) * across + std::sin(turn.azimuth) * along);
    const Attitude lies = attitude(made);
    drawing.add(section + ".dip_deg", lies.dip / degree, drawn);
    drawing.add(section + ".dip_direction_deg", lies.dip_direction / degree, drawn);
  }
}

Sampling sampling_of(const std::string& name) {
  if (name == "hypercube") return Sampling::hypercube;
  return name == "random" ? Sampling::random : Sampling::sobol;
}

// --- checks of all -----------------------------------------------------------------------------

void check_quantity(const Site& site, const QuantitySettings& q) {
  if (q.keys.empty())
    refuse(site, q, "keys", "keys is missing",
           "name what is drawn: keys = [\"ground.slope.friction_deg\"]");
  if (q.distribution.empty())
    refuse(site, q, "distribution", "distribution is missing",
           "distribution = \"uniform\", or normal, lognormal, triangular, discrete, rows, fisher");
  refuse_others(site, q);
  for (const std::string& path : q.keys) {
    if (is_orientation(path)) {
      check_orientation(site, q, path);
    } else if (is_fisher(q)) {
      refuse(site, q, "keys", path + " is not an orientation, expected joints.NAME.orientation",
             "fisher draws dip and dip direction of a joint set together");
    }
  }
  if (!is_fisher(q)) {
    static_cast<void>(distribution_of(site, q));
  } else {
    if (q.apply != "set")
      refuse(site, q, "apply", "apply is " + q.apply + ", expected set: an orientation is turned",
             "leave apply out");
    if ((q.n_measured > 0) == !std::isnan(q.fisher_k))
      refuse(site, q, "distribution",
             "distribution = \"fisher\" needs n_measured or fisher_k, one of them",
             "n_measured: how many orientations the mean is of");
  }
  const bool any_rock = is_rock(q);
  for (const std::string& path : q.keys)
    if (is_rock_key(path) != any_rock)
      refuse(site, q, "keys", "some of its keys cut the rock, and others do not",
             "make two quantities of it");
  if (any_rock && site.uncertainty.rock_masses == 0)
    refuse(site, q, "keys",
           q.keys[0] + " changes the blocks, so that each value needs a rock mass of its own",
           "give rock_masses in [uncertainty]: how many are cut, e.g. 20");
}

// The short form of the same.
void check_scatter(const Site& site, const QuantitySettings& q) {
  const auto check = [&](const char* key, double scatter, const std::string& scatter_key) {
    for (const std::string& path : q.keys)
      if (scatter > 0 && group_of(path) == "ground" && last_word(path) == key)
        refuse(site, q, "keys", path + " is drawn here, and scatters by [solver] " + scatter_key,
               "take one of them out; " + scatter_key + " is a normal that is added");
  };
  check("friction_deg", site.solver.friction_scatter_deg, "friction_scatter_deg");
  check("cor", site.solver.cor_scatter, "cor_scatter");
}

void check_places(const Site& site) {
  for (const PlaceSettings& place : site.places) {
    const Where where{site.file, place.line};
    const int n = static_cast<int>(!place.polygon.empty()) + !place.polygon_file.empty() +
                  !place.fence.empty();
    if (n != 1)
      throw InputError(where,
                       "[place." + place.name + "] has " +
                           (n == 0 ? std::string("none") : std::to_string(n)) +
                           " of polygon, polygon_file and fence, expected one of them",
                       "say where the place is");
    std::vector<std::string> fences;
    for (const FenceSettings& fence : site.fences) fences.push_back(fence.name);
    if (place.fence.empty() || std::find(fences.begin(), fences.end(), place.fence) != fences.end())
      continue;
    const std::string nearest = nearest_name(place.fence, fences);
    throw InputError(where_of(site, "place." + place.name + ".fence"),
                     "there is no [fence." + place.fence + "]",
                     nearest.empty() ? "give the name of a fence, or a polygon"
                                     : "did you mean " + nearest + "?");
  }
}

}  // namespace

bool is_rock_key(const std::string& path) {
  const std::string group = group_of(path), key = last_word(path);
  if (group == "joints")
    return key != "friction_deg" && key != "cohesion_pa" && key != "tension_pa" && key != "jrc" &&
           key != "jcs_mpa";
  return group == "source" || group == "blocks" || group == "rockfall";
}

bool is_rock(const QuantitySettings& quantity) {
  return !quantity.keys.empty() && is_rock_key(quantity.keys[0]);
}

std::vector<std::string> keys_drawn(const QuantitySettings& quantity) {
  std::vector<std::string> keys;
  for (const std::string& path : quantity.keys) {
    if (!is_orientation(path)) {
      keys.push_back(path);
      continue;
    }
    keys.push_back(section_of(path) + ".dip_deg");
    keys.push_back(section_of(path) + ".dip_direction_deg");
  }
  return keys;
}

void check_uncertainty(const Site& site) {
  const UncertaintySettings& u = site.uncertainty;
  if (u.sampling == "hypercube" && u.n_samples == 0 && !site.quantities.empty())
    throw InputError(
        where_of(site, "uncertainty.sampling"),
        "sampling = \"hypercube\" needs n_samples, since it cannot be made larger later",
        "add n_samples, or take sobol");
  if (u.terrain_rmse_m > 0 && u.rock_masses == 0)
    throw InputError(where_of(site, "uncertainty.terrain_rmse_m"),
                     "terrain_rmse_m is " + text(u.terrain_rmse_m) +
                         ": each ground needs a rock mass of its own, and rock_masses is not given",
                     "give rock_masses: how many are cut, e.g. 20");
  std::vector<std::pair<std::string, std::string>> seen;  // key, quantity
  for (const QuantitySettings& q : site.quantities) {
    check_quantity(site, q);
    check_scatter(site, q);
    for (const std::string& key : keys_drawn(q)) {
      for (const auto& [other, name] : seen)
        if (other == key)
          refuse(site, q, "keys",
                 key + " is drawn twice, " +
                     (name == q.name ? "here" : "also by [uncertainty." + name + "]"),
                 "name it once");
      seen.emplace_back(key, q.name);
    }
  }
  check_places(site);
}

std::int64_t rock_mass(const UncertaintySettings& u) {
  return u.sample == 0 || u.rock_masses == 0 ? 0 : (u.sample - 1) % u.rock_masses + 1;
}

std::vector<DrawnKey> drawn_keys(const Site& site, DrawScope scope) {
  const UncertaintySettings& u = site.uncertainty;
  std::vector<DrawnKey> drawn;
  if (u.sample == 0) return drawn;
  if (u.sampling == "hypercube" && !site.quantities.empty() && u.sample > u.n_samples)
    throw InputError(where_of(site, "uncertainty.n_samples"),
                     "sample " + std::to_string(u.sample) + " is asked for of a hypercube of " +
                         std::to_string(u.n_samples),
                     "give a larger n_samples and make all runs again; sobol can go on");
  const auto run = static_cast<std::uint64_t>(u.sample - 1);
  const auto seed = static_cast<std::uint64_t>(u.seed);
  const auto n_masses = static_cast<std::uint64_t>(u.rock_masses);
  int dimension = 0;
  for (const QuantitySettings& q : site.quantities) {
    const bool rock = is_rock(q);
    const auto n_points = static_cast<std::uint64_t>(rock ? u.rock_masses : u.n_samples);
    Drawing drawing{site, q, {sampling_of(u.sampling), seed, n_points}, run, dimension};
    drawing.point = rock ? run % n_masses : point_of_run(drawing.design, run, n_masses);
    dimension += is_fisher(q) ? 2 : 1;
    if (!rock && scope == DrawScope::rock) continue;
    if (is_fisher(q))
      draw_orientation(drawing, drawn);
    else
      draw_number(drawing, drawn);
  }
  return drawn;
}

void apply_draws(Site& site, DrawScope scope) {
  const std::int64_t sample = site.uncertainty.sample, mass = rock_mass(site.uncertainty);
  // rock is cut once for all samples of its mass, and named alike by all of them
  const std::int64_t named = scope == DrawScope::rock && mass > 0 ? mass : sample;
  for (const DrawnKey& drawn : drawn_keys(site, scope)) {
    const std::string words =
        "sample " + std::to_string(named) + " of uncertainty." + drawn.quantity;
    set_number(site, drawn.key, drawn.value, {ValueSource::from_draw, 0, words});
  }
  if (scope == DrawScope::rock && mass > 0) site.uncertainty.sample = mass;
  if (mass == 0) return;
  const ValueSource source{ValueSource::from_draw, 0, "rock mass " + std::to_string(mass)};
  site.source.seed += mass - 1;
  site.sources["source.seed"] = source;
  for (PlacedSettings& body : site.blocks) {
    body.seed += mass - 1;
    site.sources["blocks." + body.name + ".seed"] = source;
  }
  for (RockfallSettings& rocks : site.rockfalls) {
    rocks.seed += mass - 1;
    site.sources["rockfall." + rocks.name + ".seed"] = source;
  }
}

std::vector<DrawnKey> values_in_effect(const Site& site) {
  std::vector<DrawnKey> values;
  for (const QuantitySettings& q : site.quantities)
    for (const std::string& path : keys_drawn(q))
      if (const auto key = number_key(site, path); key && key->kind != NumberKey::other)
        values.push_back({q.name, path, key->value});
  return values;
}

std::string text_of(const Site& site, const QuantitySettings& q) {
  std::string words = list_of(q.keys);
  words += q.apply == "add"      ? ": what is added is drawn from "
           : q.apply == "factor" ? ": a factor is drawn from "
                                 : ": drawn from ";
  words += q.distribution;
  const auto say = [&](const char* name, double value) {
    if (!std::isnan(value)) words += std::string(", ") + name + " " + text(value);
  };
  if (is_fisher(q)) {
    const double k = concentration_of(site, q, q.keys[0]);
    words += " around the mean, concentration " + text(k, 4) + " (95 % within " +
             text(std::acos(std::max(-1.0, 1 + std::log(0.05) / k)) / degree, 3) + " deg)";
    if (q.n_measured > 0) words += ", mean of " + std::to_string(q.n_measured);
  } else if (q.distribution == "normal" || q.distribution == "lognormal") {
    say("mean", mean_of(site, q));
    say("standard deviation", q.std);
  }
  say("min", q.min);
  say("mode", q.mode);
  say("max", q.max);
  if (is_rows(q)) {
    words += ": " + counted(std::ssize(q.values) / std::ssize(q.keys), "set") + " of values";
  } else if (!q.values.empty()) {
    words += ": ";
    for (std::size_t i = 0; i < q.values.size(); ++i)
      words += (i == 0 ? "" : ", ") + text(q.values[i]) +
               (q.weights.empty() ? "" : " (weight " + text(q.weights[i]) + ")");
  }
  if (!q.truncate.empty()) words += ", from " + text(q.truncate[0]) + " to " + text(q.truncate[1]);
  return words + (q.source.empty() ? "" : " (" + q.source + ")");
}

}  // namespace talus
