// libcore/post/profile/whole_bodies.hpp
// Blocks of a run as the bodies that they were at a time: pieces move in their block until it
// breaks, and until then they have its place and its energy (record/pieces.hpp).
#pragma once

#include <map>
#include <span>
#include <vector>

#include "record/run_file.hpp"

namespace talus {

class WholeBodies {
 public:
  /// `run` with its pieces merged, which must outlive this.
  explicit WholeBodies(const RunFile& run);
  /// Rows that are one body with row `b` at `time`; `b` alone where nothing broke.
  [[nodiscard]] std::span<const int> rows_with(int b, double time) const;

 private:
  std::vector<int> body_;                    // of a row                            (n_blocks)
  std::vector<int> row_;                     // 0, 1, 2 ...                         (n_blocks)
  std::map<int, double> born_;               // of a piece [s]
  std::map<int, int> parent_;                // of a piece
  std::map<int, std::vector<int>> rows_of_;  // rows that were part of a body that broke
};

/// A body in a frame.
struct BodyState {
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();  ///< of the centroid, local [m], [m/s]
  double translation = 0, rotation = 0;                   ///< energies [J]
  double top = 0, bottom = 0;  ///< of the highest and lowest vertex above the centroid [m]
};
/// `rows`: that make up the body.
[[nodiscard]] BodyState body_state(const RunFile& run, int frame, std::span<const int> rows);
/// Where its centroid is in plan, local [m].
[[nodiscard]] Vec2 body_place(const RunFile& run, int frame, std::span<const int> rows);

}  // namespace talus
