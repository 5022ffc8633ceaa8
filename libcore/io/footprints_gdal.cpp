#include "io/footprints_gdal.hpp"

#include <algorithm>

#include "geometry/convex_outline.hpp"
#include "io/style.hpp"

namespace talus {
namespace {

VectorFeature block_feature(const BlockSet& set, int b) {
  std::vector<Vec2> points;
  double bottom = set.vertices[set.block_vertex_begin[b]].z(), top = bottom;
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v) {
    points.emplace_back(set.vertices[v].head<2>() + set.origin.head<2>());
    bottom = std::min(bottom, set.vertices[v].z());
    top = std::max(top, set.vertices[v].z());
  }
  const Vec3 size = extents({set.volume[b], set.centroid[b], set.second_moment[b]});
  VectorFeature feature;
  feature.polygons = {{convex_outline(std::move(points))}};
  const std::int64_t n_parts = set.convex_part_begin[b + 1] - set.convex_part_begin[b];
  feature.values = {set.volume[b],
                    bottom + set.origin.z(),
                    top + set.origin.z(),
                    size.x(),
                    size.y(),
                    size.z(),
                    std::int64_t{b},
                    n_parts,
                    set.material_names[set.material[b]]};
  return feature;
}

}  // namespace

std::vector<VectorLayer> footprint_layers(const BlockSet& set,
                                          const std::vector<std::vector<Vec2>>& source_rings) {
  VectorLayer blocks;
  blocks.name = "blocks";
  blocks.description = "plan outlines of the blocks";
  blocks.type = GeometryType::multi_polygon;
  blocks.qml = vector_qml({SymbolKind::polygon, "", {{"", "", {196, 132, 84, 150}}}, 0.2});
  for (const char* name : {"volume_m3", "bottom_m", "top_m", "longest_m", "middle_m", "shortest_m"})
    blocks.fields.push_back({name, FieldType::real});
  blocks.fields.push_back({"block_id", FieldType::integer});
  blocks.fields.push_back({"n_parts", FieldType::integer});
  blocks.fields.push_back({"material", FieldType::text});
  for (int b = 0; b < n_blocks(set); ++b) blocks.features.push_back(block_feature(set, b));
  std::vector<VectorLayer> layers = {std::move(blocks)};
  if (source_rings.empty()) return layers;
  VectorLayer area;
  area.name = "source_area";
  area.description = "outline of the source";
  area.type = GeometryType::multi_polygon;
  for (const std::vector<Vec2>& ring : source_rings)
    area.features.emplace_back().polygons = {{ring}};
  layers.push_back(std::move(area));
  return layers;
}

}  // namespace talus
