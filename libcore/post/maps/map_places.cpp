// Places on a map beside its values: the source, fences, objects.
#include "post/maps/map_places.hpp"

#include <algorithm>

#include "post/deposit.hpp"

namespace talus {
namespace {

template <class Named>
auto named(std::vector<Named>& all, const std::string& name) {
  return std::find_if(all.begin(), all.end(), [&name](const Named& a) { return a.name == name; });
}

}  // namespace

void add_places(MapPlaces& places, const RunFile& run) {
  for (int block = 0; block < n_blocks(run); ++block)
    places.source.push_back(footprint(run, block, run.blocks.rest[block]));
  for (const RecordLine& line : run.lines) {
    if (is_candidate(line) || is_before_dam(line)) continue;
    const auto known = named(places.lines, line.name);
    if (known == places.lines.end())
      places.lines.push_back(line);
    else if (line.standing && !known->standing)
      *known = line;
  }
  for (const RecordObject& object : run.objects)
    if (named(places.objects, object.name) == places.objects.end())
      places.objects.push_back(object);
}

}  // namespace talus
