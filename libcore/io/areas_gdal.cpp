// Checks polygons as they are read, and unites those that overlap.
#include "io/areas_gdal.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/source_path.hpp"
#include "io/errors_gdal.hpp"
#include "io/polygons_gdal.hpp"

namespace talus {
namespace {

using Polygons = std::vector<std::unique_ptr<OGRPolygon>>;

// Groups of polygons that meet. Pairs are looked for from west to east, so that each polygon is
// compared with those near it alone.
DisjointSets find_groups(const Polygons& polygons) {
  const std::size_t n = polygons.size();
  std::vector<OGREnvelope> box(n);
  for (std::size_t i = 0; i < n; ++i) polygons[i]->getEnvelope(&box[i]);
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return box[a].MinX < box[b].MinX; });
  DisjointSets groups(n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n && box[order[j]].MinX <= box[order[i]].MaxX; ++j) {
      const int a = order[i], b = order[j];
      if (!box[a].Intersects(box[b]) || groups.root(a) == groups.root(b)) continue;
      if (polygons[a]->Intersects(polygons[b].get())) groups.join(a, b);
    }
  return groups;
}

// The polygons of one group as few as they can be.
Polygons united(const Polygons& polygons, const std::vector<int>& members, const Where& where) {
  const GdalErrors errors;
  OGRMultiPolygon all;
  for (const int member : members) all.addGeometry(polygons[member].get());
  const std::unique_ptr<OGRGeometry> sum(all.UnionCascaded());
  Polygons found;
  if (sum && wkbFlatten(sum->getGeometryType()) == wkbPolygon)
    found.emplace_back(sum->toPolygon()->clone());
  else if (sum && wkbFlatten(sum->getGeometryType()) == wkbMultiPolygon)
    for (const OGRPolygon* polygon : *sum->toMultiPolygon()) found.emplace_back(polygon->clone());
  if (found.empty())
    throw InputError(where, "its polygons cannot be united: " + errors.failure(),
                     "dissolve polygons that overlap into one");
  return found;
}

void check(const OGRPolygon& polygon, const Where& where, const std::string& hint) {
  const GdalErrors errors;
  if (polygon.IsValid()) return;
  const std::string reason = errors.warning().empty() ? errors.failure() : errors.warning();
  throw InputError(where, "the polygon is not sound: " + (reason.empty() ? "no area" : reason),
                   hint);
}

}  // namespace

void check_polygon(const OGRPolygon& polygon, const Where& where) {
  check(polygon, where,
        "put its corners in order there; of many polygons: ogr2ogr -makevalid mended.gpkg " +
            command_words(where.file));
}

void check_polygon(const std::vector<Vec2>& corners, const Where& where) {
  check(polygon_of(corners), where, "put the corners in order around the area");
}

Uniting unite_polygons(Polygons& polygons, const Where& where) {
  DisjointSets groups = find_groups(polygons);
  std::vector<std::vector<int>> members(polygons.size());
  for (int i = 0; i < static_cast<int>(polygons.size()); ++i) members[groups.root(i)].push_back(i);
  Uniting uniting;
  Polygons apart;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (members[i].size() == 1) apart.push_back(std::move(polygons[i]));
    if (members[i].size() < 2) continue;
    Polygons made = united(polygons, members[i], where);
    uniting.n_united += static_cast<int>(members[i].size());
    uniting.n_made += static_cast<int>(made.size());
    std::move(made.begin(), made.end(), std::back_inserter(apart));
  }
  polygons = std::move(apart);
  return uniting;
}

}  // namespace talus
