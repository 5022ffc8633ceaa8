// Digest of a terrain: ties blocks and runs to their ground.
#include "io/trn_digest.hpp"

#include <array>
#include <cmath>

#include "base/sha256.hpp"

namespace talus {

std::string trn_digest(const Trn& trn) {
  Sha256 hash;
  const Vec2 corner = trn.node0 + trn.origin.head<2>();
  const std::array<double, 6> frame = {static_cast<double>(trn.n_rows),
                                       static_cast<double>(trn.n_cols),
                                       trn.cell_size,
                                       corner.x(),
                                       corner.y(),
                                       trn.origin.z()};
  hash.add(frame.data(), sizeof frame);
  for (const double z : trn.elevation) {
    const double value = std::isnan(z) ? -9999 : z;  // one pattern of bits for all unknown nodes
    hash.add(&value, sizeof value);
  }
  return hash.hex();
}

}  // namespace talus
