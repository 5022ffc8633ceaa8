// Base motion: records and harmonic motion.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.hpp"
#include "site/base_motion.hpp"

namespace {

using talus::AccelerationRecord;

struct Csv {
  std::string path;
  explicit Csv(const std::string& content)
      : path((std::filesystem::temp_directory_path() /
              ("talus_base_motion_" + std::to_string(::getpid()) + ".csv"))
                 .string()) {
    std::ofstream(path) << content;
  }
  ~Csv() { std::filesystem::remove(path); }
};

TEST(BaseMotion, ReadsColumnsInAnyOrder) {
  const Csv csv(
      "# a remark\naz_m_s2, time_s,ay_m_s2,ax_m_s2,note\r\n3,0,2,1,first\r\n6,0.5,5,4,\n");
  const AccelerationRecord record = talus::read_acceleration_csv(csv.path);
  ASSERT_EQ(record.time.size(), 2u);
  EXPECT_EQ(record.time[1], 0.5);
  EXPECT_EQ(record.acceleration[0], talus::Vec3(1, 2, 3));
  EXPECT_EQ(record.acceleration[1], talus::Vec3(4, 5, 6));
}

TEST(BaseMotion, RefusesWhatIsNoRecord) {
  const std::string names = "time_s,ax_m_s2,ay_m_s2,az_m_s2\n";
  for (const std::string& content :
       {std::string(), names, names + "0,0,0,0\n", names + "0,0,0,0\n0,1,1,1\n",
        names + "0,0,0,0\n1,0,nan,0\n", names + "0,0,0,0\n1,0\n",
        std::string("time,ax,ay,az\n0,0,0,0\n1,0,0,0\n")}) {
    const Csv csv(content);
    EXPECT_THROW((void)talus::read_acceleration_csv(csv.path), talus::InputError) << content;
  }
}

TEST(BaseMotion, OfASiteIsHarmonicFromItsStartToItsEnd) {
  talus::Site site;
  site.base_motion.amplitude_m_s2 = 2;
  site.base_motion.frequency_hz = 1.5;
  site.base_motion.direction_deg = 90;
  site.base_motion.start_s = 1;
  site.base_motion.duration_s = 4;
  const AccelerationRecord record = talus::base_motion(site, 10);
  EXPECT_TRUE(talus::shakes(record));
  EXPECT_TRUE(record.time.empty());
  EXPECT_NEAR((record.harmonic.amplitude - talus::Vec3(2, 0, 0)).norm(), 0, 1e-15);
  EXPECT_NEAR(record.harmonic.angular_frequency, 3 * std::numbers::pi, 1e-15);
  EXPECT_EQ(record.harmonic.start, 1);
  EXPECT_EQ(record.harmonic.end, 5);
  site.base_motion.duration_s = std::nan("");
  EXPECT_EQ(talus::base_motion(site, 10).harmonic.end, 10);
}

TEST(BaseMotion, BeyondAnythingIsRefusedAlsoByItsScale) {
  const auto refusal = [](const talus::Site& site) -> std::string {
    try {
      static_cast<void>(talus::base_motion(site, 1));
    } catch (const talus::InputError& error) {
      return error.what();
    }
    return "taken";
  };
  talus::Site site;
  site.base_motion.amplitude_m_s2 = 10;
  site.base_motion.frequency_hz = 1;
  site.base_motion.scale = 100;
  EXPECT_EQ(refusal(site), "taken");
  site.base_motion.scale = -101;
  EXPECT_NE(refusal(site).find("1010 m/s2, expected at most 1000"), std::string::npos);
  site.base_motion.scale = 1e300;
  EXPECT_NE(refusal(site), "taken");
  const Csv csv("time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,1,0,0\n0.5,0,0,-2000\n2,0,0,0\n");
  talus::Site recorded;
  recorded.base_motion.file = csv.path;
  EXPECT_NE(refusal(recorded).find("2000 m/s2 at 0.5 s"), std::string::npos);
  recorded.base_motion.scale = 0.5;
  EXPECT_EQ(refusal(recorded), "taken");
}

TEST(BaseMotion, IsSaidOnceAndWhole) {
  talus::Site site;
  site.base_motion.frequency_hz = 1;
  EXPECT_THROW((void)talus::base_motion(site, 10), talus::InputError);  // no amplitude
  site.base_motion.amplitude_m_s2 = 2;
  EXPECT_NO_THROW((void)talus::base_motion(site, 10));
  const Csv csv("time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n50,1,0,0\n");
  site.base_motion.frequency_hz = 1;
  site.base_motion.file = csv.path;
  EXPECT_THROW((void)talus::base_motion(site, 10), talus::InputError);  // both
}

TEST(BaseMotion, ThatEndsBeforeTheRunIsRefused) {
  const Csv csv("time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n5,1,0,0\n");
  talus::Site site;
  site.base_motion.file = csv.path;
  EXPECT_EQ(talus::base_motion(site, 5).time.size(), 2u);
  EXPECT_THROW((void)talus::base_motion(site, 5.1), talus::InputError);
}

}  // namespace
