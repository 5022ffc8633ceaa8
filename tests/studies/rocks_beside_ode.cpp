// Rocks that fall one by one, through the Open Dynamics Engine (ODE): the peer of
// rocks_beside_ode.py, which writes the scene, compiles this file and reads the result.
//
//   rocks_beside_ode SCENE OUT KEY=VALUE...
//
// in:  SCENE, numbers in text: rows, columns and cell size of the nodes [m], x and y of the
//      north-west node, elevations from north to south; then the number of rocks, and of each its
//      mass [kg], principal inertia [kg m2], position [m], attitude (w x y z), vertices in its own
//      axes and faces (number of corners, corners)
// out: OUT, doubles by rock and frame: position, attitude, velocity, spin (13); CPU seconds
//
// Each rock has a world of its own. Triangles are those of the TRN.
#include <ode/ode.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

using Vec3 = Eigen::Vector3d;

/// Options of the command line; each value is a number.
struct Settings {
  double step_s = 1e-3, frame_s = 0.05, duration_s = 60;
  double gravity_m_s2 = 9.80665, friction = 0.6, restitution = 0.35;
  double bounce_m_s = 0.02;  ///< approaches that are slower return nothing
  double erp = 0.2;          ///< share of the overlap that a step corrects
  double iterations = 50;    ///< of QuickStep; 0: dWorldStep, which solves exactly
  double along_slip = 1;     ///< 1: friction pyramid along the slip, 0: along axes of ODE's choice
  double cone = 0;           ///< 1: the pyramid is turned and cut until friction is Coulomb's
  double corners = 0;     ///< 1: contacts at corners below the ground, 0: ODE's hull on triangles
  double gyroscopic = 1;  ///< 1: torque-free bodies precess
};

Settings settings_of(int n, char** words) {
  Settings s;
  const std::map<std::string, double*> known{{"step_s", &s.step_s},
                                             {"frame_s", &s.frame_s},
                                             {"duration_s", &s.duration_s},
                                             {"gravity_m_s2", &s.gravity_m_s2},
                                             {"friction", &s.friction},
                                             {"restitution", &s.restitution},
                                             {"bounce_m_s", &s.bounce_m_s},
                                             {"erp", &s.erp},
                                             {"iterations", &s.iterations},
                                             {"along_slip", &s.along_slip},
                                             {"cone", &s.cone},
                                             {"corners", &s.corners},
                                             {"gyroscopic", &s.gyroscopic}};
  for (int k = 0; k < n; ++k) {
    const std::string word = words[k], key = word.substr(0, word.find('='));
    if (!known.contains(key)) {
      std::cerr << "unknown setting " << word << "\n";
      std::exit(2);
    }
    *known.at(key) = std::atof(word.c_str() + key.size() + 1);
  }
  return s;
}

/// Nodes from north to south and west to east; cells are cut from north-west to south-east.
struct Terrain {
  int n_rows = 0, n_cols = 0;
  double cell = 0, west = 0, north = 0;
  std::vector<double> z;         ///< NaN: unknown
  std::vector<double> vertices;  ///< as ODE takes them
  std::vector<dTriIndex> corners;

  [[nodiscard]] Vec3 node(int r, int c) const {
    return {west + c * cell, north - r * cell, z[static_cast<std::size_t>(r * n_cols + c)]};
  }
  /// Plane of the triangle below a place: a point and the normal; false: none is known there.
  bool plane_at(double x, double y, Vec3& point, Vec3& normal) const {
    const double column = (x - west) / cell, row = (north - y) / cell;
    const int c = static_cast<int>(std::floor(column)), r = static_cast<int>(std::floor(row));
    if (r < 0 || c < 0 || r + 1 >= n_rows || c + 1 >= n_cols) return false;
    point = node(r, c);
    const Vec3 far = node(r + 1, c + 1);
    const Vec3 third = row - r > column - c ? node(r + 1, c) : node(r, c + 1);
    normal = (far - point).cross(third - point).normalized();
    if (normal.z() < 0) normal = -normal;
    return normal.allFinite();
  }
};

struct Rock {
  double mass = 0;
  Vec3 inertia = Vec3::Zero(), position = Vec3::Zero();
  dQuaternion attitude{};
  std::vector<double> vertices, planes;
  std::vector<unsigned> faces;  ///< number of corners, corners
  unsigned n_faces = 0;
};

Terrain read_terrain(std::istream& in) {
  Terrain t;
  in >> t.n_rows >> t.n_cols >> t.cell >> t.west >> t.north;
  std::string word;
  for (int k = 0; k < t.n_rows * t.n_cols && in >> word; ++k) t.z.push_back(std::stod(word));
  for (int r = 0; r < t.n_rows; ++r)
    for (int c = 0; c < t.n_cols; ++c) {
      const Vec3 x = t.node(r, c);
      t.vertices.insert(t.vertices.end(), {x.x(), x.y(), std::isfinite(x.z()) ? x.z() : 0});
    }
  const auto add = [&](int a, int b, int c) {
    for (const int k : {a, b, c})
      if (!std::isfinite(t.z[static_cast<std::size_t>(k)])) return;
    for (const int k : {a, b, c}) t.corners.push_back(static_cast<dTriIndex>(k));
  };
  for (int r = 0; r + 1 < t.n_rows; ++r)
    for (int c = 0; c + 1 < t.n_cols; ++c) {
      const int k = r * t.n_cols + c, below = k + t.n_cols;
      add(k, below, below + 1);
      add(k, below + 1, k + 1);
    }
  return t;
}

Rock read_rock(std::istream& in) {
  Rock rock;
  std::size_t n = 0;
  in >> rock.mass;
  for (double& x : rock.inertia) in >> x;
  for (double& x : rock.position) in >> x;
  for (double& x : rock.attitude) in >> x;
  in >> n;
  rock.vertices.resize(3 * n);
  for (double& x : rock.vertices) in >> x;
  in >> rock.n_faces;
  const auto vertex = [&](unsigned k) { return Vec3(&rock.vertices[3 * std::size_t{k}]); };
  for (unsigned f = 0; f < rock.n_faces; ++f) {
    const std::size_t begin = rock.faces.size() + 1;
    unsigned corners = 0;
    in >> corners;
    rock.faces.push_back(corners);
    for (unsigned k = 0, v = 0; k < corners && in >> v; ++k) rock.faces.push_back(v);
    Vec3 normal = Vec3::Zero();
    for (unsigned k = 1; k + 1 < corners; ++k)
      normal += (vertex(rock.faces[begin + k]) - vertex(rock.faces[begin]))
                    .cross(vertex(rock.faces[begin + k + 1]) - vertex(rock.faces[begin]));
    normal.normalize();
    rock.planes.insert(rock.planes.end(),
                       {normal.x(), normal.y(), normal.z(), normal.dot(vertex(rock.faces[begin]))});
  }
  return rock;
}

/// One rock in its world, on the ground that all share.
struct Fall {
  const Settings& settings;
  const Terrain& terrain;
  const Rock& rock;
  dGeomID ground;
  dWorldID world = dWorldCreate();
  dJointGroupID joints = dJointGroupCreate(0);
  dBodyID body = dBodyCreate(world);
  dGeomID hull = nullptr;
  std::vector<dContact> contacts{64};
  double still_s = 0;  ///< so long it has hardly moved

  Fall(const Settings& s, const Terrain& t, const Rock& r, dGeomID g)
      : settings(s), terrain(t), rock(r), ground(g) {
    dWorldSetGravity(world, 0, 0, -s.gravity_m_s2);
    dWorldSetERP(world, s.erp);
    dWorldSetCFM(world, 1e-12);
    dWorldSetContactSurfaceLayer(world, 1e-4);
    if (s.iterations > 0) dWorldSetQuickStepNumIterations(world, static_cast<int>(s.iterations));
    dMass mass;
    dMassSetParameters(&mass, r.mass, 0, 0, 0, r.inertia.x(), r.inertia.y(), r.inertia.z(), 0, 0,
                       0);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, r.position.x(), r.position.y(), r.position.z());
    dBodySetQuaternion(body, r.attitude);
    dBodySetGyroscopicMode(body, s.gyroscopic > 0);
    hull = dCreateConvex(nullptr, r.planes.data(), r.n_faces, r.vertices.data(),
                         static_cast<unsigned>(r.vertices.size() / 3), r.faces.data());
    dGeomSetBody(hull, body);
  }
  ~Fall() {
    dGeomDestroy(hull);
    dJointGroupDestroy(joints);
    dWorldDestroy(world);
  }
  Fall(const Fall&) = delete;
  Fall& operator=(const Fall&) = delete;

  // Corners of the rock below the plane of the triangle that they are over.
  int find_corners() {
    std::size_t n = 0;
    for (std::size_t k = 0; k < rock.vertices.size() && n < contacts.size(); k += 3) {
      dVector3 x;
      Vec3 point, normal;
      dBodyGetRelPointPos(body, rock.vertices[k], rock.vertices[k + 1], rock.vertices[k + 2], x);
      if (!terrain.plane_at(x[0], x[1], point, normal)) continue;
      const double depth = normal.dot(point - Vec3(x));
      if (depth <= 0) continue;
      dContactGeom& geometry = contacts[n++].geom;
      std::copy_n(x, 3, geometry.pos);
      std::copy_n(normal.data(), 3, geometry.normal);
      geometry.depth = depth;
    }
    return static_cast<int>(n);
  }

  int find_contacts() {
    if (settings.corners > 0) return find_corners();
    dReal box[6];
    dGeomGetAABB(hull, box);  // dCollide takes the box as it was last asked for
    return dCollide(hull, ground, static_cast<int>(contacts.size()), &contacts[0].geom,
                    sizeof(dContact));
  }

  static Vec3 of(const dReal* values) { return Vec3(values); }

  // Slip of a point in contact, from its velocity.
  [[nodiscard]] Vec3 slip_at(const dContactGeom& at, const Vec3& centroid) const {
    const Vec3 normal = of(at.normal), spin = of(dBodyGetAngularVel(body));
    const Vec3 velocity = of(dBodyGetLinearVel(body)) + spin.cross(of(at.pos) - centroid);
    return velocity - normal.dot(velocity) * normal;
  }

  // The pyramid lies along the slip at the start of the step.
  void prepare(dContact& contact) const {
    contact.surface = {};
    contact.surface.mode = dContactApprox1 | dContactBounce;
    contact.surface.mu = settings.friction;
    contact.surface.bounce = settings.restitution;
    contact.surface.bounce_vel = settings.bounce_m_s;
    const Vec3 slip = slip_at(contact.geom, of(dBodyGetPosition(body)));
    if (settings.along_slip > 0 && slip.norm() > 1e-6) lay_along(slip, contact);
  }
  static void lay_along(const Vec3& slip, dContact& contact) {
    contact.surface.mode |= dContactFDir1;
    const Vec3 direction = slip.normalized();
    std::copy_n(direction.data(), 3, contact.fdir1);
  }

  void solve(std::vector<dJointFeedback>& forces) {
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const dJointID joint = dJointCreateContact(world, joints, &contacts[k]);
      dJointAttach(joint, body, nullptr);
      dJointSetFeedback(joint, &forces[k]);
    }
    if (settings.iterations > 0)
      dWorldQuickStep(world, settings.step_s);
    else
      dWorldStep(world, settings.step_s);
    dJointGroupEmpty(joints);
  }

  // Where friction is above its bound it gets one direction, against the slip at the end of the
  // step. False where nothing changes any more.
  bool turn_pyramid(const dJointFeedback& force, const Vec3& centroid, dContact& contact) const {
    const Vec3 normal = of(contact.geom.normal), all = of(force.f1);
    const double pressed = normal.dot(all);
    const Vec3 friction = all - pressed * normal;
    const bool has_slid = (contact.surface.mode & dContactMu2) != 0;
    if (!has_slid) {
      if (friction.norm() <= (1 + 1e-6) * settings.friction * pressed) return false;
      contact.surface.mode |= dContactMu2;
      contact.surface.mu2 = 0;
      lay_along(-friction, contact);
      return true;
    }
    const Vec3 slip = slip_at(contact.geom, centroid), last = of(contact.fdir1);
    if (slip.norm() < 1e-9) return false;
    lay_along(last + slip.normalized(), contact);
    return (of(contact.fdir1) - last).norm() > 1e-5;
  }

  // The same step again and again, until friction is Coulomb's.
  void step_in_cone(std::vector<dJointFeedback>& forces) {
    const Vec3 x = of(dBodyGetPosition(body)), v = of(dBodyGetLinearVel(body)),
               w = of(dBodyGetAngularVel(body));
    dQuaternion q;
    std::copy_n(dBodyGetQuaternion(body), 4, q);
    for (int round = 0; round < 40; ++round) {
      solve(forces);
      bool has_turned = false;
      for (std::size_t k = 0; k < forces.size(); ++k)
        has_turned |= turn_pyramid(forces[k], x, contacts[k]);
      if (!has_turned || round == 39) return;
      dBodySetPosition(body, x.x(), x.y(), x.z());
      dBodySetQuaternion(body, q);
      dBodySetLinearVel(body, v.x(), v.y(), v.z());
      dBodySetAngularVel(body, w.x(), w.y(), w.z());
    }
  }

  // False when nothing happens any more: the rock is at rest or beyond the known ground.
  bool step() {
    const dReal* x = dBodyGetPosition(body);
    Vec3 point, normal;
    if (still_s > 0.5 || !terrain.plane_at(x[0], x[1], point, normal)) return false;
    const auto last = contacts.begin() + find_contacts();
    const auto is_bad = [](const dContact& c) {  // NaN
      return !(std::abs(of(c.geom.normal).squaredNorm() - 1) < 0.1) || !(c.geom.depth < 10);
    };
    std::vector<dJointFeedback> forces(static_cast<std::size_t>(
        std::remove_if(contacts.begin(), last, is_bad) - contacts.begin()));
    for (std::size_t k = 0; k < forces.size(); ++k) prepare(contacts[k]);
    if (settings.cone > 0)
      step_in_cone(forces);
    else
      solve(forces);
    const bool is_still =
        of(dBodyGetLinearVel(body)).norm() < 0.05 && of(dBodyGetAngularVel(body)).norm() < 0.1;
    still_s = is_still && !forces.empty() ? still_s + settings.step_s : 0;
    return true;
  }

  void write(std::ostream& out) const {
    const auto put = [&](const dReal* values, int n) {
      out.write(reinterpret_cast<const char*>(values),
                static_cast<std::streamsize>(sizeof(dReal)) * n);
    };
    put(dBodyGetPosition(body), 3);
    put(dBodyGetQuaternion(body), 4);
    put(dBodyGetLinearVel(body), 3);
    put(dBodyGetAngularVel(body), 3);
  }
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "rocks_beside_ode SCENE OUT KEY=VALUE...\n";
    return 2;
  }
  const Settings settings = settings_of(argc - 3, argv + 3);
  std::ifstream in(argv[1]);
  const Terrain terrain = read_terrain(in);
  std::size_t n_rocks = 0;
  in >> n_rocks;
  std::vector<Rock> rocks;
  while (rocks.size() < n_rocks) rocks.push_back(read_rock(in));
  if (!in) {
    std::cerr << argv[1] << " ends too early\n";
    return 1;
  }
  dInitODE2(0);
  dTriMeshDataID data = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(data, terrain.vertices.data(), 3 * sizeof(double),
                              static_cast<int>(terrain.vertices.size() / 3), terrain.corners.data(),
                              static_cast<int>(terrain.corners.size()), 3 * sizeof(dTriIndex));
  dGeomTriMeshDataPreprocess2(data, 1U << dTRIDATAPREPROCESS_BUILD_FACE_ANGLES, nullptr);
  dGeomID ground = dCreateTriMesh(nullptr, data, nullptr, nullptr, nullptr);

  std::ofstream out(argv[2], std::ios::binary);
  const long n_frames = std::lround(settings.duration_s / settings.frame_s);
  const long steps = std::lround(settings.frame_s / settings.step_s);
  const std::clock_t begin = std::clock();
  for (const Rock& rock : rocks) {
    Fall fall(settings, terrain, rock, ground);
    bool moves = true;
    fall.write(out);
    for (long frame = 0; frame < n_frames; ++frame) {
      for (long k = 0; k < steps && moves; ++k) moves = fall.step();
      fall.write(out);
    }
  }
  std::printf("%.3f\n", static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  return out ? 0 : 1;
}
