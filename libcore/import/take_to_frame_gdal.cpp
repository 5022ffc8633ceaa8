// The part of import/raw_inputs_gdal.hpp that takes all layers to the frame, by one operation a
// layer in plan and one in height.

#include "import/crs_place_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/systems_gdal.hpp"
#include "io/crs_gdal.hpp"

namespace talus {
namespace {

// Heights stay as they are. The operation is noted.
void take_plan(RawLayer& layer, RawInputs& raw) {
  std::vector<Vec3>& points = layer.lines.points;
  ImportReading& reading = raw.reading;
  std::vector<std::string> of_site;  // notes on objects on the ground are among those of their
                                     // reading
  const CrsOperation operation =
      plan_operation(layer.crs, raw.frame, window_of(points, layer.crs), layer.where(),
                     raw.request.accept_ballpark, layer.is_of_site() ? of_site : reading.operations,
                     reading.doubts);
  if (!carry_out(operation, points))
    throw InputError(
        layer.where(),
        "cannot be reprojected from " + crs_name(layer.crs) + " to " + crs_name(raw.frame),
        layer.written != nullptr
            ? "check crs of [site]: it is that of the coordinates in the site file"
        : layer.is_of_site() ? "check the CRS of the file"
                             : "");
  for (const Vec3& point : points)
    check_finite({point.x(), point.y(), 0}, where_of_layer(layer.source));
  layer.taken.operation = sentence_on(operation);
  if (&layer == raw.ground()) check_can_be_computed_in(raw.frame, points.front(), layer.path());
}

// The system that the heights are in is held to the same as that of the map, where both say it.
void check_heights_alike(const RawLayer& layer, RawInputs& raw) {
  if (!same_heights(layer.own_crs, raw.frame))
    throw InputError({layer.path()},
                     "the heights are in " + crs_name(height_crs(layer.own_crs)) +
                         ", those of the map in " + crs_name(height_crs(raw.frame)),
                     "bring them to one system first");
  const std::string assumed = assumed_heights(layer.own_crs, raw.frame);
  if (layer.taken.unit_m == 1 && !assumed.empty())
    raw.reading.notes.push_back(layer.path() + " and the map: both are " + assumed);
}

// Takes heights to the requested system; those of the frame are in their own.
void take_heights(RawLayer& layer, RawInputs& raw) {
  std::vector<Vec3>& points = layer.lines.points;
  const auto operation = height_operation(raw.frame, raw.request, window_of(points), layer.path());
  if (!operation) return;
  operation->apply(points);
  raw.reading.operations.push_back(layer.path() + ": " + operation->sentence());
  layer.decide("operation in height", operation->sentence(), "--t-vertical");
}

}  // namespace

void take_to_frame(RawInputs& raw) {
  for (RawLayer& layer : raw.layers) {
    if (layer.lines.points.empty()) continue;
    if (!layer.is_in_frame) take_plan(layer, raw);
    layer.decide("operation in plan", layer.is_in_frame ? "none" : layer.taken.operation,
                 layer.is_in_frame ? "it is in the system of the map"
                                   : "the best that PROJ has for the place");
    if (!layer.has_heights()) continue;
    if (&layer != raw.ground()) check_heights_alike(layer, raw);
    for (Vec3& point : layer.lines.points) point.z() *= layer.taken.unit_m;
    check_elevations(layer.lines.points, Vec3::Zero(), {layer.path()}, "--elevation-unit-m ");
    take_heights(layer, raw);
  }
  const std::string& vertical = raw.request.t_vertical;
  if (!vertical.empty() && raw.ground() != nullptr)
    raw.frame = with_heights(horizontal_crs(raw.frame), vertical, {raw.ground()->path()});
}

}  // namespace talus
