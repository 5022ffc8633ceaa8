// 10,000 random thin, tiny and fast blocks on a real elevation model.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "import/dem_gdal.hpp"
#include "stability/random_blocks.hpp"

namespace {

using namespace talus;

TEST(RandomBlocksLong, StayAboveRealGroundAndNeverGainEnergy) {
  const std::string dem = std::string(TALUS_SHARED_DIR) + "/data/dem/gschnitz_gar_5m.tif";
  if (!std::filesystem::exists(dem)) GTEST_SKIP() << dem << " is not there";
  const Trn trn = read_trn(dem);
  stability::expect_sound(stability::run_random_blocks(trn, 10000, 5.0, 1), 10000);
}

}  // namespace
