// Blocks of a run as whole bodies until they break into their pieces.
#include "post/profile/whole_bodies.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "record/motion.hpp"

namespace talus {
namespace {

double mass_of(const RunFile& run, std::span<const int> rows) {
  double mass = 0;
  for (const int row : rows) mass += run.blocks.mass[row];
  return mass;
}

}  // namespace

WholeBodies::WholeBodies(const RunFile& run) : row_(n_blocks(run)) {
  std::iota(row_.begin(), row_.end(), 0);
  body_ = run.blocks.body.empty() ? row_ : run.blocks.body;
  for (const Break& broken : run.breaks)
    for (const int piece : {broken.first_piece, broken.first_piece + 1}) {
      born_[piece] = broken.time;
      parent_[piece] = broken.block;
    }
  for (const int row : row_)
    for (auto at = parent_.find(body_[row]); at != parent_.end(); at = parent_.find(at->second))
      rows_of_[at->second].push_back(row);
}

std::span<const int> WholeBodies::rows_with(int b, double time) const {
  int body = body_[b];
  for (auto at = born_.find(body); at != born_.end() && at->second > time; at = born_.find(body))
    body = parent_.at(body);
  const auto found = rows_of_.find(body);
  return found == rows_of_.end() ? std::span(&row_[b], 1) : std::span(found->second);
}

BodyState body_state(const RunFile& run, int frame, std::span<const int> rows) {
  const double mass = mass_of(run, rows);
  BodyState out;
  double energy = 0, top = -std::numeric_limits<double>::infinity(), bottom = -top;
  for (const int b : rows) {
    const FrameBlock at = frame_block(run, frame, b);
    out.position += run.blocks.mass[b] / mass * at.position;
    out.velocity += run.blocks.mass[b] / mass * at.velocity;
    const Vec3 spin = at.attitude.conjugate() * at.spin;  // body axes
    energy += translational_energy(run.blocks.mass[b], at.velocity) +
              0.5 * spin.cwiseAbs2().dot(run.blocks.inertia[b]);
    for (int v = run.blocks.vertex_begin[b]; v < run.blocks.vertex_begin[b + 1]; ++v) {
      const double z = at.position.z() + (at.attitude * run.blocks.vertices[v]).z();
      top = std::max(top, z);
      bottom = std::min(bottom, z);
    }
  }
  out.translation = translational_energy(mass, out.velocity);
  out.rotation = energy - out.translation;
  out.top = top - out.position.z();
  out.bottom = bottom - out.position.z();
  return out;
}

Vec2 body_place(const RunFile& run, int frame, std::span<const int> rows) {
  if (rows.size() == 1) return frame_block(run, frame, rows[0]).position.head<2>();
  const double mass = mass_of(run, rows);
  Vec2 place = Vec2::Zero();
  for (const int b : rows)
    place += run.blocks.mass[b] / mass * frame_block(run, frame, b).position.head<2>();
  return place;
}

}  // namespace talus
