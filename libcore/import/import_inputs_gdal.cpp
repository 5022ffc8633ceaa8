// The import of all vector data: each question in turn, to all layers of a request.
#include "import/import_inputs_gdal.hpp"

#include <cmath>
#include <utility>

#include "base/file_paths.hpp"
#include "base/sha256.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "terrain/tin_mesh.hpp"

namespace talus {

RawInputs read_inputs(const InputsRequest& request) {
  RawInputs raw = open_all(request);
  declare_heights(raw);
  declare_plan_units(raw);
  declare_place(raw);
  declare_height_units(raw);
  check_places(raw);
  take_to_frame(raw);
  check_neighbours(raw);
  measure(raw);
  for (const RawLayer& layer : raw.layers) raw.reading.layers.push_back(layer.taken);
  return raw;
}

namespace {

std::vector<BoundaryRing> rings_of(const RawLayer& boundary) {
  std::vector<BoundaryRing> rings;
  const Polylines& lines = boundary.lines;
  for (std::size_t r = 0; r < boundary.polygon.size(); ++r) {
    rings.push_back({boundary.polygon[r], {}});
    for (int i = lines.begin[r]; i < lines.begin[r + 1]; ++i)
      rings.back().points.push_back(lines.points[i].head<2>());
  }
  return rings;
}

void make_relative(ContourMap& map) {
  const std::vector<Vec3>& ground = map.contours.points.empty() ? map.spots : map.contours.points;
  if (ground.empty()) return;
  Vec3 low = ground.front();
  for (const Vec3& p : ground) low = low.cwiseMin(p);
  map.origin = Vec3(std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0);
  for (std::vector<Vec3>* points : {&map.contours.points, &map.breaklines.points, &map.spots})
    for (Vec3& p : *points) p -= map.origin;
  for (BoundaryRing& ring : map.boundary)
    for (Vec2& p : ring.points) p -= map.origin.head<2>();
}

}  // namespace

InputError changed_since(const std::string& layer) {
  return {
      {file_of(layer)},
      "was changed since talus-import wrote it",
      "write it anew (make does when it is gone), or take a layer of it as it is: '" + layer + "'"};
}

std::string map_digest(const ContourMap& map) {
  Sha256 hash;
  hash.add(map.origin.data(), sizeof map.origin);
  for (const auto* points : {&map.contours.points, &map.breaklines.points, &map.spots})
    for (const Vec3& point : *points) hash.add(point.data(), sizeof point);
  for (const BoundaryRing& ring : map.boundary)
    for (const Vec2& point : ring.points) hash.add(point.data(), sizeof point);
  return hash.hex();
}

Imported import_inputs(const InputsRequest& request, ImportReading& reading) {
  RawInputs raw = read_inputs(request);
  Imported found;
  ContourMap& map = found.map;
  map.source = request.layers.empty() ? "" : request.layers.front().ref.path;
  map.crs_wkt = raw.frame;
  std::string boundary;
  for (RawLayer& layer : raw.layers) {
    if (layer.role == InputRole::contours) map.contours = std::move(layer.lines);
    if (layer.role == InputRole::breaklines) map.breaklines = std::move(layer.lines);
    if (layer.role == InputRole::spots || layer.role == InputRole::points)
      map.spots = std::move(layer.lines.points);
    if (layer.is_of_site()) found.shapes.push_back(take_shapes(layer));
    if (layer.role != InputRole::boundary) continue;
    map.boundary = rings_of(layer);
    boundary = layer.path();
  }
  reading = std::move(raw.reading);
  make_relative(map);
  check_boundary(map, boundary);
  if (!request.seal.empty() && map_digest(map) != request.seal) throw changed_since(map.source);
  return found;
}

ContourMap import_map(const InputsRequest& request, ImportReading& reading) {
  return import_inputs(request, reading).map;
}

std::vector<Vec3> import_reference_points(const LayerRef& ref, const std::string& crs_wkt,
                                          ImportReading& reading) {
  InputsRequest request;
  request.layers = {{InputRole::reference, ref}};
  request.has_frame = true;
  request.frame = crs_wkt;
  RawInputs raw = read_inputs(request);
  reading = std::move(raw.reading);
  return std::move(raw.layers.front().lines.points);
}

}  // namespace talus
