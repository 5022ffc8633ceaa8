#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include "base/read_file.hpp"
#include "base/text.hpp"
#include "scene/site.hpp"

namespace talus {
namespace {

using Texts = std::vector<std::string>;
using Points = std::vector<Vec3>;
using Numbers = std::vector<double>;

// What a number may be; ends are included unless `open`.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false, open_high = false;
};
constexpr Range any{};
constexpr Range positive{0, std::numeric_limits<double>::infinity(), true, false};
constexpr Range not_negative{0};
constexpr Range share{0, 1};
constexpr Range angle_below_90{0, 90, false, true};
constexpr Range azimuth{0, 360};
constexpr Range at_least_1{1};

// One key: the field that it sets, what it may hold (numbers: range; text: choices separated by |;
// lists: how many entries), what it means, and how to mend it.
template <class Section>
struct Key {
  using Field = std::variant<double Section::*, std::int64_t Section::*, bool Section::*,
                             std::string Section::*, Numbers Section::*, Points Section::*>;
  const char* name;
  Field field;
  const char* help;
  Range range = any;
  const char* choices = "";
  const char* hint = "";
  int n_min = 0, n_max = 1 << 20;  // entries of a list
};

template <class Section>
const std::vector<Key<Section>>& keys();

// clang-format off
constexpr const char* friction_hint = "give degrees; a friction coefficient mu is atan(mu) in degrees";
constexpr const char* dip_hint = "dip is the steepest slope of the plane below the horizontal; dip direction is its azimuth from north";

template <> const std::vector<Key<SiteInfo>>& keys() {
  using S = SiteInfo;
  static const std::vector<Key<S>> table = {
      {"name", &S::name, "name of the site"},
      {"crs", &S::crs, "coordinate system of the coordinates in this file, e.g. EPSG:31287"},
      {"description", &S::description, "free text"}};
  return table;
}
template <> const std::vector<Key<TerrainSettings>>& keys() {
  using S = TerrainSettings;
  static const std::vector<Key<S>> table = {
      {"contours", &S::contours, "contour lines for talus-tin"},
      {"layer", &S::layer, "layer of the contours"},
      {"elevation_field", &S::elevation_field, "field with the elevation of a contour"},
      {"breaklines", &S::breaklines, "breaklines for talus-tin"},
      {"spots", &S::spots, "spot heights for talus-tin"},
      {"boundary", &S::boundary, "boundary polygon for talus-tin"},
      {"dem", &S::dem, "elevation raster for talus-trn instead of contours"},
      {"ground_raster", &S::ground_raster, "raster of ground classes, whole numbers; [ground.*] raster_values says which is which"},
      {"flat", &S::flat, "what happens to flat triangles", any, "fill|keep"},
      {"cell_size_m", &S::cell_size_m, "cell size of the TRN", positive},
      {"window_m", &S::window_m, "xmin, ymin, xmax, ymax of the TRN, map coordinates", any, "", "", 4, 4}};
  return table;
}
template <> const std::vector<Key<SourceSettings>>& keys() {
  using S = SourceSettings;
  static const std::vector<Key<S>> table = {
      {"polygon", &S::polygon, "corners of the source area, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the source area"},
      {"polygon_layer", &S::polygon_layer, "its layer; the first polygon layer when not given"},
      {"failure_surface", &S::failure_surface, "how the surface below the mass is given", any, "vertical_depth|normal_depth|plane|raster|slbl"},
      {"depth_m", &S::depth_m, "depth of the failure surface", positive},
      {"plane_dip_deg", &S::plane_dip_deg, "dip of a failure plane", {0, 90, false, true}, "", dip_hint},
      {"plane_dip_direction_deg", &S::plane_dip_direction_deg, "dip direction of a failure plane", azimuth, "", dip_hint},
      {"plane_point_m", &S::plane_point_m, "map x, y, z of a point of the plane", any, "", "", 3, 3},
      {"raster", &S::raster, "elevations of the failure surface"},
      {"slbl_curvature_m", &S::slbl_curvature_m, "SLBL: how far a node may lie below the mean of its highest and lowest of four neighbours", not_negative},
      {"slbl_max_depth_m", &S::slbl_max_depth_m, "SLBL: largest depth", positive},
      {"material", &S::material, "material of the cut blocks"},
      {"seed", &S::seed, "seed of joint positions and orientations", not_negative},
      {"max_blocks", &S::max_blocks, "more expected blocks than this are refused before cutting, more bodies of a [blocks.*] before placing", {1, 10000000}},
      {"min_block_volume_m3", &S::min_block_volume_m3, "smaller blocks are merged into a neighbour; not given: 1e-2 of the mean joint cell in the mass", not_negative},
      {"min_block_thickness_m", &S::min_block_thickness_m, "thinner blocks are merged into a neighbour; not given: 0.05 of the smallest spacing, or of the cube root of the mass if that is less", not_negative},
      {"min_block_edge_m", &S::min_block_edge_m, "shorter edges of convex blocks are removed, one of their ends stays", not_negative},
      {"max_block_aspect", &S::max_block_aspect, "blocks with a larger ratio of longest to shortest axis are merged into a neighbour", at_least_1},
      {"max_convex_loss", &S::max_convex_loss, "blocks that would lose a larger share by being made convex stay a union of convex parts; 1: never", share}};
  return table;
}
template <> const std::vector<Key<JointSettings>>& keys() {
  using S = JointSettings;
  static const std::vector<Key<S>> table = {
      {"dip_deg", &S::dip_deg, "dip of the set", {0, 90}, "", dip_hint},
      {"dip_direction_deg", &S::dip_direction_deg, "dip direction of the set", azimuth, "", dip_hint},
      {"spacing_m", &S::spacing_m, "mean distance of neighbouring joints along their normal", positive},
      {"spacing", &S::spacing, "distribution of the spacing", any, "fixed|uniform|exponential|lognormal"},
      {"spacing_min_m", &S::spacing_min_m, "smallest spacing (uniform)", positive},
      {"spacing_max_m", &S::spacing_max_m, "largest spacing (uniform)", positive},
      {"spacing_std_m", &S::spacing_std_m, "standard deviation of the spacing (lognormal)", positive},
      {"fisher_k", &S::fisher_k, "Fisher concentration of the orientations; 0: no scatter", not_negative},
      {"persistence", &S::persistence, "share of each joint plane that is open; below 1 as discs", {0, 1, true, false}},
      {"disc_diameter_m", &S::disc_diameter_m, "diameter of the discs (persistence below 1)", positive},
      {"offset_m", &S::offset_m, "distance of one joint from the middle of the source, along the normal"},
      {"measured", &S::measured, "measured dip direction, dip pairs instead of dip_deg and dip_direction_deg [deg]", any, "", "", 1},
      {"measured_file", &S::measured_file, "text file of measured dip direction, dip pairs [deg]"},
      {"n_sets", &S::n_sets, "number of sets that measured pairs are grouped into", {1, 12}},
      {"friction_deg", &S::friction_deg, "friction angle of the joints; that of the material when not given", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion of the joints", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength of the joints", not_negative}};
  return table;
}
template <> const std::vector<Key<MaterialSettings>>& keys() {
  using S = MaterialSettings;
  static const std::vector<Key<S>> table = {
      {"density_kg_m3", &S::density_kg_m3, "density", {100, 10000}, "", "kilograms per cubic metre: rock is 2000 to 3200"},
      {"young_modulus_pa", &S::young_modulus_pa, "Young's modulus", positive},
      {"poisson_ratio", &S::poisson_ratio, "Poisson's ratio", {0, 0.5, false, true}},
      {"friction_deg", &S::friction_deg, "friction angle between blocks", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion between blocks", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength between blocks", not_negative},
      {"cor", &S::cor, "coefficient of restitution between blocks", share}};
  return table;
}
template <> const std::vector<Key<GroundSettings>>& keys() {
  using S = GroundSettings;
  static const std::vector<Key<S>> table = {
      {"friction_deg", &S::friction_deg, "friction angle on the ground", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion on the ground", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength on the ground", not_negative},
      {"cor", &S::cor, "coefficient of restitution along the normal", share},
      {"polygon", &S::polygon, "corners of the area, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the area"},
      {"polygon_layer", &S::polygon_layer, "its layer"},
      {"polygon_where", &S::polygon_where, "attribute filter, e.g. type = 'scree'"},
      {"raster_values", &S::raster_values, "values of [terrain] ground_raster that stand for this ground", any, "", "whole numbers, as the raster has them", 1}};
  return table;
}
template <> const std::vector<Key<SolverSettings>>& keys() {
  using S = SolverSettings;
  static const std::vector<Key<S>> table = {
      {"law", &S::law, "contact law", any, "talus|paper"},
      {"terrain_model", &S::terrain_model, "slope as TRN, or as one fixed block a triangle, to compare with", any, "trn|blocky"},
      {"duration_s", &S::duration_s, "time simulated", positive},
      {"time_step_s", &S::time_step_s, "time step, which law talus cuts where it must; not given: 0.005, law paper 0.0001", {0, 1, true, false}},
      {"min_time_step_s", &S::min_time_step_s, "smallest time step", {0, 1, true, false}},
      {"max_time_step_s", &S::max_time_step_s, "largest time step", {0, 1, true, false}},
      {"gravity_m_s2", &S::gravity_m_s2, "gravity, downwards", not_negative},
      {"normal_stiffness_n_m", &S::normal_stiffness_n_m, "penalty stiffness of a contact", positive},
      {"shear_stiffness_ratio", &S::shear_stiffness_ratio, "shear over normal stiffness", {0, 10, true, false}},
      {"cor", &S::cor, "coefficient of restitution everywhere", share},
      {"strain", &S::strain, "strain degrees of freedom", any, "auto|on|off"},
      {"max_passes", &S::max_passes, "passes of the contact iteration of a lone block in one step, law talus", {1, 10000}},
      {"seed", &S::seed, "seed of the run", not_negative},
      {"n_runs", &S::n_runs, "runs with seeds counted up", {1, 1000000}},
      {"start_jitter_m_s", &S::start_jitter_m_s, "random velocity at the start", not_negative},
      {"friction_scatter_deg", &S::friction_scatter_deg, "standard deviation of the ground's friction between runs", {0, 45}},
      {"cor_scatter", &S::cor_scatter, "standard deviation of the ground's restitution between runs", share},
      {"max_penetration_m", &S::max_penetration_m, "deeper makes the run fail", positive},
      {"max_energy_gain", &S::max_energy_gain, "share of the fall energy; more makes the run fail", not_negative},
      {"max_lost_share", &S::max_lost_share, "share of blocks that may leave the terrain", share},
      {"max_unconverged_share", &S::max_unconverged_share, "share of the steps that may be accepted unconverged", share}};
  return table;
}
template <> const std::vector<Key<FenceSettings>>& keys() {
  using S = FenceSettings;
  static const std::vector<Key<S>> table = {
      {"line", &S::line, "points of the fence, map x, y", any, "", "a fence needs two points", 2},
      {"line_file", &S::line_file, "vector file with the fence line, instead of line"},
      {"line_layer", &S::line_layer, "its layer"},
      {"height_m", &S::height_m, "height above the ground", positive},
      {"capacity_kj", &S::capacity_kj, "energy that a panel takes before it breaks; rigid when not given", positive},
      {"max_deflection_m", &S::max_deflection_m, "deflection at which one block has used up the capacity; half the height when not given", positive},
      {"post_spacing_m", &S::post_spacing_m, "distance of posts", positive},
      {"active", &S::active, "whether it stands in the run"},
      {"cor", &S::cor, "coefficient of restitution of a rigid fence", share},
      {"friction_deg", &S::friction_deg, "friction angle", angle_below_90, "", friction_hint}};
  return table;
}
template <> const std::vector<Key<OutputSettings>>& keys() {
  using S = OutputSettings;
  static const std::vector<Key<S>> table = {
      {"frame_interval_s", &S::frame_interval_s, "simulated time between frames", positive},
      {"checkpoint_interval_s", &S::checkpoint_interval_s, "wall time between checkpoints", positive},
      {"cell_size_m", &S::cell_size_m, "cell size of maps; that of the TRN when not given", positive},
      {"passages", &S::passages, "record passages of cells"},
      {"strain", &S::strain, "record strains"}};
  return table;
}
template <> const std::vector<Key<BaseMotionSettings>>& keys() {
  using S = BaseMotionSettings;
  static const std::vector<Key<S>> table = {
      {"file", &S::file, "CSV with columns time_s, ax_m_s2, ay_m_s2, az_m_s2"},
      {"scale", &S::scale, "factor on the accelerations"},
      {"amplitude_m_s2", &S::amplitude_m_s2, "amplitude of a harmonic motion", not_negative},
      {"frequency_hz", &S::frequency_hz, "frequency of a harmonic motion", positive},
      {"start_s", &S::start_s, "when it starts", not_negative},
      {"duration_s", &S::duration_s, "how long it lasts", positive},
      {"direction_deg", &S::direction_deg, "azimuth of a harmonic motion", azimuth}};
  return table;
}
template <> const std::vector<Key<PlacedSettings>>& keys() {
  using S = PlacedSettings;
  static const std::vector<Key<S>> table = {
      {"file", &S::file, "mesh file: OBJ, PLY, OFF or STL, one or many closed bodies"},
      {"y_up", &S::y_up, "the mesh has y upwards: (x, y, z) becomes (x, -z, y)"},
      {"in_place", &S::in_place, "the mesh has map coordinates and is not moved"},
      {"scale", &S::scale, "factor on the mesh", positive},
      {"shape", &S::shape, "shape instead of a mesh", any, "box|prism|eota|rock"},
      {"size_m", &S::size_m, "box, rock, eota: extents x, y, z; prism: diameter, length", positive, "", "", 1, 3},
      {"volume_m3", &S::volume_m3, "volume that the body is scaled to", positive},
      {"n_sides", &S::n_sides, "sides of a prism", {3, 64}},
      {"n_points", &S::n_points, "points of a rock", {4, 500}},
      {"material", &S::material, "material of the bodies"},
      {"position_m", &S::position_m, "map x, y or x, y, z of each body", any, "", "", 1},
      {"height_above_ground_m", &S::height_above_ground_m, "height of the lowest vertex above the ground below it", not_negative},
      {"release_file", &S::release_file, "vector file of release points or lines"},
      {"release_layer", &S::release_layer, "its layer"},
      {"release_spacing_m", &S::release_spacing_m, "spacing along release lines or of the release grid", positive},
      {"release_grid", &S::release_grid, "release all over the source polygon, evenly by sloping area"},
      {"yaw_deg", &S::yaw_deg, "rotation about z, applied last", {-360, 360}},
      {"pitch_deg", &S::pitch_deg, "rotation about y", {-360, 360}},
      {"roll_deg", &S::roll_deg, "rotation about x, applied first", {-360, 360}},
      {"random_orientation", &S::random_orientation, "each body is turned at random, uniformly over all rotations"},
      {"velocity_m_s", &S::velocity_m_s, "initial velocity x, y, z", any, "", "", 3, 3},
      {"spin_rad_s", &S::spin_rad_s, "initial angular velocity x, y, z", any, "", "", 3, 3},
      {"seed", &S::seed, "seed of shapes and orientations", not_negative},
      {"n_per_point", &S::n_per_point, "bodies at each release point", {1, 100000}}};
  return table;
}
// clang-format on

// --- values ------------------------------------------------------------------------------------

std::string text_of(const Range& range) {
  const bool has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
  if (has_low && has_high)
    return (range.open_low ? "above " : "") + text(range.low) + " to " +
           (range.open_high ? "below " : "") + text(range.high);
  if (has_low) return range.open_low ? "above " + text(range.low) : "at least " + text(range.low);
  return "a finite number";
}

// False for NaN too.
bool contains(const Range& range, double value) {
  const bool above = range.open_low ? value > range.low : value >= range.low;
  const bool below = range.open_high ? value < range.high : value <= range.high;
  return std::isfinite(value) && above && below;
}

const char* type_name(toml::node_type type) {
  switch (type) {
    case toml::node_type::string:
      return "text";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a section";
    default:
      return "a date or time";
  }
}

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

// A value being read: where it stands and what messages call it.
struct Place {
  Where where;
  std::string key;
  const char* hint;
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw InputError(where, key + " is " + found + ", expected " + expected, hint);
  }
};

double number_of(const toml::node& node, const Range& range, const Place& place) {
  double value = 0;
  if (const auto* real = node.as_floating_point())
    value = real->get();
  else if (const auto* whole = node.as_integer())
    value = static_cast<double>(whole->get());
  else
    place.refuse(type_name(node.type()), "a number");
  if (!contains(range, value)) place.refuse(text(value), text_of(range));
  return value;
}

std::int64_t whole_number_of(const toml::node& node, const Range& range, const Place& place) {
  const auto* whole = node.as_integer();
  if (!whole) place.refuse(type_name(node.type()), "a whole number");
  if (!contains(range, static_cast<double>(whole->get())))
    place.refuse(std::to_string(whole->get()), text_of(range));
  return whole->get();
}

const toml::array& list_of(const toml::node& node, const Place& place, int n_min, int n_max) {
  const auto* list = node.as_array();
  if (!list) place.refuse(type_name(node.type()), "a list");
  const int n = static_cast<int>(std::min<size_t>(list->size(), 1u << 30));
  if (n < n_min || n > n_max)
    place.refuse("a list of " + std::to_string(n),
                 n_min == n_max ? std::to_string(n_min) + " entries"
                 : n < n_min    ? "at least " + std::to_string(n_min) + " entries"
                                : "at most " + std::to_string(n_max) + " entries");
  return *list;
}

// [x, y] or [x, y, z]; z is NaN when not given.
Vec3 point_of(const toml::node& node, const Place& place) {
  const toml::array& list = list_of(node, place, 2, 3);
  Vec3 point(0, 0, not_given);
  for (size_t k = 0; k < list.size(); ++k)
    point[static_cast<Eigen::Index>(k)] = number_of(list[k], any, place);
  return point;
}

template <class Section>
struct Reader {
  Section& section;
  const Key<Section>& key;
  const toml::node& node;
  const Place& place;

  void operator()(double Section::*field) const {
    section.*field = number_of(node, key.range, place);
  }
  void operator()(std::int64_t Section::*field) const {
    section.*field = whole_number_of(node, key.range, place);
  }
  void operator()(bool Section::*field) const {
    const auto* flag = node.as_boolean();
    if (!flag) place.refuse(type_name(node.type()), "true or false");
    section.*field = flag->get();
  }
  void operator()(std::string Section::*field) const {
    const auto* value = node.as_string();
    if (!value) place.refuse(type_name(node.type()), "text");
    const std::string choices = std::string("|") + key.choices + "|";
    const bool is_plain = value->get().find_first_of(std::string("|\0", 2)) == std::string::npos;
    if (*key.choices && (!is_plain || choices.find("|" + value->get() + "|") == std::string::npos))
      place.refuse("\"" + value->get() + "\"", "one of " + std::string(key.choices));
    section.*field = value->get();
  }
  void operator()(Numbers Section::*field) const {
    (section.*field).clear();
    for (const toml::node& entry : list_of(node, place, key.n_min, key.n_max))
      (section.*field).push_back(number_of(entry, key.range, place));
  }
  // One point may stand without the outer list.
  void operator()(Points Section::*field) const {
    (section.*field).clear();
    const toml::array& list = list_of(node, place, 1, key.n_max);
    if (!list[0].is_array() && key.n_min <= 1) {
      (section.*field).push_back(point_of(node, place));
      return;
    }
    for (const toml::node& entry : list_of(node, place, key.n_min, key.n_max))
      (section.*field).push_back(point_of(entry, place));
  }
};

// --- values as text ----------------------------------------------------------------------------

std::string quoted(const std::string& value) {
  std::ostringstream out;
  out << toml::node_view<const toml::node>(toml::value<std::string>(value));
  return out.str();
}
std::string literal(double value) { return text(value); }
std::string literal(std::int64_t value) { return std::to_string(value); }
std::string literal(bool value) { return value ? "true" : "false"; }
std::string literal(const std::string& value) { return quoted(value); }
std::string literal(const Vec3& p) {
  std::string out = "[" + text(p.x()) + ", " + text(p.y());
  return out + (std::isnan(p.z()) ? "]" : ", " + text(p.z()) + "]");
}
template <class T>
std::string literal(const std::vector<T>& list) {
  std::string out = "[";
  for (const T& entry : list) out += (out.size() > 1 ? ", " : "") + literal(entry);
  return out + "]";
}

bool is_given(double value) { return !std::isnan(value); }
bool is_given(std::int64_t) { return true; }
bool is_given(bool) { return true; }
bool is_given(const std::string& value) { return !value.empty(); }
template <class T>
bool is_given(const std::vector<T>& list) {
  return !list.empty();
}

const char* type_text(double) { return "number"; }
const char* type_text(std::int64_t) { return "whole number"; }
const char* type_text(bool) { return "true or false"; }
const char* type_text(const std::string&) { return "text"; }
const char* type_text(const Numbers&) { return "list of numbers"; }
const char* type_text(const Points&) { return "list of points"; }

// --- sections ----------------------------------------------------------------------------------

template <class Section>
Texts key_names() {
  Texts names;
  for (const auto& key : keys<Section>()) names.emplace_back(key.name);
  return names;
}

std::string did_you_mean(std::string_view name, const Texts& known) {
  const std::string nearest = nearest_name(name, known);
  if (!nearest.empty()) return "did you mean " + nearest + "?";
  std::string all;
  for (const std::string& entry : known) all += (all.empty() ? "known: " : ", ") + entry;
  return all;
}

const toml::table& table_of(const toml::node& node, const Where& where, const std::string& name) {
  const auto* table = node.as_table();
  if (!table)
    throw InputError(where, name + " is " + type_name(node.type()) + ", expected a section",
                     "write [" + name + "] on a line of its own");
  return *table;
}

template <class Section>
void read_value(Section& section, const Key<Section>& key, const std::string& path,
                const toml::node& node, const Where& where) {
  std::visit(Reader<Section>{section, key, node, Place{where, path, key.hint}}, key.field);
}

// The row of `name`, or an InputError that names the nearest.
template <class Section>
const Key<Section>& key_named(std::string_view name, const std::string& section,
                              const Where& where) {
  for (const auto& key : keys<Section>())
    if (name == key.name) return key;
  throw InputError(where, "unknown key " + std::string(name) + " in [" + section + "]",
                   did_you_mean(name, key_names<Section>()));
}

template <class Section>
void read_section(Site& site, Section& section, const std::string& name, const toml::table& table) {
  for (const auto& [key_text, node] : table) {
    const Where where{site.file, line_of(node)};
    const auto& key = key_named<Section>(key_text.str(), name, where);
    read_value(section, key, std::string(key_text.str()), node, where);
    site.sources[name + "." + key.name] = {ValueSource::from_file, where.line};
  }
}

int& line_field(FenceSettings& fence) { return fence.line_number; }
template <class Section>
int& line_field(Section& section) {
  return section.line;
}

// [group.NAME] sections, in the order of the file (tables are kept sorted by name).
template <class Section>
void read_named(Site& site, std::vector<Section>& sections, const std::string& group,
                const toml::table& tables) {
  std::vector<std::pair<const toml::node*, std::string>> found;
  for (const auto& [name, node] : tables) found.emplace_back(&node, std::string(name.str()));
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return line_of(*a.first) < line_of(*b.first);
  });
  for (const auto& [node, name] : found) {
    const Where where{site.file, line_of(*node)};
    const auto* table = node->as_table();
    if (!table)
      throw InputError(
          where,
          group + "." + name + " is " + type_name(node->type()) + ", expected a section of its own",
          "[" + group + "] holds named sections: write [" + group + ".NAME]");
    Section section;
    section.name = name;
    line_field(section) = where.line;
    read_section(site, section, group + "." + name, *table);
    sections.push_back(std::move(section));
  }
}

// Calls visit(name, section) for the single sections and visit(group, vector) for the named ones.
template <class SiteType, class Visit>
void for_each_group(SiteType& site, Visit&& visit) {
  visit("site", site.info);
  visit("terrain", site.terrain);
  visit("source", site.source);
  visit("joints", site.joints);
  visit("material", site.materials);
  visit("ground", site.grounds);
  visit("blocks", site.blocks);
  visit("solver", site.solver);
  visit("fence", site.fences);
  visit("base_motion", site.base_motion);
  visit("output", site.output);
}

// Of the sections that there are in `group`, with it: "ground.scree".
struct SectionNames {
  const std::string& group;
  Texts& names;
  template <class Section>
  void operator()(const char*, const Section&) const {}
  template <class Section>
  void operator()(const char* candidate, const std::vector<Section>& sections) const {
    if (group != candidate) return;
    for (const Section& section : sections) names.push_back(group + "." + section.name);
  }
};

Texts group_names() {
  Texts names;
  Site site;
  for_each_group(site, [&](const char* name, auto&) { names.emplace_back(name); });
  return names;
}

struct GroupReader {
  Site& site;
  const toml::table& root;
  template <class Section>
  void operator()(const char* name, Section& section) const {
    if (const toml::node* node = root.get(name)) {
      site.sections.emplace_back(name);
      read_section(site, section, name, table_of(*node, {site.file, line_of(*node)}, name));
    }
  }
  template <class Section>
  void operator()(const char* name, std::vector<Section>& sections) const {
    if (const toml::node* node = root.get(name)) {
      site.sections.emplace_back(name);
      read_named(site, sections, name, table_of(*node, {site.file, line_of(*node)}, name));
    }
  }
};

void check_groups(const toml::table& root, const std::string& file) {
  const Texts known = group_names();
  for (const auto& [name, node] : root) {
    if (std::find(known.begin(), known.end(), name.str()) != known.end()) continue;
    const std::string kind = node.is_table() ? "section " : "key outside any section: ";
    throw InputError({file, line_of(node)}, "unknown " + kind + std::string(name.str()),
                     did_you_mean(name.str(), known));
  }
}

void fill_defaults(Site& site) {
  namespace fs = std::filesystem;
  site.folder = fs::path(site.file).parent_path().string();
  if (site.info.name.empty()) {
    std::error_code unreadable;
    const fs::path whole = fs::absolute(site.file, unreadable);
    site.info.name = unreadable ? "site" : whole.parent_path().filename().string();
  }
  if (site.materials.empty()) {
    site.materials.emplace_back();
    site.materials.back().name = "rock";
  }
  if (site.grounds.empty()) {
    site.grounds.emplace_back();
    site.grounds.back().name = "ground";
  }
}

// Names that other sections refer to.
void check_material(const Site& site, const std::string& material, const std::string& key) {
  Texts known;
  for (const auto& entry : site.materials) known.push_back(entry.name);
  if (material.empty()) {
    if (known.size() == 1) return;
    throw InputError(where_of(site, key), key + " is not given, but there are several materials",
                     "name one of [material.*]");
  }
  if (std::find(known.begin(), known.end(), material) == known.end())
    throw InputError(where_of(site, key), key + " is \"" + material + "\", which is not a material",
                     did_you_mean(material, known));
}

void check_names(const Site& site) {
  const auto stands = [&](const char* section) {
    return std::find(site.sections.begin(), site.sections.end(), section) != site.sections.end();
  };
  if (stands("source")) check_material(site, site.source.material, "source.material");
  for (const auto& body : site.blocks)
    check_material(site, body.material, "blocks." + body.name + ".material");
}

// --- printing ----------------------------------------------------------------------------------

std::string key_text(const std::string& name) {
  const bool is_bare = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
  });
  return is_bare ? name : quoted(name);
}

struct ValueLister {
  const Site& site;
  std::vector<EffectiveValue>& values;

  // `section` is the name for people, `path` the key of Site::sources.
  template <class Section>
  void list(const std::string& section, const std::string& path, const Section& fields) const {
    for (const auto& key : keys<Section>())
      std::visit(
          [&](auto field) {
            const auto& value = fields.*field;
            values.push_back({section, key.name, is_given(value) ? literal(value) : "",
                              source_of(path + "." + key.name)});
          },
          key.field);
  }
  std::string source_of(const std::string& path) const {
    const auto found = site.sources.find(path);
    if (found == site.sources.end()) return "default";
    if (found->second.kind == ValueSource::from_cli) return "cli";
    return "file, line " + std::to_string(found->second.line);
  }
  template <class Section>
  void operator()(const char* name, const Section& fields) const {
    list(name, name, fields);
  }
  template <class Section>
  void operator()(const char* group, const std::vector<Section>& sections) const {
    for (const Section& fields : sections)
      list(group + ("." + key_text(fields.name)), group + ("." + fields.name), fields);
  }
};

struct KeyLister {
  std::vector<KeyDescription>& rows;
  template <class Section>
  void list(const std::string& name, const Section& values) const {
    for (const auto& key : keys<Section>())
      std::visit(
          [&](auto field) {
            const bool has_range = std::isfinite(key.range.low) || std::isfinite(key.range.high);
            rows.push_back({name, key.name, type_text(values.*field),
                            is_given(values.*field) ? literal(values.*field) : "",
                            *key.choices ? key.choices
                            : has_range  ? text_of(key.range)
                                         : "",
                            key.help});
          },
          key.field);
  }
  template <class Section>
  void operator()(const char* name, const Section& values) const {
    list(name, values);
  }
  template <class Section>
  void operator()(const char* group, const std::vector<Section>&) const {
    list(std::string(group) + ".NAME", Section{});
  }
};

// --- command line ------------------------------------------------------------------------------

// `value` as a TOML value; plain text when it is none.
toml::table parsed_value(const std::string& value) {
  try {
    toml::table table = toml::parse("value = " + value);
    if (table.size() == 1) return table;
  } catch (const toml::parse_error&) {
    // not a TOML value: text without quotes
  }
  return toml::table{{"value", value}};
}

struct Overrider {
  Site& site;
  std::string group, name, key;  // name is empty for single sections
  const toml::node& node;
  bool& is_done;

  template <class Section>
  void set(Section& section, const std::string& path) const {
    const Where where{"", 0, "command line"};
    const auto& row = key_named<Section>(key, path, where);
    read_value(section, row, path + "." + key, node, where);
    site.sources[path + "." + key] = {ValueSource::from_cli, 0};
    is_done = true;
  }
  template <class Section>
  void operator()(const char* candidate, Section& section) const {
    if (group == candidate && name.empty()) set(section, group);
  }
  template <class Section>
  void operator()(const char* candidate, std::vector<Section>& sections) const {
    for (Section& section : sections)
      if (group == candidate && name == section.name) set(section, group + "." + name);
  }
};

}  // namespace

Site parse_site(const std::string& text, const std::string& path) {
  Site site;
  site.file = path;
  toml::table root;
  try {
    root = toml::parse(text, path);
  } catch (const toml::parse_error& error) {
    throw InputError({path, static_cast<int>(error.source().begin.line)},
                     std::string(error.description()),
                     "the file must be TOML: key = value, text in quotes, decimals with a point");
  }
  check_groups(root, path);
  for_each_group(site, GroupReader{site, root});
  fill_defaults(site);
  check_names(site);
  return site;
}

Site read_site(const std::string& path) {
  return parse_site(read_file(path, "give the path of a site.toml"), path);
}

void override_value(Site& site, const std::string& key, const std::string& value) {
  const size_t first = key.find('.'), last = key.rfind('.');
  if (first == std::string::npos)
    throw InputError({"", 0, "command line"}, "\"" + key + "\" is not section.key",
                     "e.g. solver.duration_s");
  const std::string group = key.substr(0, first);
  const std::string name = first == last ? "" : key.substr(first + 1, last - first - 1);
  const toml::table holder = parsed_value(value);
  const toml::node* node = holder.get("value");
  const toml::value<std::string> plain(value);
  bool is_done = false;
  const Overrider overrider{site,
                            group,
                            name,
                            key.substr(last + 1),
                            node ? *node : static_cast<const toml::node&>(plain),
                            is_done};
  for_each_group(site, overrider);
  if (!is_done) {
    Texts known;
    for_each_group(site, SectionNames{group, known});
    throw InputError({"", 0, "command line"}, "no section [" + key.substr(0, last) + "]",
                     known.empty() ? did_you_mean(group, group_names())
                                   : did_you_mean(key.substr(0, last), known));
  }
  check_names(site);
}

std::vector<EffectiveValue> effective_values(const Site& site) {
  std::vector<EffectiveValue> values;
  for_each_group(site, ValueLister{site, values});
  return values;
}

std::string print_config(const Site& site) {
  std::string out, section;
  for (const EffectiveValue& entry : effective_values(site)) {
    if (entry.section != section) out += (section.empty() ? "[" : "\n[") + entry.section + "]\n";
    section = entry.section;
    out += entry.value.empty() ? "# " + entry.key + ": not given\n"
                               : entry.key + " = " + entry.value + "  # " + entry.source + "\n";
  }
  return out;
}

std::vector<KeyDescription> site_keys() {
  std::vector<KeyDescription> rows;
  const Site site;
  for_each_group(site, KeyLister{rows});
  return rows;
}

}  // namespace talus
