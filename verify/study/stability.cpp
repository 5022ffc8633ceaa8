// Runs scenes at the ends of every range of input and judges their outcome.
#include "verify/study/stability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/units.hpp"
#include "solver/law_numbers.hpp"
#include "step/report.hpp"
#include "verify/cases/block_cases.hpp"
#include "verify/cases/case_run.hpp"
#include "verify/cases/cases.hpp"
#include "verify/cases/pile_scenes.hpp"

namespace talus {
namespace {

using namespace cases;

constexpr double gravity = 10;

// Mechanical energy and the energy dissipated or stored in contacts: constant but for numerical
// errors.
double total_energy(const Scene& scene, const State& state) {
  const Energies e = energies(scene, state);
  const EnergyLedger& l = state.ledger;
  return e.translation + e.rotation + e.potential + e.elastic + l.friction + l.impact + l.contact +
         l.removed;
}

// How deep a point is inside part p of a block, from the nearest face; 0 outside. Body axes.
double inside_of(const Shapes& shapes, int p, const Vec3& X) {
  double depth = std::numeric_limits<double>::infinity();
  for (int f = shapes.face_begin[p]; f < shapes.face_begin[p + 1]; ++f) {
    const ShapeFace& face = shapes.faces[f];
    depth = std::min(depth, face.offset - face.normal.dot(X));
  }
  return std::max(0.0, depth);
}

// Deepest point of the ground inside the block: peaks and ridges under its faces, which no vertex
// sees. Looks at nodes and at points between them, a quarter of a cell apart or a twelfth of the
// block.
double ground_inside(const Run& run, int b, const Pose& pose) {
  const Shapes& shapes = run.scene.blocks.shapes;
  const Trn& trn = run.scene.ground.trn;
  const double radius = shapes.radius[b];
  const double apart = trn.cell_size * std::max(0.25, std::ceil(radius / 6 / trn.cell_size));
  const auto first = [&](double centre, double node) {
    return node + std::ceil((centre - radius - node) / apart) * apart;
  };
  const Vec3& c = pose.position;
  double deepest = 0;
  for (double y = first(c.y(), trn.node0.y()); y <= c.y() + radius; y += apart)
    for (double x = first(c.x(), trn.node0.x()); x <= c.x() + radius; x += apart) {
      const double z = elevation_at(trn, x, y);
      if (!(std::abs(z - c.z()) < radius)) continue;
      const Vec3 X = pose.attitude.conjugate() * (Vec3(x, y, z) - c);
      for (int p = shapes.part_begin[b]; p < shapes.part_begin[b + 1]; ++p)
        deepest = std::max(deepest, inside_of(shapes, p, X));
    }
  return deepest;
}

// Deepest vertex of a block below the ground, or ground in the block, over its radius.
double depth_of(const Run& run, int b) {
  const Shapes& shapes = run.scene.blocks.shapes;
  const Pose pose = run.motion(b).pose;
  double deepest = ground_inside(run, b, pose);
  for (const Vec3& vertex : vertices_of(shapes, b)) {
    const Vec3 at = pose.position + pose.attitude * vertex;
    const double ground = elevation_at(run.scene.ground.trn, at.x(), at.y());
    if (!std::isnan(ground)) deepest = std::max(deepest, ground - at.z());
  }
  return deepest / shapes.radius[b];
}

// Moves the scene on and watches every step. The energy in play: kinetic at the start, that of a
// fall by the blocks' own radii, and that dissipated.
Seen watch(Run& run, double duration) {
  Seen seen;
  const Blocks& blocks = run.scene.blocks;
  const Energies first = energies(run.scene, run.state);
  double scale = first.translation + first.rotation;
  for (std::size_t b = 0; b < blocks.mass.size(); ++b)
    scale += blocks.mass[b] * gravity * blocks.shapes.radius[b];
  const double start = total_energy(run.scene, run.state);
  while (run.state.time < duration - run.scene.settings.dt / 2 && seen.finite) {
    run.advance();
    const double now = total_energy(run.scene, run.state);
    const EnergyLedger& l = run.state.ledger;
    seen.finite = std::isfinite(now) && !has(run.result.flags, StepFlag::not_finite);
    seen.left |= has(run.result.flags, StepFlag::left_domain);
    seen.gain = std::max(seen.gain, (now - start) / (scale + l.friction + l.impact));
    for (std::size_t b = 0; b < blocks.mass.size(); ++b)
      seen.depth = std::max(seen.depth, depth_of(run, static_cast<int>(b)));
  }
  return seen;
}

// --- sliding cubes: a closed form ----------------------------------------------------------------

struct SlideSpec {
  double side = 1, dip_deg = 30, friction_deg = 20;
  Material material;
  Settings settings;
  Vec3 offset = Vec3::Zero();
};

// From rest for as long as it takes to come two sides far without friction, a whole number of
// steps. Error: of the displacement, over the closed form (26), or over the side where it sticks.
Seen slide(const SlideSpec& spec) {
  const SlopeFrame frame = slope_frame(spec.dip_deg, 37);
  const double h = spec.side / 2, down = gravity * std::sin(spec.dip_deg * degree);
  const Body body = body_of(box_in(frame, spec.offset, Vec3(-h, -h, 0), Vec3(h, h, spec.side)));
  const GroundClass ground = ground_of(spec.friction_deg);
  Run run(scene_of(plane_trn(frame, spec.side / 2, 12 * spec.side, spec.offset), ground, {body},
                   spec.settings, spec.material),
          {});
  const Vec3 from = run.motion().pose.position;
  const double dt = spec.settings.dt;
  const double duration = std::max(2.0, std::ceil(std::sqrt(4 * spec.side / down) / dt)) * dt;
  Seen seen = watch(run, duration);
  const double t = run.state.time;
  const double a = down - ground.friction * gravity * std::cos(spec.dip_deg * degree);
  const double expected = std::max(0.0, a) * t * t / 2;
  const double off = (run.motion().pose.position - from - expected * frame.dip).norm();
  seen.error = off / (expected > 0 ? expected : spec.side);
  return seen;
}

template <class Change>
Corner slide_corner(const std::string& axis, double value, const std::string& unit,
                    double tolerance, Change change) {
  return {axis, value, unit, "cube sliding on a plane", "relative", tolerance, [value, change] {
            SlideSpec spec;
            change(spec, value);
            return slide(spec);
          }};
}

void add_slides(std::vector<Corner>& corners) {
  for (const double young : {1e7, 1e8, 1e9, 1e10, 1e11, 1e12})
    corners.push_back(
        slide_corner("Young's modulus, strains on", young, "Pa", 1e-3, [](SlideSpec& s, double v) {
          s.material.young = v;
          s.settings.strains = true;
        }));
  for (const double ratio : {1e-2, 1e-1, 1e0, 1e1, 1e2})
    corners.push_back(
        slide_corner("k_n / E, strains on", ratio, "1/m", 1e-3, [](SlideSpec& s, double v) {
          s.settings.normal_stiffness = v * s.material.young;
          s.settings.strains = true;
        }));
  for (const double stiffness : {1e6, 1e8, 1e10, 1e12, 1e14})
    corners.push_back(slide_corner("k_n", stiffness, "N/m", 1e-3, [](SlideSpec& s, double v) {
      s.settings.normal_stiffness = v;
    }));
  for (const double dt : {1e-5, 1e-4, 1e-3, 1e-2, 5e-2})
    corners.push_back(slide_corner("time step", dt, "s", 1e-3,
                                   [](SlideSpec& s, double v) { s.settings.dt = v; }));
  for (const double side : {0.01, 0.1, 1.0, 10.0, 100.0})
    corners.push_back(
        slide_corner("size", side, "m", 1e-3, [](SlideSpec& s, double v) { s.side = v; }));
  for (const double dip : {22.0, 45.0, 60.0, 75.0, 85.0})
    corners.push_back(
        slide_corner("slope", dip, "degrees", 1e-3, [](SlideSpec& s, double v) { s.dip_deg = v; }));
  for (const double place : {0.0, 1e5, 1e6, 1e7})
    corners.push_back(slide_corner("coordinates", place, "m", 1e-3, [](SlideSpec& s, double v) {
      s.offset = Vec3(v, v, v / 1000);
    }));
  for (const double friction : {0.0, 29.0, 31.0, 60.0, 89.0})
    corners.push_back(slide_corner("friction", friction, "degrees", 1e-3,
                                   [](SlideSpec& s, double v) { s.friction_deg = v; }));
}

// --- thrown bodies: watched ----------------------------------------------------------------------

struct ThrowSpec {
  Vec3 edges = Vec3::Ones();  ///< [m]
  Vec3 velocity = Vec3(5, 1, -5);
  Vec3 spin = Vec3(1, 2, 0.5);
  double restitution = 0.5, friction_deg = 30;
  std::function<double(double, double)> height = [](double x, double) { return -0.4 * x; };
};

// Highest ground within `radius` of (x, y), sampled.
double highest_near(const Trn& trn, double x, double y, double radius) {
  double highest = elevation_at(trn, x, y);
  for (int i = -8; i <= 8; ++i)
    for (int j = -8; j <= 8; ++j)
      highest = std::max(highest, elevation_at(trn, x + radius * i / 8, y + radius * j / 8));
  return highest;
}

// From a radius above the ground, for 2 s.
Seen throw_body(const ThrowSpec& spec) {
  const double reach = 20 + 3 * spec.velocity.norm();
  const Trn trn = make_trn(spec.height, std::max(0.5, reach / 200), reach);
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const double radius = spec.edges.norm() / 2;
  const Vec3 at(0.13, 0.21, 2 * radius + highest_near(trn, 0.13, 0.21, radius));
  const Body body = body_of(moved(box(-spec.edges / 2, spec.edges / 2), turn, Vec3::Zero(), at),
                            spec.velocity, spec.spin);
  const GroundClass ground = ground_of(spec.friction_deg, spec.restitution);
  Run run(scene_of(trn, ground, {body}, {}), {});
  return watch(run, 2);
}

template <class Change>
Corner throw_corner(const std::string& axis, double value, const std::string& unit,
                    const std::string& scene, Change change) {
  return {axis, value, unit, scene, "", 0, [value, change] {
            ThrowSpec spec;
            change(spec, value);
            return throw_body(spec);
          }};
}

void add_throws(std::vector<Corner>& corners) {
  for (const double aspect : {1.0, 10.0, 100.0, 200.0}) {
    corners.push_back(throw_corner("aspect, plate", aspect, "1", "plate of 1 m thrown on a slope",
                                   [](ThrowSpec& s, double v) { s.edges.z() = 1 / v; }));
    corners.push_back(
        throw_corner("aspect, needle", aspect, "1", "needle of 1 m thrown on a slope",
                     [](ThrowSpec& s, double v) { s.edges = Vec3(1, 1 / v, 1 / v); }));
  }
  for (const double speed : {1.0, 10.0, 50.0, 100.0, 200.0})
    corners.push_back(
        throw_corner("speed", speed, "m/s", "cube thrown on a slope",
                     [](ThrowSpec& s, double v) { s.velocity = v * Vec3(0.6, 0, -0.8); }));
  for (const double spin : {0.0, 10.0, 100.0})
    corners.push_back(
        throw_corner("spin", spin, "rad/s", "brick thrown on a slope", [](ThrowSpec& s, double v) {
          s.edges = Vec3(1, 0.6, 0.3);
          s.spin = v * Vec3(0.1, 0.99, 0.1).normalized();
        }));
  for (const double cor : {0.0, 0.5, 1.0})
    corners.push_back(throw_corner("COR", cor, "1", "cube thrown on a slope",
                                   [](ThrowSpec& s, double v) { s.restitution = v; }));
  const auto into = [&corners](const std::string& axis, double value, auto height) {
    corners.push_back(
        throw_corner(axis, value, "m", "cube dropped on it", [height](ThrowSpec& s, double v) {
          s.velocity = Vec3(0.5, 0.2, -3);
          s.edges *= v;
          s.height = height;
        }));
  };
  for (const double side : {0.1, 1.0, 4.0}) {
    into("V-notch of 90 degrees, cube of", side, [](double x, double) { return std::abs(x); });
    into("V-notch of 20 degrees, cube of", side,
         [](double x, double) { return std::min(60.0, 5.67 * std::abs(x)); });
    into("ridge of 90 degrees, cube of", side, [](double x, double) { return -std::abs(x); });
    into("pit of one cell, 2 m deep, cube of", side,
         [](double x, double y) { return std::abs(x) < 0.3 && std::abs(y) < 0.3 ? -2.0 : 0.0; });
  }
}

// --- several blocks ------------------------------------------------------------------------------

// A cube on four cubes beneath its corners, `ratio` times lighter each: how far any of them moves
// in 1 s over the small side.
Seen on_feet(double ratio) {
  const double small = 0.1, large = small * std::cbrt(ratio), at = large / 2;
  std::vector<Body> bodies = {body_of(box(Vec3(-at, -at, small), Vec3(at, at, small + large)))};
  const double out = at - small;
  for (const double x : {-out, out})
    for (const double y : {-out, out})
      bodies.push_back(body_of(
          box(Vec3(x - small / 2, y - small / 2, 0), Vec3(x + small / 2, y + small / 2, small))));
  const GroundClass ground = ground_of(30);
  Run run(scene_of(plane_trn(slope_frame(0, 0), 1, 2 + 3 * large), ground, bodies, {}), {});
  Seen seen = watch(run, 1);
  for (int b = 0; b < n_blocks(run.scene); ++b)
    seen.error =
        std::max(seen.error,
                 (run.motion(b).pose.position - run.scene.blocks.rest[b].position).norm() / small);
  return seen;
}

// How far any cube of a stack moves in 4 s from the start, over its side.
Seen stack(int n, double dip_deg, double friction_deg, double dt) {
  Settings awake;
  awake.sleep = false;
  awake.dt = dt;
  Run run(tower(n, dip_deg, friction_deg, awake), {});
  Seen seen = watch(run, 4);
  for (int b = 0; b < n; ++b)
    seen.error = std::max(seen.error,
                          (run.motion(b).pose.position - run.scene.blocks.rest[b].position).norm());
  return seen;
}

// A tower of eight at a share of the dip at which it topples, 3 s: how far a cube moves.
Seen lean(double share, double dt) {
  Run run(scene_of_pile({.high = 8, .share = share, .step = dt}), {});
  Seen seen = watch(run, 3);
  for (int b = 0; b < n_blocks(run.scene); ++b)
    seen.error = std::max(seen.error,
                          (run.motion(b).pose.position - run.scene.blocks.rest[b].position).norm());
  return seen;
}

// The record of a case from its result.
Seen seen_of(const CaseResult& result) {
  Seen seen;
  seen.error = result.error;
  seen.finite = std::isfinite(result.error) && !has(result.flags, StepFlag::not_finite);
  seen.left = has(result.flags, StepFlag::left_domain);
  return seen;
}

void add_contacts(std::vector<Corner>& corners) {
  for (const double share : {0.5, 0.8, 0.9, 0.97})
    corners.push_back({"lean of a tower of eight", share, "1", "at rest, over its angle, 3 s",
                       "movement over the side", 1e-3,
                       [share] { return lean(share, Settings{}.dt); }});
  for (const double share : {0.5, 0.8, 0.93})
    corners.push_back({"lean of a tower of eight, 20 ms", share, "1",
                       "at rest, over its angle, 3 s", "movement over the side", 1e-3,
                       [share] { return lean(share, 0.02); }});
  for (const double cor : {0.5, 0.9, 0.99, 1.0})
    corners.push_back({"COR with spin", cor, "1", "pairs of tumbling cubes meet in space",
                       "COR, worst hit", 0.01, [cor] { return seen_of(tumbling_pairs({}, cor)); }});
  for (const double half_angle : {10.0, 30.0, 45.0, 60.0, 80.0})
    corners.push_back({"half angle of a ridge", half_angle, "degrees",
                       "a plate of two parts at rest on it, 1 s", "sinks, over its size", 1e-4,
                       [half_angle] { return seen_of(parts_on_ridge({}, half_angle)); }});
}

void add_block_corners(std::vector<Corner>& corners) {
  const double dt = Settings{}.dt;
  const std::string norm = "movement over the side";
  corners.push_back({"mass ratio", 1, "1", "cube at rest on its like", norm, 0.05,
                     [dt] { return stack(2, 0, 30, dt); }});
  for (const double ratio : {64.0, 1e3, 1e5, 1e7})
    corners.push_back({"mass ratio", ratio, "1", "cube at rest on four lighter ones",
                       "movement over the small side", 0.05, [ratio] { return on_feet(ratio); }});
  for (const double n : {2.0, 5.0, 10.0, 20.0, 50.0})
    corners.push_back({"stack of cubes", n, "1", "at rest, 4 s", norm, 0.05,
                       [n, dt] { return stack(static_cast<int>(n), 0, 30, dt); }});
  for (const double step : {1e-4, 1e-3, 1e-2, 5e-2}) {
    corners.push_back({"time step, stack of ten", step, "s", "at rest, 4 s", norm, 0.05,
                       [step] { return stack(10, 0, 30, step); }});
    corners.push_back({"time step, three on 15 degrees", step, "s", "friction 15.5 degrees, 4 s",
                       norm, 0.05, [step] { return stack(3, 15, 15.5, step); }});
  }
}

Colour colour_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return rgb(0x5aa469);
    case Outcome::inexact:
      return rgb(0xf0c75e);
    case Outcome::refused:
      return rgb(0xbbbbbb);
    case Outcome::broken:
      return rgb(0xc1272d);
  }
  return {};
}

}  // namespace

std::string text_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::inexact:
      return "inexact";
    case Outcome::refused:
      return "refused";
    case Outcome::broken:
      return "broken";
  }
  return "";
}

Outcome judge(const Corner& corner, const Seen& seen) {
  if (!seen.refusal.empty()) return Outcome::refused;
  if (!seen.finite || seen.left || !(seen.gain <= gain_limit) || !(seen.depth <= law::deep_share))
    return Outcome::broken;
  if (seen.depth <= depth_limit && (corner.norm.empty() || seen.error <= corner.tolerance))
    return Outcome::right;
  return std::isfinite(seen.error) ? Outcome::inexact : Outcome::broken;
}

std::vector<Corner> stability_corners() {
  std::vector<Corner> corners;
  add_slides(corners);
  add_throws(corners);
  add_block_corners(corners);
  add_contacts(corners);
  return corners;
}

StabilityRow run_corner(const Corner& corner) {
  StabilityRow row{corner, {}, Outcome::right};
  try {
    row.seen = corner.run();
  } catch (const InputError& error) {
    row.seen.refusal = error.what();
  }
  row.outcome = judge(corner, row.seen);
  return row;
}

std::string stability_csv(const std::vector<StabilityRow>& rows) {
  std::string out =
      "axis,value,unit,scene,outcome,error,error_norm,tolerance,energy_gain,depth_over_radius,"
      "reason\n";
  const auto quoted = [](const std::string& words) { return "\"" + words + "\""; };
  for (const StabilityRow& row : rows)
    out += quoted(row.corner.axis) + "," + text(row.corner.value) + "," + row.corner.unit + "," +
           quoted(row.corner.scene) + "," + text_of(row.outcome) + "," + text(row.seen.error, 4) +
           "," + quoted(row.corner.norm) + "," + text(row.corner.tolerance) + "," +
           text(row.seen.gain, 3) + "," + text(row.seen.depth, 3) + "," + quoted(row.seen.refusal) +
           "\n";
  return out;
}

Drawing stability_picture(const std::vector<StabilityRow>& rows) {
  std::vector<std::pair<std::string, std::vector<const StabilityRow*>>> axes;
  for (const StabilityRow& row : rows) {
    auto at = std::find_if(axes.begin(), axes.end(),
                           [&row](const auto& axis) { return axis.first == row.corner.axis; });
    if (at == axes.end()) at = axes.insert(axes.end(), {row.corner.axis, {}});
    at->second.push_back(&row);
  }
  const auto draw = [axes](Pen& pen) {
    const Letters small{10};
    double x = 260, y = 40;
    for (const Outcome outcome :
         {Outcome::right, Outcome::inexact, Outcome::refused, Outcome::broken}) {
      pen.box({x, 12, 14, 14}, colour_of(outcome));
      pen.words_about({x + 20, 19}, text_of(outcome), small, Anchor::begin);
      x += 90;
    }
    for (const auto& [axis, fields] : axes) {
      pen.words_about({250, y + 10}, axis, small, Anchor::end);
      x = 260;
      for (const StabilityRow* field : fields) {
        const Corner& corner = field->corner;
        pen.box({x, y, 70, 20}, colour_of(field->outcome));
        pen.words_about({x + 35, y + 10},
                        text(corner.value, 4) + (corner.unit == "1" ? "" : " " + corner.unit),
                        small);
        x += 72;
      }
      y += 22;
    }
  };
  return {720, 50 + 22.0 * static_cast<double>(axes.size()), "outcomes", pixel_mm, draw};
}

}  // namespace talus
