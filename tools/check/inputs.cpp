// Inputs of a site's results, as extents to draw over the ground.
#include "tools/check/inputs.hpp"

#include <algorithm>
#include <utility>

#include "io/crs_gdal.hpp"
#include "setup/site_places_gdal.hpp"

namespace talus {
namespace {

struct Inputs {
  Vec3 origin = Vec3::Zero();
  std::vector<ViewedInput> list;

  // A layer of the import: its extent is that of x and y among the magnitudes.
  void add(const Json& layer) {
    const Json magnitudes = layer.value("magnitudes", Json::object());
    if (!magnitudes.contains("x_m") || !magnitudes.contains("y_m")) return;
    const auto at = [&](const char* of) {
      return Vec2(magnitudes["x_m"].at(of).get<double>() - origin.x(),
                  magnitudes["y_m"].at(of).get<double>() - origin.y());
    };
    const std::string name = layer.value("name", "");
    list.push_back({name, name + ": " + layer.value("file", ""), at("lowest"), at("highest")});
  }

  // As the site file writes them.
  void add_written(const std::string& name, const std::vector<Vec3>& points) {
    std::vector<Vec2> local;
    for (const Vec3& p : points) local.emplace_back((p - origin).head<2>());
    add(name, local);
  }

  void add(const std::string& name, const std::vector<Vec2>& points) {
    const auto same = std::find_if(
        list.begin(), list.end(), [&name](const ViewedInput& input) { return input.name == name; });
    if (points.empty() || same != list.end()) return;
    ViewedInput input{name, name, points[0], points[0]};
    for (const Vec2& p : points) {
      input.low = input.low.cwiseMin(p);
      input.high = input.high.cwiseMax(p);
    }
    list.push_back(std::move(input));
  }
};

}  // namespace

std::vector<ViewedInput> viewed_inputs(const Look& look, const std::vector<Json>& reports) {
  Inputs inputs{look.work.ground.origin, {}};
  for (const Json& report : reports)
    for (const Json& layer : report.value("layers", Json::array())) inputs.add(layer);
  std::vector<Vec2> points;
  for (const auto& ring : look.work.area.rings)
    points.insert(points.end(), ring.begin(), ring.end());
  inputs.add("source", std::exchange(points, {}));
  for (const Vec3& at : look.inputs.parts.blocks.centroid) points.emplace_back(at.head<2>());
  inputs.add("blocks", std::exchange(points, {}));
  for (const RecordLine& fence : look.inputs.lines) {
    for (const Vec3& post : fence.points) points.emplace_back(post.head<2>());
    inputs.add(section_of(fence), std::exchange(points, {}));
  }
  for (const RecordObject& object : look.inputs.objects) {
    for (const auto& polygon : polygons_of(object))
      points.insert(points.end(), polygon[0].begin(), polygon[0].end());
    inputs.add("object." + object.name, std::exchange(points, {}));
  }
  for (const Stem& stem : look.inputs.parts.stems) points.emplace_back(stem.foot.head<2>());
  inputs.add("stems", std::exchange(points, {}));
  const Site& site = look.work.site;  // inputs that a refused look did not reach, or keeps as cells
  if (!site.info.crs.empty() &&
      !same_crs(crs_from_user(site.info.crs, "site.crs"), look.work.ground.crs_wkt))
    return std::move(inputs.list);
  inputs.add_written("source", site.source.polygon);
  for (const GroundSettings& ground : site.grounds)
    inputs.add_written("ground." + ground.name, ground.polygon);
  for (const FenceSettings& fence : site.fences)
    inputs.add_written("fence." + fence.name, fence.line);
  for (const DamSettings& dam : site.dams) inputs.add_written("dam." + dam.name, dam.line);
  for (const ForestSettings& forest : site.forests)
    inputs.add_written("forest." + forest.name, forest.polygon);
  for (const ObjectSettings& object : site.objects)
    for (const auto* points_of : {&object.polygon, &object.line, &object.position_m})
      inputs.add_written("object." + object.name, *points_of);
  return std::move(inputs.list);
}

}  // namespace talus
