// Makes the layers of block footprints: convex outlines in plan, with volumes and dimensions.
#include "io/footprints_gdal.hpp"

#include <algorithm>

#include "geometry/convex_outline.hpp"
#include "io/style.hpp"

namespace talus {
namespace {

std::vector<Vec2> footprint(const BlockSet& set, int b) {
  std::vector<Vec2> points;
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v)
    points.emplace_back(set.vertices[v].head<2>() + set.origin.head<2>());
  return convex_outline(std::move(points));
}

struct BlockRow {
  const BlockSet& set;
  int b;
  double bottom, top;  // local [m]
  Vec3 size;           // [m]
};

BlockRow row_of(const BlockSet& set, int b) {
  double bottom = set.vertices[set.block_vertex_begin[b]].z(), top = bottom;
  for (int v = set.block_vertex_begin[b]; v < set.block_vertex_begin[b + 1]; ++v) {
    bottom = std::min(bottom, set.vertices[v].z());
    top = std::max(top, set.vertices[v].z());
  }
  return {set, b, bottom, top, extents({set.volume[b], set.centroid[b], set.second_moment[b]})};
}

const std::vector<Field<BlockRow>>& block_fields() {
  using Value = FieldValue;
  using Row = const BlockRow&;
  static const std::vector<Field<BlockRow>> fields = {
      {"volume_m3", "m3", "Volume", [](Row r) -> Value { return r.set.volume[r.b]; }},
      {"bottom_m", "m", "Elevation of the lowest point",
       [](Row r) -> Value { return r.bottom + r.set.origin.z(); }},
      {"top_m", "m", "Elevation of the top",
       [](Row r) -> Value { return r.top + r.set.origin.z(); }},
      {"longest_m", "m", "Longest extent", [](Row r) -> Value { return r.size.x(); }},
      {"middle_m", "m", "Middle extent", [](Row r) -> Value { return r.size.y(); }},
      {"shortest_m", "m", "Shortest extent", [](Row r) -> Value { return r.size.z(); }},
      {"block_id", "", "Block", [](Row r) -> Value { return r.b; }, FieldType::integer},
      {"n_parts", "", "Number of convex parts",
       [](Row r) -> Value {
         return r.set.convex_part_begin[r.b + 1] - r.set.convex_part_begin[r.b];
       },
       FieldType::integer},
      {"material", "", "Material",
       [](Row r) -> Value { return r.set.material_names[r.set.material[r.b]]; }, FieldType::text}};
  return fields;
}

}  // namespace

std::vector<VectorLayer> footprint_layers(const BlockSet& set,
                                          const std::vector<std::vector<Vec2>>& source_rings) {
  VectorLayer blocks{
      "blocks",
      "plan outlines of the blocks",
      GeometryType::multi_polygon,
      vector_fields(block_fields()),
      {},
      vector_qml({SymbolKind::polygon, "", {{"", "block", {196, 132, 84, 150}}}, 0.2})};
  for (int b = 0; b < n_blocks(set); ++b) {
    VectorFeature& feature = blocks.features.emplace_back();
    feature.polygons = {{footprint(set, b)}};
    feature.values = values_of(block_fields(), row_of(set, b));
  }
  std::vector<VectorLayer> layers = {std::move(blocks)};
  if (!source_rings.empty())
    layers.push_back(
        {"source_area", "the polygon of the source", GeometryType::multi_polygon, {}, {}, ""});
  for (const std::vector<Vec2>& ring : source_rings)
    layers.back().features.emplace_back().polygons = {{ring}};
  return layers;
}

}  // namespace talus
