// libcore/post/fence_search/paths.hpp: public
// Crossings of lines that nobody watched, from the frames of runs: for lines that are moved after
// the runs.
// in:    frames near some lines
// out:   crossings of any line among these, linear between two frames; a search for the best place
//        about a fence
// Against recorded crossings: energy within 2.4 % for 9 of 10 crossings, none missed (frames of
// 0.1 s).
#pragma once

#include <vector>

#include "post/fence_search/search.hpp"
#include "record/run_file.hpp"

namespace talus {

/// A block in a frame.
struct PathPoint {
  double time = 0;                    ///< [s]
  Vec3 position = Vec3::Zero();       ///< of the centroid, local [m]
  float speed = 0;                    ///< [m/s]
  float energy = 0, spin_energy = 0;  ///< of translation, of rotation [J]
  float top = 0, bottom = 0;          ///< of the highest and lowest vertex above the centroid [m]
};
/// A piece of a block's path near the lines; frames one after the other.
struct BlockPath {
  int run = 0, block = 0;  ///< block: among those of all runs
  int number = 0;          ///< of the block in its run
  double weight = 1, volume = 0;
  double on_object = 0;  ///< when it touches the object, infinite: never [s]
  std::vector<PathPoint> points;
};

/// Where paths are kept: within `margin` of any of the lines, in plan.
struct Corridor {
  std::vector<std::vector<Vec2>> lines;
  double margin = 15;  ///< [m]
};
/// The pieces of all blocks of a run; none where it has no frames between the first and the last.
/// `first_block`: number of its block 0 among the blocks of all runs; `on_object` of each block.
void add_paths(std::vector<BlockPath>& paths, const RunFile& run, int run_index, int first_block,
               const std::vector<double>& on_object, const Corridor& corridor);

/// The line of the posts, with its crossings. `side`: +1 blocks come from the left.
[[nodiscard]] SearchLine line_of_paths(const std::vector<BlockPath>& paths,
                                       const std::vector<Vec3>& posts, int side);

/// Limits for a line that is moved.
struct RefineLimits {
  double offset = 2.5;   ///< of a move of the whole line, or of one post [m]
  double farthest = 10;  ///< that a post may be moved away [m]
  double line_slope = 0.36, ground_slope = 1.2;  ///< tangents [-]
  double nearest = 0;                            ///< to the object, in plan [m]
  const RecordObject* object = nullptr;
  int most_rounds = 12;
};
/// A fence with its own line.
struct RefinedFence {
  SearchLine line;
  FenceOption option;  ///< of lines {line}
  int n_moves = 0;     ///< that made it cheaper
  int n_tried = 0;
};
/// Moves the whole line, single posts and both ends as long as the fence gets cheaper and meets
/// what is asked for. `start`: a fence on one line, whose crossings may have been recorded.
[[nodiscard]] RefinedFence refine(const SearchRuns& runs, const std::vector<BlockPath>& paths,
                                  const Fence& start, int side, const DesignCode& code,
                                  const SearchSettings& settings, const Trn& trn,
                                  const RefineLimits& limits);

}  // namespace talus
