// The look at a site before anything is computed: mass, fall lines, fences, objects, doubts.
#include "tools/check/look.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/processor_time.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "geometry/convex_outline.hpp"
#include "geometry/plan2d.hpp"
#include "import/dem_gdal.hpp"
#include "record/object_hits.hpp"
#include "setup/observed_inputs_gdal.hpp"
#include "setup/run_settings.hpp"
#include "setup/set_up_gdal.hpp"
#include "setup/site_dams_gdal.hpp"
#include "setup/site_places_gdal.hpp"
#include "setup/site_scene.hpp"
#include "setup/sliding_sets.hpp"
#include "setup/source_cut_gdal.hpp"
#include "site/joint_plan.hpp"
#include "site/plan.hpp"
#include "site/soils.hpp"
#include "terrain/smooth.hpp"
#include "tools/frame/failure_plane_choice.hpp"

namespace talus {
namespace {

constexpr int n_sliders = 60;
// Rocks that roll and bounce: the least angle of a rockfall shadow, Evans and Hungr (1993) [deg].
constexpr double rolling_deg = 27.5;

// --- the source --------------------------------------------------------------------------------

double tangent_of_set(const Site& site, const PlannedSet& planned) {
  const JointSettings& section = site.joints[planned.section];
  const MaterialSettings& rock = site.materials[material_index(site, site.source.material)];
  return std::tan((std::isnan(section.friction_deg) ? rock.friction_deg : section.friction_deg) *
                  degree);
}

std::vector<KinematicSet> kinematic_sets(const BlocksWork& work) {
  std::vector<KinematicSet> sets;
  for (const PlannedSet& planned : work.sets) {
    KinematicSet set;
    set.name = planned.set.name;
    set.mean = {planned.set.dip, planned.set.dip_direction};
    set.friction = tangent_of_set(work.site, planned);
    for (const Vec3& measured : planned.measured_poles) set.draws.push_back(attitude(measured));
    if (set.draws.empty()) set.draws = drawn_attitudes(planned.set);
    sets.push_back(std::move(set));
  }
  return sets;
}

double node_volume(const Trn& ground, const Trn& bed, const Area& area, double polygon_area) {
  double sum = 0;
  int n = 0;
  for (int r = 0; r < ground.n_rows; ++r)
    for (int c = 0; c < ground.n_cols; ++c) {
      const Vec3 node = node_point(ground, r, c);
      if (std::isnan(node.z()) || !contains(area, Vec2(node.head<2>()))) continue;
      sum += node.z() - bed.elevation[node_index(ground, r, c)];
      ++n;
    }
  return n > 0 ? polygon_area * sum / n : 0;
}

// The shorter of the two widths of the area: along its fall line and across it.
double width_of(const Area& area, double azimuth) {
  const Vec2 down(std::sin(azimuth), std::cos(azimuth)), across(down.y(), -down.x());
  double width = std::numeric_limits<double>::infinity();
  for (const Vec2& axis : {down, across}) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& ring : area.rings)
      for (const Vec2& p : ring) {
        low = std::min(low, p.dot(axis));
        high = std::max(high, p.dot(axis));
      }
    width = std::min(width, high - low);
  }
  return width;
}

// Key that a user changes for another depth.
std::string depth_key(const SourceSettings& source) {
  const std::string& surface = source.failure_surface;
  if (surface == "plane") return "source.plane_point_m";
  if (surface == "raster" || surface == "thickness") return "source.raster";
  if (surface == "daylighting") return "source.failure_surface";
  if (surface != "slbl") return "source.depth_m";
  return source.slbl_scenario.empty() ? "source.slbl_sag_m" : "source.slbl_scenario";
}

// The direction that the failure surface falls in: of the plane or wedge that was taken, else of
// the slope.
double motion_of(const BlocksWork& work, const Attitude& slope) {
  const std::string& surface = work.site.source.failure_surface;
  if (surface == "daylighting" && work.planes.best >= 0)
    return work.planes.planes[work.planes.best].attitude.dip_direction;
  if (surface == "daylighting" && work.wedge >= 0) return work.wedges[work.wedge].line.trend;
  if (surface == "plane") return work.site.source.plane_dip_direction_deg * degree;
  return slope.dip_direction;
}

// Of the joint sets; NaN without any [m].
double smallest_spacing(const BlocksWork& work) {
  double smallest = PlausibilityFacts::none;
  for (const PlannedSet& planned : work.sets)
    smallest = std::isnan(smallest) ? planned.set.mean_spacing
                                    : std::min(smallest, planned.set.mean_spacing);
  return smallest;
}

void look_at_mass(Look& look) {
  const BlocksWork& work = look.work;
  const Trn &ground = work.ground, &bed = look.inputs.parts.trn;
  look.measure = measure_mass(ground, bed, work.area);
  look.volume.prism = look.measure.volume;
  for (const double volume : look.inputs.parts.blocks.volume) look.volume.cut += volume;
  look.volume.nodes = node_volume(ground, bed, work.area, area_of(work.area));
  look.mean_depth = look.measure.plan_area > 0 ? look.measure.volume / look.measure.plan_area : 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (size_t v = 0; v < look.measure.vertices.size(); v += 2) {  // on the ground, below it, ...
    low = std::min(low, look.measure.vertices[v].z());
    high = std::max(high, look.measure.vertices[v].z());
  }
  look.relief = high - low;
  look.width = width_of(work.area, look.slope.dip_direction);
  look.foot = steps_at_foot(ground, bed, work.area, look.motion);
  look.low_step = std::max(look.low_step, low_step_spacings * smallest_spacing(work));
  double all = 0, stepped = 0;
  for (const FootStep& at : look.foot) {
    look.step = std::max(look.step, at.height);
    all += at.weight;
    if (at.height > look.low_step) stepped += at.weight;
  }
  look.step_share = all > 0 ? stepped / all : 0;
  look.rising_share = share_over_rising_bed(ground, bed, work.area, look.motion);
  look.equilibrium = least_factor(
      bed_columns(ground, bed, work.area, std::tan(work.planes.friction)), look.motion);
}

void look_at_joints(Look& look) {
  const BlocksWork& work = look.work;
  const std::vector<KinematicSet> sets = kinematic_sets(work);
  look.kinematics = kinematics_of(face_in(work.ground, work.area), sets);
  look.smooth_kinematics = kinematics_of(face_in(smoothed(work.ground), work.area), sets);
  const BlockSet& blocks = look.inputs.parts.blocks;
  FaceFriction friction;
  for (const KinematicSet& set : sets) friction.of_set.push_back(set.friction);
  friction.of_bed = std::tan(work.planes.friction);
  const MaterialSettings& rock =
      work.site.materials[material_index(work.site, work.site.source.material)];
  friction.of_rock = std::tan(rock.friction_deg * degree);
  std::vector<double> weight;
  for (const double volume : blocks.volume)
    weight.push_back(volume * rock.density_kg_m3 * work.site.solver.gravity_m_s2);
  look.peel = peel_off(contacts_of(blocks, friction), weight);
}

void look_at_source(Tool& tool, const std::vector<std::uint8_t>& classes, Look& look) {
  BlocksWork& work = look.work;
  work.area = read_source_area(tool, work);
  look.slope = mean_slope(work.ground, work.area);
  if (!look.is_cut) return;
  plan_sets(tool, work);
  std::vector<JointSet> sets;
  for (const PlannedSet& planned : work.sets) sets.push_back(planned.set);
  work.planes = find_failure_planes(work.ground, work.area, sets,
                                    friction_below(work.site, work.ground, work.area, classes),
                                    work.site.source.sliding_set, where_of_area(work));
  find_wedges(work);
  if (work.planes.best < 0) work.wedge = best_wedge(work.wedges, "");
  look.surfaces = outlined_surfaces(work);
  look.motion = motion_of(work, look.slope);
  look_at_mass(look);
  look_at_joints(look);
}

// --- fall lines ---------------------------------------------------------------------------------

// Some sixty places spread over the source, or where the blocks are.
std::vector<Vec2> starts_of(const Look& look) {
  std::vector<Vec2> places;
  if (look.work.has_source()) {
    const Trn& ground = look.work.ground;
    for (int r = 0; r < ground.n_rows; ++r)
      for (int c = 0; c < ground.n_cols; ++c) {
        const Vec2 p = node_point(ground, r, c).head<2>();
        if (contains(look.work.area, p)) places.push_back(p);
      }
  } else {
    for (const Vec3& at : look.inputs.parts.blocks.centroid) places.push_back(at.head<2>());
  }
  std::vector<Vec2> some;
  const size_t n = std::min<size_t>(n_sliders, places.size());
  for (size_t k = 0; k < n; ++k) some.push_back(places[(2 * k + 1) * places.size() / (2 * n)]);
  return some;
}

bool segments_cross(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const auto side = [](const Vec2& p, const Vec2& q, const Vec2& r) {
    return cross(q - p, r - p) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

// To which side a path first crosses a line: +1: to its left, seen from its first point, -1: to its
// right; 0: it does not cross it.
int crossing(const std::vector<Vec2>& path, const RecordLine& line) {
  for (size_t k = 0; k + 1 < path.size(); ++k)
    for (size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vec2 a = line.points[i].head<2>(), b = line.points[i + 1].head<2>();
      if (segments_cross(path[k], path[k + 1], a, b))
        return cross(b - a, path[k + 1] - path[k]) > 0 ? 1 : -1;
    }
  return 0;
}

// In plan, of lines that do not cross: the least lies at an end of one of two segments.
double gap(const std::vector<Vec2>& path, const RecordLine& line) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k + 1 < path.size(); ++k)
    for (size_t i = 0; i + 1 < line.points.size(); ++i) {
      const Vec2 a = line.points[i].head<2>(), b = line.points[i + 1].head<2>();
      least = std::min({least, distance_to_segment(path[k], a, b),
                        distance_to_segment(path[k + 1], a, b),
                        distance_to_segment(a, path[k], path[k + 1]),
                        distance_to_segment(b, path[k], path[k + 1])});
    }
  return least;
}

void look_at_paths(Look& look) {
  const Site& site = look.work.site;
  SlidingFriction friction;
  friction.tangent.clear();
  const double most_deg = moves_alone(site) ? rolling_deg : 90;
  for (const GroundSettings& ground : site.grounds)
    friction.tangent.push_back(std::tan(std::min(ground.friction_deg, most_deg) * degree));
  friction.cell_class = look.inputs.parts.cell_class;
  const Trn smooth = smoothed(look.work.ground);
  std::vector<double> times;
  for (const Vec2& start : starts_of(look)) {
    look.slides.push_back(slide_from(smooth, friction, start, true));
    times.push_back(look.slides.back().time);
  }
  look.travel_duration = duration_for(times);
}

const FenceSettings* fence_of(const Site& site, const std::string& line) {
  for (const FenceSettings& fence : site.fences)
    if (line == fence.name || line.rfind(fence.name + ".", 0) == 0) return &fence;
  return nullptr;
}

// On which side of a crest the line before its uphill face is, as crossing().
int side_of(const RecordLine& crest, const RecordLine& before) {
  const Vec2 along = (crest.points[1] - crest.points[0]).head<2>();
  return cross(along, Vec2((before.points[0] - crest.points[0]).head<2>())) > 0 ? 1 : -1;
}

void look_at_fences(Look& look) {
  const std::vector<RecordLine>& lines = look.inputs.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const RecordLine& line = lines[i];
    const FenceSettings* settings = fence_of(look.work.site, line.name);
    const bool is_crest = is_dam(line) && !is_before_dam(line);
    // a candidate of a search: nobody asked for a fence there
    if (settings == nullptr && !is_crest) continue;
    FenceLook fence;
    fence.line = line;
    fence.is_dam = is_crest;
    fence.stands = line.standing;
    if (settings != nullptr) fence.height = settings->height_m;
    fence.low = std::numeric_limits<double>::infinity();
    fence.high = -fence.low;
    for (const Vec3& post : line.points) {
      fence.low = std::min(fence.low, post.z());
      fence.high = std::max(fence.high, post.z());
      fence.is_in_source |=
          look.work.has_source() && contains(look.work.area, Vec2(post.head<2>()));
    }
    fence.nearest = std::numeric_limits<double>::infinity();
    for (const SliderPath& slide : look.slides) {
      // a dam turns them away: they come to the line before it, which is the next
      const int onto = crossing(slide.points, line);
      const bool comes = onto != 0 || (is_crest && crossing(slide.points, lines[i + 1]) != 0);
      fence.n_fall_lines += comes;
      fence.n_from_downhill += is_crest && onto == side_of(line, lines[i + 1]);
      fence.nearest = std::min(fence.nearest, comes ? 0 : gap(slide.points, line));
    }
    look.fences.push_back(std::move(fence));
  }
}

// Whether a path comes onto the object: looked at every metre.
bool comes_to(const std::vector<Vec2>& path, const RecordObject& object) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Vec2 step = k + 1 < path.size() ? Vec2(path[k + 1] - path[k]) : Vec2::Zero();
    const int n = std::max(1, static_cast<int>(std::ceil(step.norm())));
    for (int i = 0; i < n; ++i)
      if (gap_to(object, Vec2(path[k] + static_cast<double>(i) / n * step)) <= 0) return true;
  }
  return false;
}

void look_at_objects(Look& look) {
  const BlockSet& set = look.inputs.parts.blocks;
  std::vector<std::vector<Vec2>> outlines;
  for (int b = 0; b < n_blocks(set); ++b) {
    std::vector<Vec2> corners;
    for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
      corners.emplace_back(set.vertices[v].head<2>());
    outlines.push_back(convex_outline(std::move(corners)));
  }
  for (const RecordObject& object : look.inputs.objects) {
    ObjectLook found;
    found.object = object;
    found.distance = std::numeric_limits<double>::infinity();
    for (const std::vector<Vec2>& outline : outlines)
      found.distance = std::min(found.distance, gap_to(object, outline));
    found.is_in_source = found.distance <= 0;
    for (const SliderPath& slide : look.slides)
      found.n_fall_lines += comes_to(slide.points, object);
    look.objects.push_back(std::move(found));
  }
}

double known_area(const Trn& trn) {
  double n = 0;
  for (int t = 0; t < n_triangles(trn); ++t) n += is_known(trn, t);
  return n * trn.cell_size * trn.cell_size / 2;
}

// On the object in the middle of these points.
void add_doubt(Look& look, const std::string& key, const std::vector<Vec2>& points,
               const std::string& found, const std::string& hint) {
  Doubt doubt;
  doubt.what = key, doubt.found = found, doubt.hint = hint;
  Vec2 sum = Vec2::Zero();
  for (const Vec2& p : points) sum += p;
  const Vec2 at = sum / static_cast<double>(points.size()) + look.inputs.origin.head<2>();
  doubt.at = {{at.x(), at.y(), Doubt::none}};
  look.doubts.push_back(std::move(doubt));
}

void doubt_objects(Look& look) {
  for (const ObjectLook& object : look.objects)
    if (object.is_in_source)
      add_doubt(look, "object." + object.object.name, polygons_of(object.object).at(0).at(0),
                "it stands on the mass, and goes with it",
                "is it where it should be? Look at the map");
}

void doubt_fences(Look& look) {
  for (const FenceLook& fence : look.fences) {
    const std::string key = section_of(fence.line);
    std::vector<Vec2> posts;
    for (const Vec3& post : fence.line.points) posts.emplace_back(post.head<2>());
    if (fence.is_in_source)
      add_doubt(look, key, posts, "a point of its line lies in the source: it goes with the mass",
                "move it out of the source");
    if (!look.slides.empty() && fence.n_fall_lines == 0)
      add_doubt(look, key, posts,
                "no fall line from the source comes to it; the nearest ends or passes " +
                    text(fence.nearest, 2) + " m away",
                "a mass spreads beside its fall lines, and may still come: look at the map, is it "
                "below the source?");
    if (fence.n_from_downhill > 0)
      add_doubt(look, key, posts,
                std::to_string(fence.n_from_downhill) + " of the " +
                    std::to_string(fence.n_fall_lines) +
                    " fall lines that come to it come from the side taken as downhill",
                "what comes from there is not judged: draw the line where the ground still falls "
                "towards it");
  }
}

// Values that no field test supports, for blocks like these.
void warn_of_soils(Tool& tool, const Site& site, const BlockSet& blocks) {
  const auto density_of = [&](int block) {
    const std::string& name = blocks.material_names[blocks.material[block]];
    return site.materials[material_index(site, name)].density_kg_m3;
  };
  double heaviest_t = 0;
  for (int b = 0; b < n_blocks(blocks); ++b)
    heaviest_t = std::max(heaviest_t, blocks.volume[b] * density_of(b) / 1000);
  if (site.solver.friction == "weakening")
    tool.warn(std::string("solver.friction: weakening has no field test: ") + weakening().source);
  for (const GroundSettings& ground : site.grounds) {
    const Soil* soil = soil_named(ground.soil);
    if (soil == nullptr) continue;
    const std::string words = "ground." + ground.name + ": soil " + soil->name;
    if (!soil->is_tested())
      tool.warn(words + " has no field test: " + soil->source);
    else if (heaviest_t > soil->heaviest_t)
      tool.warn(words + " was tested with blocks up to " + text(soil->heaviest_t) +
                " t; the heaviest here has " + text(heaviest_t, 3) +
                " t, and rebounds less than any test shows; the other bound: "
                "cor_half_speed_m_s = 10 in its section");
  }
}

}  // namespace

void look_at(Tool& tool, const Site& site, const CheckFiles& files, Look& look) {
  look.files = files;
  look.work.site = site;
  look.work.ground = read_trn(files.trn);
  check_times(site);
  static_cast<void>(warn_of_settings(tool, site));
  look.inputs = read_dda_inputs(tool, site, {files.bed, files.blocks, files.settle});
  if (look.inputs.other_dams) throw *look.inputs.other_dams;
  warn_of_soils(tool, site, look.inputs.parts.blocks);
  static_cast<void>(observed_events(tool, site, look.work.ground));  // refused before the runs
  look.is_cut = look.work.is_cut();
  const Trn& bed = look.inputs.parts.trn;
  const Trn& ground = look.work.ground;
  if (bed.n_rows != ground.n_rows || bed.n_cols != ground.n_cols || bed.node0 != ground.node0 ||
      bed.origin != ground.origin)
    throw InputError({files.bed}, "is not the terrain of " + files.trn + ", lowered",
                     "give --bed what talus-blocks --trn-out made of this --trn");
  if (look.work.has_source()) look_at_source(tool, look.inputs.parts.cell_class, look);
  look_at_paths(look);
  look_at_fences(look);
  look_at_objects(look);
}

bool can_be_probed(const Look& look) { return look.work.site.solver.law == "talus"; }

void probe_look(Tool& tool, double duration, Look& look) {
  Site site = look.work.site;
  site.solver.time_step_s = probe_step_s;
  const ScenePlan plan = plan_of(site, look.inputs.parts, false);
  check_start(tool, site, look.inputs, {look.files.bed, look.files.blocks, look.files.settle},
              plan.block_contacts);
  const Scene scene = make_site_scene(site, plan, look.inputs.parts);
  if (!(duration > 0)) return;
  const double start = processor_seconds();
  const ProgressFunction progress = tool.progress();
  look.probe = probe(scene, duration, [&](double share) {
    progress(share);
    return tool.interrupted();
  });
  look.probe_cpu_s = processor_seconds() - start;
  look.is_probed = true;
}

void set_magnitudes(const Look& look, PlausibilityFacts& facts) {
  const Site& site = look.work.site;
  const std::vector<double>& volumes = look.inputs.parts.blocks.volume;
  if (moves_alone(site) || volumes.size() == 1) {
    if (!volumes.empty()) facts.largest_rock = *std::max_element(volumes.begin(), volumes.end());
  } else {  // a mass: it does not go often
    for (const HazardClassSettings& kind : site.hazard_classes)
      if (!(kind.frequency_per_a <= facts.frequency) && !std::isnan(kind.frequency_per_a)) {
        facts.frequency = kind.frequency_per_a;
        facts.frequency_key = "hazard.class." + kind.name + ".frequency_per_a";
      }
  }
  for (const FenceSettings& fence : site.fences)
    facts.fences.push_back({"fence." + fence.name, fence.height_m, fence.capacity_kj});
}

void find_doubts(Look& look) {
  const Site& site = look.work.site;
  PlausibilityFacts facts;
  facts.cell_size = look.work.ground.cell_size;
  facts.n_blocks = moves_alone(site) ? 1 : n_blocks(look.inputs.parts.blocks);
  facts.duration = site.solver.duration_s;
  facts.travel_duration = look.travel_duration;
  if (!look.slides.empty()) {
    const auto n_left = std::count_if(look.slides.begin(), look.slides.end(),
                                      [](const SliderPath& slide) { return slide.left; });
    facts.left_share = static_cast<double>(n_left) / static_cast<double>(look.slides.size());
  }
  if (look.work.has_source()) {
    facts.polygon_area = area_of(look.work.area);
    facts.terrain_area = known_area(look.work.ground);
  }
  if (look.is_cut) {
    facts.mean_depth = look.mean_depth;
    facts.max_depth = look.measure.max_depth;
    facts.depth_key = depth_key(site.source);
    facts.relief = look.relief;
    if (site.source.failure_surface == "normal_depth") facts.normal_depth = site.source.depth_m;
    facts.width = look.width;
    facts.smallest_spacing = smallest_spacing(look.work);
    facts.daylights = site.source.failure_surface == "daylighting";
    facts.step_at_foot = look.step;
    facts.step_share = look.step_share;
    facts.sliding_spacing = facts.smallest_spacing;
    if (look.is_probed) facts.moved_share = look.probe.moved_share;
  }
  set_magnitudes(look, facts);
  look.doubts = doubts_of(facts);
  if (!look.probe.fault.empty()) {
    look.doubts.push_back(doubt_on({}, "the probe broke a limit: " + look.probe.fault,
                                   "see docs/tools/talus-dda.md, health"));
    look.doubts.back().what = "solver.time_step_s";
  }
  doubt_fences(look);
  doubt_objects(look);
  for (Doubt& doubt : look.doubts) {
    doubt.where = where_of(site, doubt.what);
    if (doubt.state == DoubtState::refused)
      doubt.hint += "; --accept-doubts goes on with it (make CHECK_FLAGS=--accept-doubts)";
  }
}

}  // namespace talus
