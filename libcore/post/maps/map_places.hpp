// libcore/post/maps/map_places.hpp: public
// Places on a map beside its values: the source, fences, objects.
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

/// Up to which distance footprints are drawn as one source: the blocks of a mass nearly touch,
/// those of rocks one by one lie within 4 mm of a map at 1 : `scale` [m].
[[nodiscard]] inline double source_gap(bool is_one_by_one, double scale) {
  return is_one_by_one ? 0.004 * scale : 0.2;
}

/// Adds the places of a run, read with its lines and objects. Of lines and objects of one name the
/// first is kept; of lines, one with a built fence.
void add_places(MapPlaces& places, const RunFile& run);

}  // namespace talus
