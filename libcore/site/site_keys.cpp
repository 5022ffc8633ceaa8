// The table of keys of the site file.
#include "site/site_keys.hpp"

#include <cmath>

#include "base/text.hpp"

namespace talus {
namespace {

constexpr KeyRange any{};
constexpr KeyRange positive{0, std::numeric_limits<double>::infinity(), true, false};
constexpr KeyRange not_negative{0};
constexpr KeyRange share{0, 1};
constexpr KeyRange angle_below_90{0, 90, false, true};
constexpr KeyRange azimuth{0, 360};
constexpr KeyRange at_least_1{1};

// clang-format off
constexpr const char* friction_hint = "give degrees; a friction coefficient mu is atan(mu) in degrees";
constexpr const char* dip_hint = "dip is the steepest slope of the plane below the horizontal; dip direction is its azimuth from north";
// clang-format on

}  // namespace

// clang-format off
template <> const std::vector<SiteKey<SiteInfo>>& keys_of() {
  using S = SiteInfo;
  static const std::vector<SiteKey<S>> table = {
      {"name", &S::name, "name of the site"},
      {"crs", &S::crs, "coordinate system of this file, e.g. EPSG:31287"},
      {"description", &S::description, "free text"},
      {"layers", &S::layers, "GeoPackage whose layers stand for sections"}};
  return table;
}
template <> const std::vector<SiteKey<TerrainSettings>>& keys_of() {
  using S = TerrainSettings;
  static const std::vector<SiteKey<S>> table = {
      {"contours", &S::contours, "contour lines"},
      {"elevation_field", &S::elevation_field, "field with the elevation of a contour, or Z: the geometries' own. Of others too: ELEV, spots=FIELD, breaklines=Z"},
      {"breaklines", &S::breaklines, "breaklines"},
      {"spots", &S::spots, "spot heights"},
      {"boundary", &S::boundary, "boundary: polygon or closed line"},
      {"dem", &S::dem, "elevation raster, instead of contours"},
      {"ground_raster", &S::ground_raster, "raster of ground classes, integers; see raster_values of [ground.*]"},
      {"flat", &S::flat, "what happens to flat triangles", any, "fill|keep"},
      {"cell_size_m", &S::cell_size_m, "cell size of the TRN", positive},
      {"window_m", &S::window_m, "xmin, ymin, xmax, ymax of the TRN", any, "", "", 4, 4}};
  return table;
}
template <> const std::vector<SiteKey<SourceSettings>>& keys_of() {
  using S = SourceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "source area", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "source area"},
      {"failure_surface", &S::failure_surface, "how the surface below the mass is given", any, "vertical_depth|normal_depth|plane|daylighting|raster|thickness|slbl"},
      {"sliding_set", &S::sliding_set, "daylighting: joint set whose plane is the failure surface; else that with the largest mass"},
      {"depth_m", &S::depth_m, "depth of the failure surface", positive},
      {"plane_dip_deg", &S::plane_dip_deg, "dip of a failure plane", {0, 90, false, true}, "", dip_hint},
      {"plane_dip_direction_deg", &S::plane_dip_direction_deg, "dip direction of a failure plane", azimuth, "", dip_hint},
      {"plane_point_m", &S::plane_point_m, "x, y, z of a point of the plane", any, "", "", 3, 3},
      {"raster", &S::raster, "elevations of the failure surface; thickness: vertical depths of the mass"},
      {"slbl_curvature_m", &S::slbl_curvature_m, "SLBL: each node goes down to the mean of its highest and lowest neighbour less this (tolerance C); usual choice: slbl_scenario", not_negative},
      {"slbl_sag_m", &S::slbl_sag_m, "SLBL: sag below the line from upper to lower end of the source on any cell size, instead of slbl_curvature_m", not_negative},
      {"slbl_scenario", &S::slbl_scenario, "SLBL: sag none, half of max, or 0.41 of the height of the source, instead of slbl_sag_m", any, "min|inter|max"},
      {"slbl_max_depth_m", &S::slbl_max_depth_m, "SLBL: largest depth", positive},
      {"daylight", &S::daylight, "lifts the failure surface until nothing stands before the mass: along the dip of a joint set, the line of two (\"one + other\"), or a plunge [deg] down the fall line"},
      {"material", &S::material, "material of the cut blocks"},
      {"seed", &S::seed, "seed of joint positions and orientations", not_negative},
      {"max_blocks", &S::max_blocks, "more blocks, or bodies of a section, are refused", {1, 10000000}},
      {"min_block_volume_m3", &S::min_block_volume_m3, "smaller blocks are merged into a neighbour; else 1e-2 of the mean joint cell in the mass", not_negative},
      {"min_block_thickness_m", &S::min_block_thickness_m, "thinner blocks are merged; else 0.05 of the smallest spacing or, if less, the cube root of the mass", not_negative},
      {"min_block_edge_m", &S::min_block_edge_m, "shorter edges of convex blocks are removed, one end stays; default: 1e-3 of the cube root of the volume", not_negative},
      {"max_block_aspect", &S::max_block_aspect, "blocks with a larger ratio of axes are merged", at_least_1},
      {"max_convex_loss", &S::max_convex_loss, "blocks that would lose a larger share if made convex stay a union of convex parts; 1: never", share}};
  return table;
}
template <> const std::vector<SiteKey<JointNorth>>& keys_of() {
  using S = JointNorth;
  static const std::vector<SiteKey<S>> table = {
      {"declination_deg", &S::declination_deg, "magnetic declination, east positive: added to azimuths of [joints.*] but not of a list computed from points", {-180, 180}},
      {"convergence_deg", &S::convergence_deg, "grid convergence, from true to grid north, east positive: subtracted from the same azimuths", {-90, 90}}};
  return table;
}
template <> const std::vector<SiteKey<JointSettings>>& keys_of() {
  using S = JointSettings;
  static const std::vector<SiteKey<S>> table = {
      {"dip_deg", &S::dip_deg, "dip of the set", {0, 90}, "", dip_hint},
      {"dip_direction_deg", &S::dip_direction_deg, "dip direction of the set", azimuth, "", dip_hint},
      {"spacing_m", &S::spacing_m, "mean distance of joints along their normal", positive},
      {"spacing", &S::spacing, "distribution of the spacing", any, "fixed|uniform|exponential|lognormal"},
      {"spacing_min_m", &S::spacing_min_m, "smallest spacing (uniform)", positive},
      {"spacing_max_m", &S::spacing_max_m, "largest spacing (uniform)", positive},
      {"spacing_std_m", &S::spacing_std_m, "standard deviation (lognormal)", positive},
      {"fisher_k", &S::fisher_k, "Fisher concentration of orientations; 0: no scatter", not_negative},
      {"persistence", &S::persistence, "open share of each joint plane; below 1 as discs", {0, 1, true, false}},
      {"disc_diameter_m", &S::disc_diameter_m, "diameter of the discs; default: ten spacings", positive},
      {"offset_m", &S::offset_m, "distance of one joint from the middle of the source, along the normal"},
      {"measured", &S::measured, "measured pairs of dip direction, dip, instead of dip_deg and dip_direction_deg", any, "", "", 1},
      {"measured_file", &S::measured_file, "list of such pairs, or with named columns"},
      {"n_sets", &S::n_sets, "sets that measured pairs are grouped into", {1, 12}},
      {"friction_deg", &S::friction_deg, "friction angle; else that of the material", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength", not_negative},
      {"jrc", &S::jrc, "roughness coefficient of Barton and Bandis, see Rough joints", {0, 20, true, false}},
      {"jcs_mpa", &S::jcs_mpa, "compressive strength of the joint walls, with jrc", {0, 500, true, false}}};
  return table;
}
template <> const std::vector<SiteKey<MaterialSettings>>& keys_of() {
  using S = MaterialSettings;
  static const std::vector<SiteKey<S>> table = {
      {"density_kg_m3", &S::density_kg_m3, "density", {100, 10000}, "", "kilograms per cubic metre: rock is 2000 to 3200"},
      {"young_modulus_pa", &S::young_modulus_pa, "Young's modulus", positive},
      {"poisson_ratio", &S::poisson_ratio, "Poisson's ratio", {0, 0.5, false, true}},
      {"friction_deg", &S::friction_deg, "friction angle between blocks", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion between blocks", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength between blocks", not_negative},
      {"cor", &S::cor, "coefficient of restitution (COR) between blocks", share},
      {"strength_mpa", &S::strength_mpa, "uniaxial compressive strength: small blocks are crushed by the load through them; 0: none is", {0, 1000}, "", "hard rock has 50 to 250 MPa"},
      {"crush_below", &S::crush_below, "only blocks smaller than this share of the median volume are crushed", share}};
  return table;
}
template <> const std::vector<SiteKey<GroundSettings>>& keys_of() {
  using S = GroundSettings;
  static const std::vector<SiteKey<S>> table = {
      {"friction_deg", &S::friction_deg, "friction angle", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength", not_negative},
      {"jrc", &S::jrc, "roughness coefficient of Barton and Bandis, see Rough joints", {0, 20, true, false}},
      {"jcs_mpa", &S::jcs_mpa, "compressive strength of the joint walls, with jrc", {0, 500, true, false}},
      {"cor", &S::cor, "coefficient of restitution (COR) along the normal", share},
      {"soil", &S::soil, "kind of ground, see Soils", any, "rock|thin_soil|talus|scree|meadow|soft_soil|swamp|asphalt"},
      {"cor_half_speed_m_s", &S::cor_half_speed_m_s, "approach at which the COR is half of cor: cor / (1 + speed / this); else constant", positive},
      {"cor_half_energy_kj", &S::cor_half_energy_kj, "energy of that approach, instead of cor_half_speed_m_s", positive},
      {"rolling_resistance", &S::rolling_resistance, "largest couple against rolling over normal force and radius of the block; else none", share},
      {"bearing_kpa", &S::bearing_kpa, "strength of the ground, for resistance by the dent of the block's weight or hit, instead of rolling_resistance", positive},
      {"scar_friction", &S::scar_friction, "tan(phi) that friction grows to as a block slides, from friction_deg", not_negative, "", "a friction coefficient, 2 is steep"},
      {"scar_rate_1_m", &S::scar_rate_1_m, "growth per metre slid", positive},
      {"scar_decay_1_s", &S::scar_decay_1_s, "decay of the slid distance while off the ground", positive},
      {"drag_1_s", &S::drag_1_s, "drag on a block in contact, per time", not_negative},
      {"drag_1_m", &S::drag_1_m, "drag on a block in contact, per metre of its path", not_negative},
      {"friction_weak_deg", &S::friction_weak_deg, "friction angle at high speed; friction_deg: at rest", angle_below_90, "", friction_hint},
      {"weakening_speed_m_s", &S::weakening_speed_m_s, "slip speed at which friction is halfway between the two", positive},
      {"polygon", &S::polygon, "area", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "area"},
      {"raster_values", &S::raster_values, "values of this ground in ground_raster of [terrain]", any, "", "whole numbers, as the raster has them", 1}};
  return table;
}
template <> const std::vector<SiteKey<SolverSettings>>& keys_of() {
  using S = SolverSettings;
  static const std::vector<SiteKey<S>> table = {
      {"law", &S::law, "contact law", any, "talus|paper"},
      {"blocks", &S::blocks, "blocks move together, or each alone among fences and trees that nothing has hit; auto: alone if there is [rockfall.*]", any, "auto|together|alone"},
      {"friction", &S::friction, "given by sections, or see Weakening friction", any, "given|weakening"},
      {"duration_s", &S::duration_s, "time simulated", positive},
      {"time_step_s", &S::time_step_s, "time step, which law talus cuts where it must; else 0.005, law paper 0.0001", {0, 1, true, false}},
      {"accuracy", &S::accuracy, "law talus cuts steps whose estimated error is a larger share of a block's displacement", {0, 1, true, false}},
      {"gravity_m_s2", &S::gravity_m_s2, "gravity, downwards", {0, 1000}},
      {"normal_stiffness_n_m", &S::normal_stiffness_n_m, "penalty stiffness of a contact", positive},
      {"strain", &S::strain, "strain degrees of freedom; on: also in frames", any, "auto|on|off"},
      {"end_when_standing", &S::end_when_standing, "ends a run if after 3 s no block moved more than 0.1 m or is faster than 2 mm/s"},
      {"seed", &S::seed, "seed of the run", not_negative},
      {"n_runs", &S::n_runs, "runs with seeds counted up; with [rockfall.*] else 10", {1, 1000000}},
      {"start_jitter_m_s", &S::start_jitter_m_s, "random velocity at the start", {0, 1000}},
      {"friction_scatter_deg", &S::friction_scatter_deg, "standard deviation of the ground's friction between runs", {0, 45}},
      {"cor_scatter", &S::cor_scatter, "standard deviation of its COR between runs", share},
      {"max_penetration_m", &S::max_penetration_m, "deeper overlaps fail the run", positive},
      {"max_energy_gain", &S::max_energy_gain, "share of the fall energy; a larger gain fails the run", not_negative},
      {"max_lost_share", &S::max_lost_share, "share of the mass; if more leaves the terrain, a run fails; with [rockfall.*] else 1", share},
      {"max_unconverged_share", &S::max_unconverged_share, "share of steps that may be accepted unconverged", share}};
  return table;
}
template <> const std::vector<SiteKey<FenceSettings>>& keys_of() {
  using S = FenceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"line", &S::line, "points of the fence", any, "", "a fence needs two points", 2},
      {"file", &S::file, "file with the line, instead"},
      {"height_m", &S::height_m, "height above the ground", {0, 1000, true, false}},
      {"capacity_kj", &S::capacity_kj, "energy that a panel takes before it breaks; else rigid", positive},
      {"max_deflection_m", &S::max_deflection_m, "deflection at which one block has used up the capacity; else half the height", positive},
      {"post_spacing_m", &S::post_spacing_m, "distance of posts", positive},
      {"active", &S::active, "whether it is in place"},
      {"cor", &S::cor, "coefficient of restitution of a rigid fence", share},
      {"friction_deg", &S::friction_deg, "friction angle", angle_below_90, "", friction_hint}};
  return table;
}
template <> const std::vector<SiteKey<DamSettings>>& keys_of() {
  using S = DamSettings;
  static const std::vector<SiteKey<S>> table = {
      {"kind", &S::kind, "dam of earth, or gallery: the crest is its roof, the sides are vertical", any, "dam|gallery"},
      {"line", &S::line, "middle of the crest", any, "", "a dam needs two points", 2},
      {"file", &S::file, "file with the line, instead"},
      {"height_m", &S::height_m, "height of the crest above the ground at each point of the line; straight between", {0, 100, true, false}},
      {"crest_width_m", &S::crest_width_m, "width of the crest", {0, 100, true, false}},
      {"slopes_deg", &S::slopes_deg, "slopes of the uphill and the downhill face", {0, 90, true, true}, "", "", 2, 2},
      {"ditch_m", &S::ditch_m, "depth of a ditch below the foot of the uphill face, width of its bottom; far side as steep as the downhill face", positive, "", "", 2, 2},
      {"capacity_kj", &S::capacity_kj, "energy of a block that the dam is designed for", positive},
      {"active", &S::active, "whether it is built"}};
  return table;
}
template <> const std::vector<SiteKey<ForestSettings>>& keys_of() {
  using S = ForestSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "stand", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "stand"},
      {"stems_per_ha", &S::stems_per_ha, "stems on a hectare, at random places", {0, 100000}},
      {"dbh_mean_cm", &S::dbh_mean_cm, "mean diameter at breast height", {0, 1000, true, false}},
      {"dbh_std_cm", &S::dbh_std_cm, "its standard deviation (gamma distribution)", {0, 1000}},
      {"conifer_share", &S::conifer_share, "share of conifers", share},
      {"nrtrees_raster", &S::nrtrees_raster, "stems on a hectare, instead of stems_per_ha"},
      {"dbhmean_raster", &S::dbhmean_raster, "mean diameters [cm], on the same cells"},
      {"dbhstd_raster", &S::dbhstd_raster, "their standard deviations [cm]"},
      {"conif_percent_raster", &S::conif_percent_raster, "percentage of conifers"},
      {"stems_file", &S::stems_file, "stems instead of a stand: points with dbh_cm, and species or conifer (1 or 0) where known"},
      {"height_m", &S::height_m, "height to which stems stop blocks or the canopy drags them", {0, 1000, true, false}},
      {"friction_deg", &S::friction_deg, "friction angle between block and stem", angle_below_90, "", friction_hint},
      {"drag_kg_s", &S::drag_kg_s, "viscous drag below height_m, instead of stems: 250 open, 500 medium, 750 dense forest", {0, 100000}},
      {"seed", &S::seed, "seed of the stand", not_negative},
      {"new_stand_per_run", &S::new_stand_per_run, "each [solver] seed draws a stand of its own"},
      {"active", &S::active, "whether it is in place"}};
  return table;
}
template <> const std::vector<SiteKey<OutputSettings>>& keys_of() {
  using S = OutputSettings;
  static const std::vector<SiteKey<S>> table = {
      {"frame_interval_s", &S::frame_interval_s, "simulated time between frames", positive},
      {"checkpoint_interval_s", &S::checkpoint_interval_s, "wall time between checkpoints", positive},
      {"cell_size_m", &S::cell_size_m, "cell size of maps; else that of the TRN", positive},
      {"passages", &S::passages, "record passages of cells"},
      {"frames", &S::frames, "keep all frames of a run that has ended, or the first and the last"},
      {"whole_share", &S::whole_share, "share of runs, evenly over their seeds, that keep all frames nevertheless", share}};
  return table;
}
template <> const std::vector<SiteKey<BaseMotionSettings>>& keys_of() {
  using S = BaseMotionSettings;
  static const std::vector<SiteKey<S>> table = {
      {"file", &S::file, "CSV with columns time_s, ax_m_s2, ay_m_s2, az_m_s2"},
      {"scale", &S::scale, "factor on the accelerations"},
      {"amplitude_m_s2", &S::amplitude_m_s2, "amplitude of a harmonic motion", {0, 1000}},
      {"frequency_hz", &S::frequency_hz, "frequency of a harmonic motion", positive},
      {"start_s", &S::start_s, "when it starts", not_negative},
      {"duration_s", &S::duration_s, "how long it lasts", positive},
      {"direction_deg", &S::direction_deg, "azimuth of a harmonic motion", azimuth}};
  return table;
}
template <> const std::vector<SiteKey<WaterSettings>>& keys_of() {
  using S = WaterSettings;
  static const std::vector<SiteKey<S>> table = {
      {"surface_m", &S::surface_m, "piezometric surface: x, y, z of one point of a level, or of three of a plane", any, "", "", 1, 3},
      {"raster", &S::raster, "its elevations, instead; unknown: no water"},
      {"depth_m", &S::depth_m, "its depth below the surface of the mass, instead", not_negative},
      {"cracks", &S::cracks, "joint sets that are open cracks, whatever the piezometric surface; source_side: the walls along the outline of the source", any, "", "", 1},
      {"crack_fill_m", &S::crack_fill_m, "height of the water above the lowest point of each crack, at most to its top", not_negative},
      {"drained", &S::drained, "joint sets without water; also source_side", any, "", "", 1},
      {"drained_at_m", &S::drained_at_m, "opening of a face at which its pressure is gone, falling linearly; 0: at once; larger than any face: kept", not_negative}};
  return table;
}
template <> const std::vector<SiteKey<FragmentationSettings>>& keys_of() {
  using S = FragmentationSettings;
  static const std::vector<SiteKey<S>> table = {
      {"enabled", &S::enabled, "blocks break in two when hit hard, and their pieces again (law talus)"},
      {"splitting", &S::splitting, "planes of breaking: of any direction, or parallel to joint sets", any, "random|joints"},
      {"energy_j_m2", &S::energy_j_m2, "effective work of fracture, all losses included", positive},
      {"spread", &S::spread, "exponent k of the chance to break, 1 - 2^-(energy of the hit / work)^k", {0, 1000, true, false}},
      {"separation_share", &S::separation_share, "share of the energy that the hit took that drives the pieces apart", share},
      {"min_volume_m3", &S::min_volume_m3, "no piece is smaller", positive},
      {"max_generation", &S::max_generation, "breaks, one after the other", {1, 12}},
      {"seed", &S::seed, "seed of planes and of what breaks", not_negative}};
  return table;
}
template <class S>
std::vector<SiteKey<S>> body_keys(const char* shapes) {
  return {
      {"file", &S::file, "mesh: OBJ, PLY, OFF or STL, closed bodies"},
      {"shape", &S::shape, "shape, instead of a mesh; eota111, 211, 221: of these proportions", any, shapes},
      {"size_m", &S::size_m, "box, rock, eota: extents x, y, z; eota111, 211, 221: the longest; prism: diameter, length along y; one number: of all", positive, "", "", 1, 3},
      {"volume_m3", &S::volume_m3, "volume that the body is scaled to", positive},
      {"n_points", &S::n_points, "points of a rock", {4, 500}},
      {"material", &S::material, "material of the bodies"},
      {"position_m", &S::position_m, "x, y or x, y, z of each body; a mesh of [blocks.*] without it has map coordinates", any, "", "", 1},
      {"height_above_ground_m", &S::height_above_ground_m, "height of the lowest vertex above the ground", {0, 100000}},
      {"velocity_m_s", &S::velocity_m_s, "initial velocity x, y, z", any, "", "", 3, 3},
      {"spin_rad_s", &S::spin_rad_s, "initial spin x, y, z", any, "", "", 3, 3},
      {"seed", &S::seed, "seed of shapes, sizes, orientations", not_negative}};
}
template <class S>
std::vector<SiteKey<S>> with_body_keys(const char* shapes, std::vector<SiteKey<S>> own) {
  std::vector<SiteKey<S>> table = body_keys<S>(shapes);
  table.insert(table.end(), own.begin(), own.end());
  return table;
}
template <> const std::vector<SiteKey<PlacedSettings>>& keys_of() {
  using S = PlacedSettings;
  static const std::vector<SiteKey<S>> table = with_body_keys<S>("box|prism|eota|eota111|eota211|eota221|rock", {
      {"scale", &S::scale, "factor on the mesh", positive},
      {"yaw_deg", &S::yaw_deg, "rotation about z, applied last", {-360, 360}},
      {"pitch_deg", &S::pitch_deg, "rotation about y", {-360, 360}},
      {"roll_deg", &S::roll_deg, "rotation about x, applied first", {-360, 360}},
      {"random_orientation", &S::random_orientation, "each body is turned at random, uniformly"}});
  return table;
}
template <> const std::vector<SiteKey<RockfallSettings>>& keys_of() {
  using S = RockfallSettings;
  static const std::vector<SiteKey<S>> table = with_body_keys<S>("box|prism|eota|eota111|eota211|eota221|rock|joint_cell", {
      {"rocks", &S::rocks, "rocks that each place releases in a run, others in another", {1, 100000}},
      {"release_file", &S::release_file, "release points, or lines with release_spacing_m"},
      {"polygon", &S::polygon, "area that rocks are released all over", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "such areas"},
      {"release_spacing_m", &S::release_spacing_m, "spacing along release lines; in areas over the sloping ground, else a cell of the TRN", positive},
      {"min_slope_deg", &S::min_slope_deg, "flatter ground of areas, or without a place of all the terrain, releases no rocks", angle_below_90},
      {"rockdensity_raster", &S::rockdensity_raster, "source cells as of Rockyfor3D: density of the rock [kg/m3], 0 elsewhere"},
      {"d1_raster", &S::d1_raster, "extents of the rocks [m]"},
      {"d2_raster", &S::d2_raster, "extents of the rocks [m]"},
      {"d3_raster", &S::d3_raster, "extents of the rocks [m]"},
      {"blshape_raster", &S::blshape_raster, "shapes as of Rockyfor3D: 1 box, 2 ellipsoid, 3 sphere, 4 disc"},
      {"volumes_m3", &S::volumes_m3, "volumes that each rock's is drawn from, all alike", positive, "", "", 1},
      {"volume_max_m3", &S::volume_max_m3, "volumes are drawn from volume_m3 to this, by a power law", positive},
      {"volume_exponent", &S::volume_exponent, "its exponent: number of larger rocks ~ volume^-exponent", {0, 5}},
      {"height_scatter_m", &S::height_scatter_m, "rocks start evenly up to so much higher", {0, 1000}},
      {"velocity_scatter_m_s", &S::velocity_scatter_m_s, "standard deviation of each part of velocity_m_s", {0, 100}},
      {"spin_scatter_rad_s", &S::spin_scatter_rad_s, "standard deviation of each part of spin_rad_s", {0, 100}},
      {"frequency_per_a", &S::frequency_per_a, "rocks a year of the whole source, shared by its bodies as weights", positive},
      {"frequency_per_m2_a", &S::frequency_per_m2_a, "rocks a year and m2 of the sloping ground of areas, instead", positive}});
  return table;
}
template <> const std::vector<SiteKey<ObjectSettings>>& keys_of() {
  using S = ObjectSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "outline of an area", any, "", "an area needs three points", 3},
      {"line", &S::line, "points of a line", any, "", "a line needs two points", 2},
      {"position_m", &S::position_m, "points", any, "", "", 1},
      {"file", &S::file, "file of areas, lines (width_m) or points (radius_m), instead"},
      {"width_m", &S::width_m, "width of lines", positive},
      {"radius_m", &S::radius_m, "radius about points", positive},
      {"kind", &S::kind, "what it is, e.g. house, road"},
      {"presence", &S::presence, "share of the time that the one most at risk is where rocks hit; with the next two, for recipes of risk", {0, 1, true, false}},
      {"vulnerability", &S::vulnerability, "probability of death if hit, one for each intensity of the recipe, from the weakest", share, "", "", 1},
      {"persons_per_day", &S::persons_per_day, "persons, also in vehicles, that are there so long in a day", positive}};
  return table;
}
template <> const std::vector<SiteKey<FenceSearchSettings>>& keys_of() {
  using S = FenceSearchSettings;
  static const std::vector<SiteKey<S>> table = {
      {"protect", &S::protect, "the [object.*] that the fence is for"},
      {"between_m", &S::between_m, "least and largest distance from the object, in plan", not_negative, "", "", 2, 2},
      {"step_m", &S::step_m, "from one candidate line to the next: in plan (offset), in height (contour)", positive},
      {"style", &S::style, "candidate lines: contours of the ground, or at equal distance to the object", any, "contour|offset"},
      {"max_candidates", &S::max_candidates, "with more lines, the step grows", {1, 500}},
      {"share", &S::share, "of the hits on the object, to be stopped", {0, 1, true, false}},
      {"heights_m", &S::heights_m, "heights that can be built, ascending", positive, "", "", 1},
      {"classes_kj", &S::classes_kj, "energies that a field can take, ascending; else those of share/codes/barrier_classes.csv", positive, "", "", 1},
      {"prices_per_m", &S::prices_per_m, "price of a metre, by class; else 1 + 0.2 k for class k from 0", positive, "", "", 1},
      {"price_per_m2", &S::price_per_m2, "added for a metre of fence and of height; else 0 with prices_per_m, 0.1 without", not_negative},
      {"code", &S::code, "design code: uni, onr, or a data file"},
      {"post_spacing_m", &S::post_spacing_m, "distance of posts", positive},
      {"min_fields", &S::min_fields, "fewest fields of a fence", {1, 100}},
      {"end_fields", &S::end_fields, "fields added at each end, beyond what is to be stopped", {0, 10}},
      {"max_length_m", &S::max_length_m, "longest fence; else no limit", positive},
      {"max_line_slope_deg", &S::max_line_slope_deg, "steepest slope along a fence", {0, 90, true, false}},
      {"max_ground_slope_deg", &S::max_ground_slope_deg, "steepest ground that it can stand on", {0, 90, true, false}},
      {"two_fences", &S::two_fences, "also look for pairs: two rows, or side by side"}};
  return table;
}
template <> const std::vector<SiteKey<HazardSettings>>& keys_of() {
  using S = HazardSettings;
  static const std::vector<SiteKey<S>> table = {
      {"recipe", &S::recipe, "how classes are made: a name of share/hazard, or a file like those"},
      {"author", &S::author, "person and office that answer for the map; with the next two it is written to be filed"},
      {"date", &S::date, "day of the assessment, YYYY-MM-DD"},
      {"namespace", &S::name_space, "of the filed identifiers: that of a canton (ti.ch) by the Swiss model, others by INSPIRE"}};
  return table;
}
template <> const std::vector<SiteKey<HazardClassSettings>>& keys_of() {
  using S = HazardClassSettings;
  static const std::vector<SiteKey<S>> table = {
      {"frequency_per_a", &S::frequency_per_a, "events a year; of rocks that move alone, also of one block a run, rocks a year of the whole class; else those of [rockfall.*]", positive},
      {"events", &S::events, "events that were counted, instead", not_negative},
      {"observed_a", &S::observed_a, "in so many years", positive},
      {"failure_probability", &S::failure_probability, "instead: that the mass fails, once", {0, 1, true, false}},
      {"in_years", &S::in_years, "within so many years", positive}};
  return table;
}
template <> const std::vector<SiteKey<UncertaintySettings>>& keys_of() {
  using S = UncertaintySettings;
  static const std::vector<SiteKey<S>> table = {
      {"sampling", &S::sampling, "sobol: more runs continue the sequence; hypercube: needs n_samples", any, "sobol|hypercube|random"},
      {"seed", &S::seed, "seed of the draws", not_negative},
      {"n_samples", &S::n_samples, "samples of a hypercube, which has no others", {0, 1e7}},
      {"sample", &S::sample, "sample of this run, from 1; 0: nothing is drawn. The pipeline sets that of the seed", {0, 4e9}},
      {"rock_masses", &S::rock_masses, "sets of blocks, each with its own joints; runs take them in turn. 0: one, by this file; with [rockfall.*] else one a run", {0, 1000000}},
      {"terrain_rmse_m", &S::terrain_rmse_m, "root-mean-square error of elevations: each rock mass gets a ground of its own", {0, 1000}},
      {"terrain_correlation_m", &S::terrain_correlation_m, "distance over which these errors are alike; else 10 cells", positive},
      {"max_failed_share", &S::max_failed_share, "share of runs that may fail: they are left out and widen intervals", share},
      {"file", &S::file, "site file (e.g. of talus-calibrate) whose [uncertainty.NAME] replace these"}};
  return table;
}
template <> const std::vector<SiteKey<QuantitySettings>>& keys_of() {
  using S = QuantitySettings;
  static const std::vector<SiteKey<S>> table = {
      {"keys", &S::keys, "keys that are drawn, several together; fisher: joints.NAME.orientation", any, "", "e.g. keys = [\"ground.slope.friction_deg\"]", 1},
      {"apply", &S::apply, "what is drawn replaces the value, is added to it, or is a factor on it", any, "set|add|factor"},
      {"distribution", &S::distribution, "what it is drawn from", any, "normal|lognormal|uniform|triangular|discrete|rows|fisher"},
      {"mean", &S::mean, "normal, lognormal: mean; else the key's own value (add: 0, factor: 1)"},
      {"std", &S::std, "normal, lognormal: standard deviation of the value itself", positive},
      {"min", &S::min, "uniform, triangular: smallest value"},
      {"mode", &S::mode, "triangular: most likely value"},
      {"max", &S::max, "uniform, triangular: largest value"},
      {"values", &S::values, "discrete: values; rows: sets of values in turn, each with a value for every key", any, "", "", 1},
      {"weights", &S::weights, "their weights; else all alike", not_negative, "", "", 1},
      {"truncate", &S::truncate, "normal, lognormal: lowest and highest value, the rest is scaled up; else what the keys may hold, at most 1 % outside of it", any, "", "", 2, 2},
      {"n_measured", &S::n_measured, "fisher: the orientation is the mean of so many measured ones, which scatter by fisher_k of the set", {0, 1000000}},
      {"fisher_k", &S::fisher_k, "fisher: concentration of the mean orientation, instead of n_measured", positive},
      {"source", &S::source, "where these numbers come from"}};
  return table;
}
template <> const std::vector<SiteKey<ObservedSettings>>& keys_of() {
  using S = ObservedSettings;
  static const std::vector<SiteKey<S>> table = {
      {"boulders_file", &S::boulders_file, "boulders: points, with volume_m3 and date where known"},
      {"scars_file", &S::scars_file, "scars of trees and other witnesses: points with height_m above the ground, and date where known"},
      {"outline_file", &S::outline_file, "outline of the deposit: polygons or closed lines"}};
  return table;
}
template <> const std::vector<SiteKey<PlaceSettings>>& keys_of() {
  using S = PlaceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "place", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "place"},
      {"fence", &S::fence, "the line of this fence instead of a polygon"},
      {"half_width", &S::half_width, "wanted half of the 95 % interval of the share of blocks that reach the place, for make RUNS=auto", {0, 0.5, true, false}}};
  return table;
}
template <> const std::vector<SiteKey<VariantSettings>>& keys_of() {
  using S = VariantSettings;
  static const std::vector<SiteKey<S>> table = {
      {"weight", &S::weight, "weight among the alternatives; else a measure", positive},
      {"cost", &S::cost, "of the measure, in any currency", not_negative},
      {"without", &S::without, "sections of the site that it lacks, e.g. [\"fence.valley\", \"forest.wood\"]"}};
  return table;
}
// clang-format on

namespace {

template <class FieldType>
std::vector<SectionOf<FieldType>> sections_of(auto& site) {
  std::vector<SectionOf<FieldType>> found;
  for_each_group(site, [&found](const char* group, auto& sections) {
    if constexpr (requires { sections.front(); })
      for (auto& section : sections) found.push_back({group, section.name, keys_in(section)});
    else
      found.push_back({group, "", keys_in(sections)});
  });
  return found;
}

}  // namespace

std::vector<SectionOf<Field>> sections_in(Site& site) { return sections_of<Field>(site); }
std::vector<SectionOf<ConstField>> sections_in(const Site& site) {
  return sections_of<ConstField>(site);
}

std::string text_of(const KeyRange& range) {
  const bool has_low = std::isfinite(range.low), has_high = std::isfinite(range.high);
  if (has_low && has_high)
    return (range.open_low ? "above " : "") + text(range.low) + " to " +
           (range.open_high ? "below " : "") + text(range.high);
  if (has_low) return range.open_low ? "above " + text(range.low) : "at least " + text(range.low);
  return "a finite number";
}

bool contains(const KeyRange& range, double value) {
  const bool above = range.open_low ? value > range.low : value >= range.low;
  const bool below = range.open_high ? value < range.high : value <= range.high;
  return std::isfinite(value) && above && below;
}

}  // namespace talus
