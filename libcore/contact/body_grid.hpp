// libcore/contact/body_grid.hpp: public
// Bodies that do not move, by place: finds those near a box without a look at all of them.
// in:    centres and radii of balls around the bodies
// out:   candidates for a box
#pragma once

#include <span>
#include <vector>

#include "base/types.hpp"
#include "contact/neighbours.hpp"

namespace talus {

/// A grid of square columns; each lists the bodies whose balls reach into it.
struct BodyGrid {  // clang-format off
  int n_bodies = 0;
  Vec2 low = Vec2::Zero();         ///< south-west corner [m]
  double cell_size = 0;            ///< [m]
  int nx = 0, ny = 0;
  std::vector<int> begin;          ///< of column iy nx + ix in `bodies`              (nx ny + 1)
  std::vector<int> bodies;         ///< ascending in each column
};  // clang-format on

[[nodiscard]] BodyGrid make_body_grid(std::span<const Vec3> centre, std::span<const double> radius);

/// Replaces `near` by the bodies in the columns of `box`, ascending: at least those whose ball
/// meets it. All of them where `box` is not finite.
void find_near(const BodyGrid& grid, const Box& box, std::vector<int>& near);

}  // namespace talus
