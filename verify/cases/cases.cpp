// Building blocks of scenes with a closed form: planes, valleys, profiles, prisms, boxes.
#include "verify/cases/cases.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

namespace talus::cases {

SlopeFrame slope_frame(double dip_deg, double azimuth_deg) {
  const double dip = dip_deg * std::numbers::pi / 180,
               azimuth = azimuth_deg * std::numbers::pi / 180;
  const Vec3 out(std::cos(azimuth), std::sin(azimuth), 0);
  SlopeFrame frame;
  frame.dip = std::cos(dip) * out - std::sin(dip) * Vec3::UnitZ();
  frame.normal = std::sin(dip) * out + std::cos(dip) * Vec3::UnitZ();
  frame.strike = frame.normal.cross(frame.dip);
  return frame;
}

Trn make_trn(const std::function<double(double, double)>& height, double cell_size, double reach,
             const Vec2& centre) {
  Trn trn;
  const int half = static_cast<int>(std::ceil(reach / cell_size));
  trn.n_rows = trn.n_cols = 2 * half + 1;
  trn.cell_size = cell_size;
  trn.node0 = centre + Vec2(-half * cell_size, half * cell_size);
  trn.elevation.resize(static_cast<std::size_t>(trn.n_rows) * static_cast<std::size_t>(trn.n_cols));
  for (int r = 0; r < trn.n_rows; ++r)
    for (int c = 0; c < trn.n_cols; ++c)
      trn.elevation[node_index(trn, r, c)] =
          height(trn.node0.x() + c * cell_size, trn.node0.y() - r * cell_size);
  return trn;
}

Trn plane_trn(const SlopeFrame& frame, double cell_size, double reach, const Vec3& through) {
  const Vec3& n = frame.normal;
  return make_trn(
      [&](double x, double y) {
        return through.z() - (n.x() * (x - through.x()) + n.y() * (y - through.y())) / n.z();
      },
      cell_size, reach, through.head<2>());
}

Polyhedron box_in(const SlopeFrame& frame, const Vec3& base, const Vec3& low, const Vec3& high) {
  Polyhedron body = box(low, high);
  for (Vec3& v : body.vertices)
    v = base + v.x() * frame.dip + v.y() * frame.strike + v.z() * frame.normal;
  return body;
}

Polyhedron polyhedron(std::vector<Vec3> vertices, const std::vector<std::vector<int>>& faces) {
  Polyhedron body;
  body.vertices = std::move(vertices);
  for (const std::vector<int>& f : faces) add_face(body, f, face_terrain);
  return body;
}

Polyhedron prism_on(const SlopeFrame& frame, const Vec3& base, int n, double radius,
                    double half_length) {
  const double step = 2 * std::numbers::pi / n, apothem = radius * std::cos(step / 2);
  std::vector<Vec3> vertices;
  for (const double side : {-1.0, 1.0})
    for (int k = 0; k < n; ++k) {
      const double angle = -std::numbers::pi / 2 + (k + 0.5) * step;
      vertices.push_back(base + radius * std::cos(angle) * frame.dip +
                         (apothem + radius * std::sin(angle)) * frame.normal +
                         side * half_length * frame.strike);
    }
  std::vector<std::vector<int>> faces(2);
  for (int k = 0; k < n; ++k) {  // the angle runs from dip to normal: about -strike
    faces[0].push_back(k);
    faces[1].push_back(2 * n - 1 - k);
    const int next = (k + 1) % n;
    faces.push_back({k, n + k, n + next, next});
  }
  return polyhedron(std::move(vertices), faces);
}

Polyhedron moved(Polyhedron body, const Mat3& turn, const Vec3& pivot, const Vec3& shift) {
  for (Vec3& v : body.vertices) v = pivot + turn * (v - pivot) + shift;
  return body;
}

GroundClass ground_of(double friction_deg, double restitution) {
  GroundClass ground;
  ground.friction = std::tan(friction_deg * (std::numbers::pi / 180));
  ground.restitution = restitution;
  return ground;
}

Body body_of(Polyhedron shape, const Vec3& velocity, const Vec3& spin) {
  Body body;
  body.parts = {std::move(shape)};
  body.velocity = velocity;
  body.spin = spin;
  return body;
}

std::vector<Body> arch_of(int n, double inner, double outer, double depth) {
  std::vector<Body> bodies;
  const std::vector<std::vector<int>> faces = {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1},
                                               {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  for (int i = 0; i < n; ++i) {
    std::vector<Vec3> v;
    for (const double y : {-depth / 2, depth / 2})
      for (const auto& [radius, k] :
           {std::pair{inner, i}, {outer, i}, {outer, i + 1}, {inner, i + 1}}) {
        const double angle = std::numbers::pi * k / n;
        const double z = k == 0 || k == n ? 0 : std::sin(angle);
        v.emplace_back(radius * std::cos(angle), y, radius * z);
      }
    bodies.push_back(body_of(polyhedron(v, faces)));
  }
  return bodies;
}

Scene scene_of(Trn trn, const GroundClass& ground, const std::vector<Body>& bodies,
               const Settings& settings, const Material& material) {
  Scene scene;
  scene.ground = make_ground(std::move(trn), ground);
  scene.joint = ground;
  scene.gravity = Vec3(0, 0, -10);
  scene.settings = settings;
  BlockSet set;
  set.material_names = {"rock"};
  for (const Body& body : bodies) add_body(set, body);
  add_blocks(scene, set, std::span(&material, 1));
  check_scene(scene);
  return scene;
}

}  // namespace talus::cases
