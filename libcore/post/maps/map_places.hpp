// libcore/post/maps/map_places.hpp: public
// What stands on a map beside its values: the source, fences, objects.
#pragma once

#include <vector>

#include "record/run_file.hpp"

namespace talus {

struct MapPlaces {
  std::vector<std::vector<Vec2>> source;  ///< a ring for each block as cut, local [m]
  std::vector<RecordLine>
      lines;  ///< fences, and lines that stop nothing; no candidates of a search
  std::vector<RecordObject> objects;
};

/// Adds what a run has, read with its lines and objects. Of lines and objects of one name the first
/// is kept, of lines one that stood.
void add_places(MapPlaces& places, const RunFile& run);

}  // namespace talus
