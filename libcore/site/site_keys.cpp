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
      {"crs", &S::crs, "coordinate system of the coordinates in this file, e.g. EPSG:31287"},
      {"description", &S::description, "free text"},
      {"layers", &S::layers, "GeoPackage whose layers stand for sections: source, fences, grounds, objects, forest, release points, places, observations"}};
  return table;
}
template <> const std::vector<SiteKey<TerrainSettings>>& keys_of() {
  using S = TerrainSettings;
  static const std::vector<SiteKey<S>> table = {
      {"contours", &S::contours, "contour lines for talus-import"},
      {"elevation_field", &S::elevation_field, "field with the elevation of a contour; Z: the geometries' own. Of others too: ELEV, spots=FIELD, breaklines=Z"},
      {"breaklines", &S::breaklines, "breaklines for talus-import"},
      {"spots", &S::spots, "spot heights for talus-import"},
      {"boundary", &S::boundary, "boundary polygon, or closed line, for talus-import"},
      {"dem", &S::dem, "elevation raster for talus-trn instead of contours"},
      {"ground_raster", &S::ground_raster, "raster of ground classes, whole numbers; [ground.*] raster_values says which is which"},
      {"flat", &S::flat, "what happens to flat triangles", any, "fill|keep"},
      {"cell_size_m", &S::cell_size_m, "cell size of the TRN", positive},
      {"window_m", &S::window_m, "xmin, ymin, xmax, ymax of the TRN, map coordinates", any, "", "", 4, 4}};
  return table;
}
template <> const std::vector<SiteKey<SourceSettings>>& keys_of() {
  using S = SourceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "corners of the source area, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the source area: polygons, or closed lines"},
      {"failure_surface", &S::failure_surface, "how the surface below the mass is given", any, "vertical_depth|normal_depth|plane|daylighting|raster|thickness|slbl"},
      {"sliding_set", &S::sliding_set, "daylighting: the joint set whose plane is the failure surface; the one with the largest mass when not given"},
      {"depth_m", &S::depth_m, "depth of the failure surface", positive},
      {"plane_dip_deg", &S::plane_dip_deg, "dip of a failure plane", {0, 90, false, true}, "", dip_hint},
      {"plane_dip_direction_deg", &S::plane_dip_direction_deg, "dip direction of a failure plane", azimuth, "", dip_hint},
      {"plane_point_m", &S::plane_point_m, "map x, y, z of a point of the plane", any, "", "", 3, 3},
      {"raster", &S::raster, "elevations of the failure surface; thickness: depths of the mass below the ground, upright"},
      {"slbl_curvature_m", &S::slbl_curvature_m, "SLBL: tolerance C (curvature): each node goes down to the mean of its highest and lowest neighbour less C; 0: no curvature; usual choice: slbl_scenario", not_negative},
      {"slbl_sag_m", &S::slbl_sag_m, "SLBL: how far the surface sags below the line from the upper to the lower end of the source, instead of slbl_curvature_m; the same on every cell size", not_negative},
      {"slbl_scenario", &S::slbl_scenario, "SLBL: min (no sag), max (0.41 of the height of the source) or inter (half of that), instead of slbl_sag_m", any, "min|inter|max"},
      {"slbl_max_depth_m", &S::slbl_max_depth_m, "SLBL: largest depth", positive},
      {"daylight", &S::daylight, "lifts the failure surface until nothing stands before the mass: along the dip of a joint set (its name), the line of two (\"one + other\"), or a plunge in degrees down the fall line"},
      {"material", &S::material, "material of the cut blocks"},
      {"seed", &S::seed, "seed of joint positions and orientations", not_negative},
      {"max_blocks", &S::max_blocks, "more expected blocks than this are refused before cutting, more bodies of a [blocks.*] or [rockfall.*] before placing", {1, 10000000}},
      {"min_block_volume_m3", &S::min_block_volume_m3, "smaller blocks are merged into a neighbour; not given: 1e-2 of the mean joint cell in the mass", not_negative},
      {"min_block_thickness_m", &S::min_block_thickness_m, "thinner blocks are merged into a neighbour; not given: 0.05 of the smallest spacing, or of the cube root of the mass if that is less", not_negative},
      {"min_block_edge_m", &S::min_block_edge_m, "shorter edges of convex blocks are removed, one of their ends stays", not_negative},
      {"max_block_aspect", &S::max_block_aspect, "blocks with a larger ratio of longest to shortest axis are merged into a neighbour", at_least_1},
      {"max_convex_loss", &S::max_convex_loss, "blocks that would lose a larger share by being made convex stay a union of convex parts; 1: never", share}};
  return table;
}
template <> const std::vector<SiteKey<JointNorth>>& keys_of() {
  using S = JointNorth;
  static const std::vector<SiteKey<S>> table = {
      {"declination_deg", &S::declination_deg, "magnetic declination, east positive: added to the azimuths of [joints.*], but not to those of a list that was computed from points", {-180, 180}},
      {"convergence_deg", &S::convergence_deg, "grid convergence, from true north to grid north, east positive: taken off the same azimuths", {-90, 90}}};
  return table;
}
template <> const std::vector<SiteKey<JointSettings>>& keys_of() {
  using S = JointSettings;
  static const std::vector<SiteKey<S>> table = {
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
      {"measured_file", &S::measured_file, "list of measured orientations: columns by name, or pairs of dip direction, dip [deg]"},
      {"n_sets", &S::n_sets, "number of sets that measured pairs are grouped into", {1, 12}},
      {"friction_deg", &S::friction_deg, "friction angle of the joints; that of the material when not given", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion of the joints", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength of the joints", not_negative},
      {"jrc", &S::jrc, "roughness coefficient of Barton and Bandis: friction_deg is the residual angle, and friction grows as the normal stress falls", {0, 20, true, false}},
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
      {"cor", &S::cor, "coefficient of restitution between blocks", share},
      {"strength_mpa", &S::strength_mpa, "uniaxial compressive strength of the rock: small blocks are crushed by what is pressed through them; 0: none is", {0, 1000}, "", "hard rock has 50 to 250 MPa"},
      {"crush_below", &S::crush_below, "only blocks smaller than this share of the median volume are crushed", share}};
  return table;
}
template <> const std::vector<SiteKey<GroundSettings>>& keys_of() {
  using S = GroundSettings;
  static const std::vector<SiteKey<S>> table = {
      {"friction_deg", &S::friction_deg, "friction angle on the ground", angle_below_90, "", friction_hint},
      {"cohesion_pa", &S::cohesion_pa, "cohesion on the ground", not_negative},
      {"tension_pa", &S::tension_pa, "tensile strength on the ground", not_negative},
      {"jrc", &S::jrc, "roughness coefficient of Barton and Bandis: friction_deg is the residual angle, and friction grows as the normal stress falls", {0, 20, true, false}},
      {"jcs_mpa", &S::jcs_mpa, "compressive strength of the joint walls, with jrc", {0, 500, true, false}},
      {"cor", &S::cor, "coefficient of restitution along the normal", share},
      {"soil", &S::soil, "kind of ground that fills keys which are not given, see Soils", any, "rock|thin_soil|talus|scree|meadow|soft_soil|swamp|asphalt"},
      {"cor_half_speed_m_s", &S::cor_half_speed_m_s, "approach at which the COR is half of cor, cor / (1 + speed / this); constant when not given", positive},
      {"cor_half_energy_kj", &S::cor_half_energy_kj, "energy of the approach at which the COR is half of cor, instead of cor_half_speed_m_s", positive},
      {"rolling_resistance", &S::rolling_resistance, "largest couple against rolling over normal force and radius of the block; none when not given", share},
      {"bearing_kpa", &S::bearing_kpa, "strength of the ground that gives the rolling resistance by the dent of the block's weight or hit, instead of rolling_resistance", positive},
      {"scar_friction", &S::scar_friction, "tan(phi) that friction grows to as a block slides, from that of friction_deg", not_negative, "", "a friction coefficient, 2 is steep"},
      {"scar_rate_1_m", &S::scar_rate_1_m, "growth per metre slid", positive},
      {"scar_decay_1_s", &S::scar_decay_1_s, "decay of the slid distance while off the ground", positive},
      {"drag_1_s", &S::drag_1_s, "drag on a block in contact with the ground, per time", not_negative},
      {"drag_1_m", &S::drag_1_m, "drag on a block in contact with the ground, per metre of its path", not_negative},
      {"friction_weak_deg", &S::friction_weak_deg, "friction angle at high speed; friction_deg is that at rest", angle_below_90, "", friction_hint},
      {"weakening_speed_m_s", &S::weakening_speed_m_s, "slip speed at which friction is halfway from friction_deg to friction_weak_deg", positive},
      {"polygon", &S::polygon, "corners of the area, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the area: polygons, or closed lines"},
      {"raster_values", &S::raster_values, "values of [terrain] ground_raster that stand for this ground", any, "", "whole numbers, as the raster has them", 1}};
  return table;
}
template <> const std::vector<SiteKey<SolverSettings>>& keys_of() {
  using S = SolverSettings;
  static const std::vector<SiteKey<S>> table = {
      {"law", &S::law, "contact law", any, "talus|paper"},
      {"blocks", &S::blocks, "how blocks move: together, or each alone among fences and trees that nothing has hit; auto: alone where the site has [rockfall.*]", any, "auto|together|alone"},
      {"friction", &S::friction, "of all ground and between all blocks: given, by its sections; weakening, falling with the speed of slip, see Weakening friction", any, "given|weakening"},
      {"duration_s", &S::duration_s, "time simulated", positive},
      {"time_step_s", &S::time_step_s, "time step, which law talus cuts where it must; not given: 0.005, law paper 0.0001", {0, 1, true, false}},
      {"accuracy", &S::accuracy, "law talus: estimated error of a moving block's displacement, as a share of it; a step whose estimate is larger is cut", {0, 1, true, false}},
      {"gravity_m_s2", &S::gravity_m_s2, "gravity, downwards", {0, 1000}},
      {"normal_stiffness_n_m", &S::normal_stiffness_n_m, "penalty stiffness of a contact", positive},
      {"strain", &S::strain, "strain degrees of freedom; on: recorded in frames, too", any, "auto|on|off"},
      {"end_when_standing", &S::end_when_standing, "a run in which no block moved more than 0.1 m or is faster than 2 mm/s after 3 s ends there, and says so"},
      {"seed", &S::seed, "seed of the run", not_negative},
      {"n_runs", &S::n_runs, "runs with seeds counted up. Of [rockfall.*] 10 when not given", {1, 1000000}},
      {"start_jitter_m_s", &S::start_jitter_m_s, "random velocity at the start", {0, 1000}},
      {"friction_scatter_deg", &S::friction_scatter_deg, "standard deviation of the ground's friction between runs", {0, 45}},
      {"cor_scatter", &S::cor_scatter, "standard deviation of the ground's restitution between runs", share},
      {"max_penetration_m", &S::max_penetration_m, "deeper makes the run fail", positive},
      {"max_energy_gain", &S::max_energy_gain, "share of the fall energy; more makes the run fail", not_negative},
      {"max_lost_share", &S::max_lost_share, "share of the mass that may leave the terrain; more makes the run fail. Of [rockfall.*] 1 when not given", share},
      {"max_unconverged_share", &S::max_unconverged_share, "share of the steps that may be accepted unconverged", share}};
  return table;
}
template <> const std::vector<SiteKey<FenceSettings>>& keys_of() {
  using S = FenceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"line", &S::line, "points of the fence, map x, y", any, "", "a fence needs two points", 2},
      {"file", &S::file, "vector file with the fence line, instead of line"},
      {"height_m", &S::height_m, "height above the ground", {0, 1000, true, false}},
      {"capacity_kj", &S::capacity_kj, "energy that a panel takes before it breaks; rigid when not given", positive},
      {"max_deflection_m", &S::max_deflection_m, "deflection at which one block has used up the capacity; half the height when not given", positive},
      {"post_spacing_m", &S::post_spacing_m, "distance of posts", positive},
      {"active", &S::active, "whether it stands in the run"},
      {"cor", &S::cor, "coefficient of restitution of a rigid fence", share},
      {"friction_deg", &S::friction_deg, "friction angle", angle_below_90, "", friction_hint}};
  return table;
}
template <> const std::vector<SiteKey<DamSettings>>& keys_of() {
  using S = DamSettings;
  static const std::vector<SiteKey<S>> table = {
      {"line", &S::line, "middle of the crest, map x, y", any, "", "a dam needs two points", 2},
      {"file", &S::file, "vector file with the line, instead of line"},
      {"height_m", &S::height_m, "height of the crest above the ground at each point of the line; straight between them", {0, 100, true, false}},
      {"crest_width_m", &S::crest_width_m, "width of the crest", {0, 100, true, false}},
      {"slopes_deg", &S::slopes_deg, "slopes of the uphill and of the downhill face", {0, 90, true, true}, "", "", 2, 2},
      {"ditch_m", &S::ditch_m, "depth of a ditch below the foot of the uphill face, and width of its bottom; its far side rises as the downhill face falls", positive, "", "", 2, 2},
      {"capacity_kj", &S::capacity_kj, "energy of a block that the dam is designed for", positive},
      {"active", &S::active, "whether it is built"}};
  return table;
}
template <> const std::vector<SiteKey<ForestSettings>>& keys_of() {
  using S = ForestSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "corners of the stand, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the stand, instead of polygon: polygons, or closed lines"},
      {"stems_per_ha", &S::stems_per_ha, "stems on a hectare, drawn at random places", {0, 100000}},
      {"dbh_mean_cm", &S::dbh_mean_cm, "mean diameter at breast height", {0, 1000, true, false}},
      {"dbh_std_cm", &S::dbh_std_cm, "its standard deviation (gamma distribution); 0: all alike", {0, 1000}},
      {"conifer_share", &S::conifer_share, "share of conifers", share},
      {"nrtrees_raster", &S::nrtrees_raster, "raster of stems on a hectare, instead of stems_per_ha"},
      {"dbhmean_raster", &S::dbhmean_raster, "raster of mean diameters [cm], on the cells of nrtrees_raster"},
      {"dbhstd_raster", &S::dbhstd_raster, "raster of their standard deviations [cm]"},
      {"conif_percent_raster", &S::conif_percent_raster, "raster of the percentage of conifers"},
      {"stems_file", &S::stems_file, "vector file of stems instead of a stand: points with field dbh_cm, and species or conifer (1 or 0) where known"},
      {"height_m", &S::height_m, "height above the ground up to which stems stop blocks, or the canopy drags them", {0, 1000, true, false}},
      {"friction_deg", &S::friction_deg, "friction angle between block and stem", angle_below_90, "", friction_hint},
      {"drag_kg_s", &S::drag_kg_s, "viscous drag on a block in the polygon below height_m, instead of stems: 250 open, 500 medium, 750 dense forest", {0, 100000}},
      {"seed", &S::seed, "seed of the stand", not_negative},
      {"new_stand_per_run", &S::new_stand_per_run, "each [solver] seed draws a stand of its own"},
      {"active", &S::active, "whether it stands in the run"}};
  return table;
}
template <> const std::vector<SiteKey<OutputSettings>>& keys_of() {
  using S = OutputSettings;
  static const std::vector<SiteKey<S>> table = {
      {"frame_interval_s", &S::frame_interval_s, "simulated time between frames", positive},
      {"checkpoint_interval_s", &S::checkpoint_interval_s, "wall time between checkpoints", positive},
      {"cell_size_m", &S::cell_size_m, "cell size of maps; that of the TRN when not given", positive},
      {"passages", &S::passages, "record passages of cells"},
      {"frames", &S::frames, "keep all frames of a run that has ended; else the first and the last"},
      {"whole_share", &S::whole_share, "with frames = false: share of the runs, evenly over their seeds, that keep all frames nevertheless, for the animation", share}};
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
      {"surface_m", &S::surface_m, "piezometric surface: map x, y, z of one point of a level, or of three points of a plane", any, "", "", 1, 3},
      {"raster", &S::raster, "elevations of the piezometric surface, instead; unknown: no water"},
      {"depth_m", &S::depth_m, "depth of the piezometric surface below the surface of the mass, instead", not_negative},
      {"cracks", &S::cracks, "joint sets that are open cracks, filled by crack_fill_m whatever the piezometric surface; source_side: the walls along the outline of the source", any, "", "", 1},
      {"crack_fill_m", &S::crack_fill_m, "height of the water above the lowest point of each crack, at most to its top", not_negative},
      {"drained", &S::drained, "joint sets without water; source_side: the walls along the outline of the source", any, "", "", 1},
      {"drained_at_m", &S::drained_at_m, "opening of a face at which its pressure is gone, falling linearly; 0: at once; larger than any face: kept", not_negative}};
  return table;
}
template <> const std::vector<SiteKey<FragmentationSettings>>& keys_of() {
  using S = FragmentationSettings;
  static const std::vector<SiteKey<S>> table = {
      {"enabled", &S::enabled, "blocks break in two when they are hit hard, and their pieces again (law talus)"},
      {"splitting", &S::splitting, "planes along which they break: of any direction, or parallel to the joint sets", any, "random|joints"},
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
      {"file", &S::file, "mesh file: OBJ, PLY, OFF or STL, one or many closed bodies"},
      {"shape", &S::shape, "shape instead of a mesh; eota111, 211 and 221 have their proportions", any, shapes},
      {"size_m", &S::size_m, "box, rock, eota: extents x, y, z; eota111, 211, 221: the longest; prism: diameter, length along y; one number: of all", positive, "", "", 1, 3},
      {"volume_m3", &S::volume_m3, "volume that the body is scaled to", positive},
      {"n_points", &S::n_points, "points of a rock", {4, 500}},
      {"material", &S::material, "material of the bodies"},
      {"position_m", &S::position_m, "map x, y or x, y, z of each body", any, "", "", 1},
      {"height_above_ground_m", &S::height_above_ground_m, "height of the lowest vertex above the ground below it", {0, 100000}},
      {"velocity_m_s", &S::velocity_m_s, "initial velocity x, y, z", any, "", "", 3, 3},
      {"spin_rad_s", &S::spin_rad_s, "initial angular velocity x, y, z", any, "", "", 3, 3},
      {"seed", &S::seed, "seed of what is drawn: shapes, sizes, orientations", not_negative}};
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
      {"in_place", &S::in_place, "the mesh has map coordinates and is not moved"},
      {"yaw_deg", &S::yaw_deg, "rotation about z, applied last", {-360, 360}},
      {"pitch_deg", &S::pitch_deg, "rotation about y", {-360, 360}},
      {"roll_deg", &S::roll_deg, "rotation about x, applied first", {-360, 360}},
      {"random_orientation", &S::random_orientation, "each body is turned at random, uniformly over all rotations"}});
  return table;
}
template <> const std::vector<SiteKey<RockfallSettings>>& keys_of() {
  using S = RockfallSettings;
  static const std::vector<SiteKey<S>> table = with_body_keys<S>("box|prism|eota|eota111|eota211|eota221|rock|joint_cell", {
      {"rocks", &S::rocks, "rocks that each place releases in a run; another run draws others", {1, 100000}},
      {"release_file", &S::release_file, "vector file of release points, or of lines with release_spacing_m"},
      {"polygon", &S::polygon, "corners of an area that rocks are released all over, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with such areas: polygons, or closed lines"},
      {"release_spacing_m", &S::release_spacing_m, "spacing along release lines; in areas over the sloping ground, a cell of the TRN when not given", positive},
      {"min_slope_deg", &S::min_slope_deg, "flatter ground of the areas, or without a place of all the terrain, releases no rocks", angle_below_90},
      {"rockdensity_raster", &S::rockdensity_raster, "raster of source cells as of Rockyfor3D: density of the rock [kg/m3], 0 elsewhere"},
      {"d1_raster", &S::d1_raster, "raster of extents of the rocks [m], with d2_raster and d3_raster"},
      {"d2_raster", &S::d2_raster, "see d1_raster"},
      {"d3_raster", &S::d3_raster, "see d1_raster"},
      {"blshape_raster", &S::blshape_raster, "raster of shapes as of Rockyfor3D: 1 box, 2 ellipsoid, 3 sphere, 4 disc"},
      {"volumes_m3", &S::volumes_m3, "volumes that each rock's is drawn from, all alike", positive, "", "", 1},
      {"volume_max_m3", &S::volume_max_m3, "volumes are drawn from volume_m3 to this, by a power law", positive},
      {"volume_exponent", &S::volume_exponent, "exponent of the power law: the number of larger rocks goes with volume^-exponent", {0, 5}},
      {"height_scatter_m", &S::height_scatter_m, "rocks start evenly up to so much higher", {0, 1000}},
      {"velocity_scatter_m_s", &S::velocity_scatter_m_s, "standard deviation of each part of the initial velocity", {0, 100}},
      {"spin_scatter_rad_s", &S::spin_scatter_rad_s, "standard deviation of each part of the initial angular velocity", {0, 100}},
      {"frequency_per_a", &S::frequency_per_a, "rocks a year of the whole source, shared by its bodies as their weights", positive},
      {"frequency_per_m2_a", &S::frequency_per_m2_a, "rocks a year and m2 of the sloping ground of areas, instead", positive}});
  return table;
}
template <> const std::vector<SiteKey<ObjectSettings>>& keys_of() {
  using S = ObjectSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "outline of an area, map x, y", any, "", "an area needs three points", 3},
      {"line", &S::line, "points of a line, map x, y", any, "", "a line needs two points", 2},
      {"position_m", &S::position_m, "map x, y of points", any, "", "", 1},
      {"file", &S::file, "vector file with areas, or with lines (width_m) or points (radius_m), instead"},
      {"width_m", &S::width_m, "width of lines", positive},
      {"radius_m", &S::radius_m, "radius about points", positive},
      {"kind", &S::kind, "what it is, e.g. house, road: printed"},
      {"presence", &S::presence, "share of the time that the one most at risk is where rocks hit; with the next two for recipes of risk", {0, 1, true, false}},
      {"vulnerability", &S::vulnerability, "probability of death of who is hit, one for each intensity of the recipe, from the weakest", share, "", "", 1},
      {"persons_per_day", &S::persons_per_day, "persons, also in vehicles, that are there so long in a day", positive}};
  return table;
}
template <> const std::vector<SiteKey<FenceSearchSettings>>& keys_of() {
  using S = FenceSearchSettings;
  static const std::vector<SiteKey<S>> table = {
      {"protect", &S::protect, "the [object.*] that the fence is for"},
      {"between_m", &S::between_m, "nearest and farthest distance of the fence from the object, in plan", not_negative, "", "", 2, 2},
      {"step_m", &S::step_m, "from one candidate line to the next: in plan (offset), in height (contour)", positive},
      {"style", &S::style, "candidate lines: contours of the ground, or lines of equal distance to the object", any, "contour|offset"},
      {"max_candidates", &S::max_candidates, "more lines than this: the step grows until they are no more", {1, 500}},
      {"share", &S::share, "of the hits on the object, to be stopped", {0, 1, true, false}},
      {"heights_m", &S::heights_m, "heights of fences that can be built, ascending", positive, "", "", 1},
      {"classes_kj", &S::classes_kj, "energies that a field can take, ascending; those of share/codes/barrier_classes.csv when not given", positive, "", "", 1},
      {"prices_per_m", &S::prices_per_m, "price of a metre of fence, one a class; 1 + 0.2 k for class k from 0 when not given", positive, "", "", 1},
      {"price_per_m2", &S::price_per_m2, "on top of it, for a metre of fence and of height; 0 with prices_per_m, 0.1 without when not given", not_negative},
      {"code", &S::code, "design code: uni, onr, or a data file"},
      {"post_spacing_m", &S::post_spacing_m, "distance of posts", positive},
      {"min_fields", &S::min_fields, "fewest fields of a fence", {1, 100}},
      {"end_fields", &S::end_fields, "fields added at each end, beyond what is to be stopped", {0, 10}},
      {"max_length_m", &S::max_length_m, "longest fence; no limit when not given", positive},
      {"max_line_slope_deg", &S::max_line_slope_deg, "steepest slope along a fence", {0, 90, true, false}},
      {"max_ground_slope_deg", &S::max_ground_slope_deg, "steepest ground that a fence can stand on", {0, 90, true, false}},
      {"two_fences", &S::two_fences, "also look for pairs of fences: two rows, or side by side"}};
  return table;
}
template <> const std::vector<SiteKey<HazardSettings>>& keys_of() {
  using S = HazardSettings;
  static const std::vector<SiteKey<S>> table = {
      {"recipe", &S::recipe, "how classes are made: a name of share/hazard, or a file like those"},
      {"author", &S::author, "who answers for the hazard map: person and office. With the next two it is written to be filed"},
      {"date", &S::date, "day of the assessment, YYYY-MM-DD"},
      {"namespace", &S::name_space, "of the identifiers that are filed: ti.ch and the like of a canton file by the Swiss model, others by INSPIRE"}};
  return table;
}
template <> const std::vector<SiteKey<HazardClassSettings>>& keys_of() {
  using S = HazardClassSettings;
  static const std::vector<SiteKey<S>> table = {
      {"frequency_per_a", &S::frequency_per_a, "events a year; of rocks that move alone the rocks that the whole class releases in a year. Without any frequency those of [rockfall.*] count", positive},
      {"events", &S::events, "events that were counted, instead", not_negative},
      {"observed_a", &S::observed_a, "years in which they were counted", positive},
      {"failure_probability", &S::failure_probability, "instead: that the one mass fails, which may fail once", {0, 1, true, false}},
      {"in_years", &S::in_years, "within so many years", positive}};
  return table;
}
template <> const std::vector<SiteKey<UncertaintySettings>>& keys_of() {
  using S = UncertaintySettings;
  static const std::vector<SiteKey<S>> table = {
      {"sampling", &S::sampling, "how quantities are drawn: sobol (more runs go on where others ended), hypercube (needs n_samples), random", any, "sobol|hypercube|random"},
      {"seed", &S::seed, "seed of the draws", not_negative},
      {"n_samples", &S::n_samples, "samples of a hypercube, which has no others", {0, 1e7}},
      {"sample", &S::sample, "which sample this run is, from 1; 0: nothing is drawn. The pipeline gives each run that of its seed", {0, 4e9}},
      {"rock_masses", &S::rock_masses, "sets of blocks that are cut, each with its own joints; runs take them in turn. 0: one, by what this file says. Of [rockfall.*] when not given: each run its own", {0, 1000000}},
      {"terrain_rmse_m", &S::terrain_rmse_m, "error of the terrain's elevations, root of the mean square: each rock mass gets a ground of its own. 0: none", {0, 1000}},
      {"terrain_correlation_m", &S::terrain_correlation_m, "distance over which errors of the terrain are alike; 10 cells when not given", positive},
      {"max_failed_share", &S::max_failed_share, "up to this share of the runs may fail: they are left out, and widen the intervals", share},
      {"file", &S::file, "site file, as talus-calibrate proposes one, whose [uncertainty.NAME] take the place of those here"}};
  return table;
}
template <> const std::vector<SiteKey<QuantitySettings>>& keys_of() {
  using S = QuantitySettings;
  static const std::vector<SiteKey<S>> table = {
      {"keys", &S::keys, "keys of this file that the quantity is for; several move together. fisher: joints.NAME.orientation", any, "", "e.g. keys = [\"ground.slope.friction_deg\"]", 1},
      {"apply", &S::apply, "what is drawn takes the place of the value, is added to it, or is a factor on it", any, "set|add|factor"},
      {"distribution", &S::distribution, "what it is drawn from", any, "normal|lognormal|uniform|triangular|discrete|rows|fisher"},
      {"mean", &S::mean, "normal, lognormal: mean; not given: the key's own value (add: 0, factor: 1)"},
      {"std", &S::std, "normal, lognormal: standard deviation, of the value itself", positive},
      {"min", &S::min, "uniform, triangular: smallest value"},
      {"mode", &S::mode, "triangular: most likely value"},
      {"max", &S::max, "uniform, triangular: largest value"},
      {"values", &S::values, "discrete: values; rows: sets of values one after the other, each with a value for every key", any, "", "", 1},
      {"weights", &S::weights, "discrete, rows: their weights; all alike when not given", not_negative, "", "", 1},
      {"truncate", &S::truncate, "normal, lognormal: lowest and highest value; what is left is scaled up. Not given: what the keys may hold, at most 1 % outside of it", any, "", "", 2, 2},
      {"n_measured", &S::n_measured, "fisher: the orientation is the mean of so many measured ones, which scatter by fisher_k of the set", {0, 1000000}},
      {"fisher_k", &S::fisher_k, "fisher: concentration of the mean orientation itself, instead of n_measured", positive},
      {"source", &S::source, "where these numbers come from; printed"}};
  return table;
}
template <> const std::vector<SiteKey<ObservedSettings>>& keys_of() {
  using S = ObservedSettings;
  static const std::vector<SiteKey<S>> table = {
      {"boulders_file", &S::boulders_file, "vector file of deposited boulders: points, with volume_m3 and date where known"},
      {"scars_file", &S::scars_file, "vector file of scars of trees and other silent witnesses: points with height_m above the ground, and date where known"},
      {"outline_file", &S::outline_file, "vector file with the outline of the deposit: polygons, or closed lines"}};
  return table;
}
template <> const std::vector<SiteKey<PlaceSettings>>& keys_of() {
  using S = PlaceSettings;
  static const std::vector<SiteKey<S>> table = {
      {"polygon", &S::polygon, "corners of the place, map x, y", any, "", "", 3},
      {"polygon_file", &S::polygon_file, "vector file with the place: polygons, or closed lines"},
      {"fence", &S::fence, "the line of this fence instead of a polygon"},
      {"half_width", &S::half_width, "wanted half of the 95 % interval of the share of blocks that reach the place: make RUNS=auto adds runs until it is so narrow", {0, 0.5, true, false}}};
  return table;
}
template <> const std::vector<SiteKey<VariantSettings>>& keys_of() {
  using S = VariantSettings;
  static const std::vector<SiteKey<S>> table = {
      {"weight", &S::weight, "what it counts among the alternatives, which are evaluated together; not given: a measure, which is compared with the site", positive},
      {"cost", &S::cost, "of the measure, in any currency; printed beside its results", not_negative},
      {"without", &S::without, "sections of the site that it lacks: without = [\"fence.valley\", \"forest.wood\"]"}};
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
