// libcore/site/site.hpp: public
// The site file as plain structs: one struct a section, one field a key, its default beside it.
// Every tool reads the whole file and takes its own sections. A new key is a field here and a row
// in the table of site_keys.cpp; docs/reference/site-file.md holds that table, and a test compares
// them.
//
// A field named like its key, unit included. NaN, an empty text and an empty list mean "not given".
// A vector file may name layers and a filter: "map.gpkg|layername=release|subset=kind = 'a'".
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/types.hpp"

namespace talus {

inline constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

/// [site]
struct SiteInfo {
  std::string name;  ///< of the site; the name of its folder when not given
  std::string crs;   ///< e.g. "EPSG:31287"; system of the coordinates in this file
  std::string description;
  std::string layers;  ///< GeoPackage whose layers define sections; empty once they were taken
};

/// [terrain]: settings of talus-tin and talus-trn.
struct TerrainSettings {
  std::string contours, elevation_field;
  std::string breaklines, spots;
  std::string boundary;
  std::string dem;
  std::string ground_raster;  ///< classes of ground, whole numbers
  std::string flat = "fill";
  double cell_size_m = not_given;
  std::vector<double> window_m;  ///< xmin, ymin, xmax, ymax in map coordinates
};

/// [source]: where the moving mass is, down to which surface, and the limits of cutting.
struct SourceSettings {
  std::vector<Vec3> polygon;  ///< map x, y; or polygon_file
  std::string polygon_file;
  std::string failure_surface = "normal_depth";
  std::string sliding_set;  ///< of a daylighting surface; not given: that of the largest mass
  double depth_m = not_given;
  double plane_dip_deg = not_given, plane_dip_direction_deg = not_given;
  std::vector<double> plane_point_m;  ///< map x, y, z
  std::string raster;
  double slbl_curvature_m = 0;  ///< below the mean of the highest and lowest of four neighbours
  double slbl_max_depth_m = not_given;
  double slbl_sag_m = not_given;  ///< instead of slbl_curvature_m
  std::string slbl_scenario;      ///< instead of both
  std::string daylight;           ///< rock in front of the mass along this direction is left out
  std::string material;           ///< of the blocks; the only one when there is one
  std::int64_t seed = 1;
  std::int64_t max_blocks = 20000;
  double min_block_volume_m3 = not_given;    ///< not given: 1e-2 of the mean joint cell
  double min_block_thickness_m = not_given;  ///< see docs/reference/site-file.md
  double min_block_edge_m = not_given;  ///< not given: 1e-3 of the cube root of the block's volume
  double max_block_aspect = 50;
  double max_convex_loss = 0.05;  ///< share of a block's volume; above it the block stays exact
};

/// [joints]: from the north of a compass to that of the map.
struct JointNorth {
  double declination_deg = 0;  ///< magnetic north east of true north: added to azimuths
  double convergence_deg = 0;  ///< grid north east of true north: taken off
  [[nodiscard]] double turn_deg() const { return declination_deg - convergence_deg; }
};

/// [joints.NAME]
struct JointSettings {
  std::string name;
  int line = 0;  ///< of the section
  double dip_deg = not_given, dip_direction_deg = not_given;
  double spacing_m = not_given;
  std::string spacing = "fixed";
  double spacing_min_m = not_given, spacing_max_m = not_given;  ///< uniform
  double spacing_std_m = not_given;                             ///< lognormal
  double fisher_k = 0;                                          ///< 0: no scatter
  double persistence = 1;              ///< share of each joint plane that is open
  double disc_diameter_m = not_given;  ///< not given: 10 spacings
  double offset_m = 0;         ///< of the first plane from the source's middle, along the normal
  std::vector<Vec3> measured;  ///< dip direction, dip pairs that represent the set(s)
  std::string measured_file;
  std::int64_t n_sets = 1;
  double friction_deg = not_given, cohesion_pa = 0, tension_pa = 0;
  double jrc = not_given, jcs_mpa = not_given;  ///< as of GroundSettings
};

/// [material.NAME]: the rock of blocks.
struct MaterialSettings {
  std::string name;
  int line = 0;
  double density_kg_m3 = 2600;
  double young_modulus_pa = 5e9;
  double poisson_ratio = 0.25;
  double friction_deg = 30;  ///< between blocks
  double cohesion_pa = 0, tension_pa = 0;
  double cor = 0.3;           ///< coefficient of restitution between blocks
  double strength_mpa = 100;  ///< uniaxial compressive; 0: nothing is crushed
  double crush_below = 0.01;  ///< share of the median volume below which blocks are crushed
};

/// [ground.NAME]: ground under blocks; a polygon or `raster_values` give its area, one section
/// without both holds elsewhere.
struct GroundSettings {
  std::string name;
  int line = 0;
  double friction_deg = 30;
  double cohesion_pa = 0, tension_pa = 0;
  double jrc = not_given, jcs_mpa = not_given;  ///< roughness; friction_deg is residual
  double cor = 0.3;                             ///< along the normal
  std::string soil;                       ///< fills keys that are not given; libcore/site/soils.hpp
  double cor_half_speed_m_s = not_given;  ///< approach at which the COR is half of `cor`
  double cor_half_energy_kj = not_given;  ///< or energy of the approach
  double rolling_resistance = not_given;  ///< largest couple over normal force and radius
  double bearing_kpa = not_given;         ///< rolling resistance by the block's size instead
  double scar_friction = not_given, scar_rate_1_m = not_given, scar_decay_1_s = not_given;
  double drag_1_s = 0, drag_1_m = 0;
  double friction_weak_deg = not_given, weakening_speed_m_s = not_given;
  std::vector<Vec3> polygon;
  std::string polygon_file;
  std::vector<double> raster_values;  ///< of TerrainSettings::ground_raster, whole numbers
};

/// [solver]
struct SolverSettings {
  std::string law = "talus";
  std::string blocks = "auto";     ///< how they move: together, alone; see moves_alone()
  std::string friction = "given";  ///< or weakening, see weakening() in soils.hpp
  double duration_s = 60;
  double time_step_s = not_given;  ///< not given: time_step() says
  double gravity_m_s2 = 9.80665;
  double normal_stiffness_n_m = not_given;
  std::string strain = "auto";
  bool end_when_standing = true;  ///< a run in which nothing moves ends after some seconds
  double accuracy = 0.005;        ///< of the displacement of moving blocks: see Settings
  std::int64_t seed = 1, n_runs = 1;
  double start_jitter_m_s = 0;
  double friction_scatter_deg = 0, cor_scatter = 0;
  double max_penetration_m = not_given;
  double max_energy_gain = 0.01;       ///< share of the fall energy; more makes the run fail
  double max_lost_share = 0.01;        ///< of the mass; more makes the run fail
  double max_unconverged_share = 0.1;  ///< of the steps; more makes the run fail
};

/// [fence.NAME]
struct FenceSettings {
  std::string name;
  int line_number = 0;
  std::vector<Vec3> line;  ///< map x, y of at least two points; or file
  std::string file;
  double height_m = 5;
  double capacity_kj = not_given;       ///< of a panel; not given: rigid
  double max_deflection_m = not_given;  ///< where it is used up; not given: half the height
  double post_spacing_m = 10;
  bool active = true;
  double cor = 0.1, friction_deg = 30;
};

/// [dam.NAME]: burnt into the terrain by talus-trn.
struct DamSettings {
  std::string name, kind = "dam";
  int line_number = 0;
  std::vector<Vec3> line;  ///< middle of the crest, map x, y of at least two points; or file
  std::string file;
  double height_m = 5;  ///< of the crest above the ground at each point of the line
  double crest_width_m = 2;
  std::vector<double> slopes_deg{60, 34};  ///< of the uphill and the downhill face
  std::vector<double> ditch_m;             ///< depth below the uphill foot, width; none: no ditch
  double capacity_kj = not_given;          ///< by the dam's design
  bool active = true;
};

/// [forest.NAME]: stems that stop or slow blocks, drawn or from a list; or drag without stems.
struct ForestSettings {
  std::string name;
  int line = 0;
  std::vector<Vec3> polygon;  ///< map x, y; or polygon_file
  std::string polygon_file;
  double stems_per_ha = not_given;
  double dbh_mean_cm = 30, dbh_std_cm = 10;  ///< diameter at breast height, gamma distributed
  double conifer_share = 1;
  std::string nrtrees_raster, dbhmean_raster, dbhstd_raster, conif_percent_raster;
  std::string stems_file;  ///< points with dbh_cm, and species or conifer
  double height_m = 20, friction_deg = 16.7;
  double drag_kg_s = 0;  ///< d of the force -d v on a block below the canopy
  std::int64_t seed = 1;
  bool new_stand_per_run = false;
  bool active = true;
};

/// [output]
struct OutputSettings {
  double frame_interval_s = 0.1;
  double checkpoint_interval_s = 60;  ///< of wall time
  double cell_size_m = not_given;
  bool passages = true;
  bool frames = true;      ///< kept once the run has ended; else the first and the last alone
  double whole_share = 0;  ///< of the runs, where frames is false, that keep them nevertheless
};

/// [base_motion]: acceleration of the ground, from a file or a harmonic one.
struct BaseMotionSettings {
  std::string file;  ///< CSV: time_s, ax_m_s2, ay_m_s2, az_m_s2
  double scale = 1;
  double amplitude_m_s2 = 0, frequency_hz = not_given, start_s = 0, duration_s = not_given;
  double direction_deg = 0;  ///< azimuth, clockwise from north
};

/// [water]: water in the joints of the mass before it moves. At most one of the first three.
struct WaterSettings {
  std::vector<Vec3> surface_m;  ///< map x, y, z: one point of a level, or three of a plane
  std::string raster;           ///< elevations of the piezometric surface
  double depth_m = not_given;   ///< of it below the surface of the mass
  std::vector<std::string> cracks, drained;  ///< joint sets; "source_side"
  double crack_fill_m = not_given;           ///< above the lowest point of each crack
  double drained_at_m = 0.01;                ///< opening of a face that drains it
};

/// [fragmentation]: blocks that break in two when they are hit hard.
struct FragmentationSettings {
  bool enabled = false;
  std::string splitting = "random";  ///< or "joints"
  double energy_j_m2 = 3e5;          ///< effective work of fracture
  double spread = 2;                 ///< exponent of the chance to break
  double separation_share = 0.01;    ///< of the energy that the hit took
  double min_volume_m3 = 0.01;
  std::int64_t max_generation = 6;
  std::int64_t seed = 1;
};

/// Bodies of [blocks.*] and [rockfall.*]: a mesh or a shape, how large, and how they start.
struct BodySettings {
  std::string name;
  int line = 0;
  std::string file;  ///< OBJ, PLY, OFF or STL; or shape
  double scale = 1;
  std::string shape;
  std::vector<double>
      size_m;  ///< edges of a box; axes of a rock, a prism (diameter, length) or an eota
  double volume_m3 = not_given;  ///< scales the shape to it
  std::int64_t n_points = 20;    ///< rock
  std::string material;
  std::vector<Vec3> position_m;              ///< map x, y or x, y, z; several: one body each
  double height_above_ground_m = not_given;  ///< of the lowest vertex; not given with z: z of the
                                             ///< centroid
  std::vector<double> velocity_m_s, spin_rad_s;
  std::int64_t seed = 1;
};

/// [blocks.NAME]: bodies that rest on one another and move together.
struct PlacedSettings : BodySettings {
  double yaw_deg = 0, pitch_deg = 0, roll_deg = 0;
  bool random_orientation = false;
};

/// [rockfall.NAME]: a source of rocks that fall one by one. Each is turned at random.
struct RockfallSettings : BodySettings {
  std::string release_file;              ///< points, or lines with release_spacing_m
  std::vector<Vec3> polygon;             ///< map x, y; or polygon_file
  std::string polygon_file;              ///< areas that rocks are released all over
  double release_spacing_m = not_given;  ///< along lines, in areas; of areas not given: a cell
  double min_slope_deg = 0;              ///< of areas: flatter ground releases none
  std::string rockdensity_raster;        ///< source cells: density [kg/m3], 0 elsewhere
  std::string d1_raster, d2_raster, d3_raster, blshape_raster;  ///< extents [m], shapes by cell
  std::int64_t rocks = 1;                                       ///< at each place
  std::vector<double> volumes_m3;                               ///< drawn from
  double volume_max_m3 = not_given;                             ///< power law from volume_m3 to it
  double volume_exponent = 1;                                   ///< of the number of larger ones
  double height_scatter_m = 0, velocity_scatter_m_s = 0, spin_scatter_rad_s = 0;
  double frequency_per_a = not_given;     ///< rocks of the whole source; bodies' weights
  double frequency_per_m2_a = not_given;  ///< of sloping area, instead
};

/// [hazard]: settings of hazard classes.
struct HazardSettings {
  std::string recipe = "switzerland_ti";  ///< a name of share/hazard, or a file
  std::string author, date, name_space;   ///< of the filed map; all of them, or none
};

/// [hazard.class.NAME]: frequency of the simulated events of a class of volumes. One of the
/// three forms, or none: then the sources give it, see RockfallSettings.
struct HazardClassSettings {
  std::string name;
  int line = 0;
  double frequency_per_a = not_given;
  double events = not_given, observed_a = not_given;  ///< so many events in so many years
  double failure_probability = not_given, in_years = not_given;
};

/// [object.NAME]: an endangered object; it does not stop blocks.
struct ObjectSettings {
  std::string name;
  int line_number = 0;
  std::vector<Vec3> polygon, line, position_m;  ///< map x, y; one of them, or file
  std::string file;
  double width_m = not_given;   ///< of a line
  double radius_m = not_given;  ///< about points
  std::string kind;             ///< "house", "road": printed
  /// For recipes of risk: the share of the time of who is there most, the probabilities of death of
  /// who is hit by the recipe's intensities, and how many are there like that.
  double presence = not_given;
  std::vector<double> vulnerability;
  double persons_per_day = not_given;
};

/// [fence_search.NAME]: where a fence would protect an object best.
struct FenceSearchSettings {
  std::string name;
  int line = 0;
  std::string protect;                     ///< name of an [object.*]
  std::vector<double> between_m{10, 150};  ///< nearest and farthest from the object, in plan
  double step_m = 5;                       ///< from one candidate line to the next
  std::string style = "contour";           ///< or "offset"
  std::int64_t max_candidates = 60;
  double share = 0.95;                        ///< of the hits on the object, to be stopped
  std::vector<double> heights_m{3, 4, 5, 6};  ///< ascending
  std::vector<double> classes_kj;             ///< ascending; not given: share/codes
  std::vector<double> prices_per_m;           ///< one a class; not given: relative ones
  double price_per_m2 = not_given;            ///< of a metre of length and of height, on top
  std::string code = "uni";                   ///< uni, onr or a file
  double post_spacing_m = 10;
  std::int64_t min_fields = 3, end_fields = 1;
  double max_length_m = not_given;
  double max_line_slope_deg = 20, max_ground_slope_deg = 50;
  bool two_fences = true;
};

/// [uncertainty]: how the quantities of [uncertainty.NAME] are drawn.
struct UncertaintySettings {
  std::string sampling = "sobol";
  std::int64_t seed = 1;
  std::int64_t n_samples = 0;    ///< of a hypercube
  std::int64_t sample = 0;       ///< of this run, from 1; 0: nothing is drawn
  std::int64_t rock_masses = 0;  ///< sets of blocks that are cut; 0: one, with the file's values
  double terrain_rmse_m = 0, terrain_correlation_m = not_given;
  double max_failed_share = 0.02;  ///< of the runs, that may be left out
  std::string file;                ///< of further quantities; empty once they were taken
};

/// [uncertainty.NAME]: a quantity that differs from run to run.
struct QuantitySettings {
  std::string name;
  int line = 0;
  std::vector<std::string> keys;  ///< that move together
  std::string apply = "set";
  std::string distribution;
  double mean = not_given, std = not_given;                   ///< normal, lognormal
  double min = not_given, mode = not_given, max = not_given;  ///< uniform, triangular
  std::vector<double> values, weights;  ///< discrete; rows: row by row, a value a key
  std::vector<double> truncate;         ///< lowest and highest
  std::int64_t n_measured = 0;          ///< fisher: of the mean of so many
  double fisher_k = not_given;          ///< fisher: of the mean itself
  std::string source;                   ///< of these numbers
};

/// [observed.NAME]: traces of an event or a test, in vector files.
struct ObservedSettings {
  std::string name;
  int line = 0;
  std::string boulders_file;  ///< points, with volume_m3 and date where known
  std::string scars_file;     ///< points with height_m, and date where known
  std::string outline_file;   ///< areas
};

/// [place.NAME]: where it is to be known how many blocks arrive.
struct PlaceSettings {
  std::string name;
  int line = 0;
  std::vector<Vec3> polygon;  ///< map x, y; or polygon_file; or fence
  std::string polygon_file;
  std::string fence;         ///< a line of [fence.*]
  double half_width = 0.05;  ///< wanted, of the interval of the share of blocks
};

/// [variant.NAME]: differences from the site. With a weight it is an alternative of nature,
/// counted together with the rest; without one a measure, whose results are listed beside those of
/// the site.
struct VariantSettings {
  std::string name;
  int line = 0;
  double weight = not_given;
  double cost = not_given;           ///< of the measure, in any currency
  std::vector<std::string> without;  ///< sections that it lacks: "fence.valley"
  /// A key of a section of the site, or of one that the variant adds.
  struct Change {
    std::string group, name, key, value;  ///< value as TOML; name is empty in a single section
    int line = 0;
  };
  std::vector<Change> changes;  ///< in the order of the file
};
[[nodiscard]] inline bool is_alternative(const VariantSettings& variant) {
  return variant.weight > 0;
}

/// Where the value of a key came from.
struct ValueSource {
  enum Kind {
    from_default,
    from_file,
    from_cli,
    from_soil,
    from_draw,
    from_layer,
    from_variant
  } kind = from_default;
  int line = 0;  ///< in the site file
  /// Of a draw: "sample 7 of uncertainty.friction"; of a layer: "site.gpkg, layer fences, feature
  /// 2"; of a variant: "variant net6, line 80".
  std::string words{};
};

struct Site {
  std::string file;             ///< path as given
  std::string folder;           ///< of the file; relative paths in it start there
  std::string layers_file;      ///< that sections were taken from, as SiteInfo::layers says it
  std::string quantities_file;  ///< that quantities were taken from, as UncertaintySettings::file
  std::string inputs;       ///< file of talus-import to read the site's layers from; empty: none
  std::string alternative;  ///< variant with a weight that was applied; empty: none
  std::vector<std::string> measures;  ///< variants without one that were applied, in order
  std::map<std::string, std::string> layer_digests;  ///< "fence.valley" -> of its features there
  SiteInfo info;
  TerrainSettings terrain;
  SourceSettings source;
  SolverSettings solver;
  OutputSettings output;
  BaseMotionSettings base_motion;
  WaterSettings water;
  FragmentationSettings fragmentation;
  JointNorth joint_north;
  std::vector<JointSettings> joints;        ///< in the order of the file, as all named sections
  std::vector<MaterialSettings> materials;  ///< at least one: "rock" with the defaults
  std::vector<GroundSettings> grounds;      ///< at least one: "ground" with the defaults
  std::vector<FenceSettings> fences;
  std::vector<DamSettings> dams;
  std::vector<ForestSettings> forests;
  std::vector<PlacedSettings> blocks;
  std::vector<RockfallSettings> rockfalls;
  UncertaintySettings uncertainty;
  std::vector<QuantitySettings> quantities;
  std::vector<PlaceSettings> places;
  std::vector<ObservedSettings> observed;
  std::vector<ObjectSettings> objects;
  std::vector<FenceSearchSettings> fence_searches;
  HazardSettings hazard;
  std::vector<HazardClassSettings> hazard_classes;
  std::vector<VariantSettings> variants;
  std::map<std::string, ValueSource> sources;  ///< "joints.J1.dip_deg" -> its origin
  std::vector<std::string> sections;           ///< of the file
};

/// Whether each block moves as if it were alone: [solver] blocks, or rocks of [rockfall.*].
[[nodiscard]] bool moves_alone(const Site& site);

/// Reads and checks a site file.
///
/// Throws InputError with file:line for text that is not TOML, an unknown section or key (naming
/// the nearest known one), a wrong type, a number out of its range, a name that repeats. Values of
/// [uncertainty.*] are checked by check_uncertainty().
[[nodiscard]] Site read_site(const std::string& path);
/// The same from text; `path` is named in messages.
[[nodiscard]] Site parse_site(const std::string& text, const std::string& path);

/// Where the key of "section.key=value" ends. A name may hold the sign too, so the first one counts
/// that follows a key of the site; else the first one. npos: none.
[[nodiscard]] std::size_t end_of_key(const Site& site, const std::string& words);

/// Sets "section.key" from the command line, e.g. ("solver.duration_s", "30"). The value is TOML,
/// or plain text where the key takes text. Throws InputError as read_site does.
void override_value(Site& site, const std::string& key, const std::string& value);

/// Changes the site as [variant.`name`] says. Throws InputError where it does not exist, where
/// it names an unknown key, changes keys that runs draw, or may not be an alternative.
void apply_variant(Site& site, const std::string& name);
/// Applies each variant to a copy of the site, and looks at the weights. Throws InputError.
void check_variants(const Site& site);

/// A value in effect, as TOML, and where it came from: "default", "file, line 7", "cli", "soil
/// meadow (field test)", "sample 7 of uncertainty.friction".
struct EffectiveValue {
  std::string section, key, value, source;  ///< value is empty when not given
  std::string note = {};                    ///< origin of its value; mostly empty
};
[[nodiscard]] std::vector<EffectiveValue> effective_values(const Site& site);

/// The effective values as TOML, each with a comment that says where it came from; before them the
/// measures, a comment each that begins with `measure_comment`.
inline constexpr const char* measure_comment = "# measure: ";
[[nodiscard]] std::string print_config(const Site& site);

/// Place of a key, for messages of later checks; the file alone when it is not in the file.
[[nodiscard]] Where where_of(const Site& site, const std::string& key);

/// `path` as it is when absolute or virtual, else below the site file's folder.
[[nodiscard]] std::string resolved(const Site& site, const std::string& path);

/// Whether a key names the GeoPackage that sections were taken from: "site.gpkg|layername=fences".
[[nodiscard]] bool names_layers_file(const Site& site, const std::string& name);

/// One row of the table of keys.
struct KeyDescription {
  std::string section, key, type, default_value, range, help;
};
[[nodiscard]] std::vector<KeyDescription> site_keys();

}  // namespace talus
