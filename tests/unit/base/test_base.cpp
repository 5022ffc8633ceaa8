// Random numbers, SHA-256, numbers as text, words of XML: the small tools of base/.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "base/random.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"

using namespace talus;

TEST(Where, NamesFileLineAndItem) {
  EXPECT_EQ((Where{"site.toml", 14}).text(), "site.toml:14");
  EXPECT_EQ((Where{"map.gpkg", 0, "layer a, feature 3"}).text(), "map.gpkg: layer a, feature 3");
  EXPECT_EQ((Where{}).text(), "");
  const InputError error({"site.toml", 14}, "friction_deg is 250, expected 0 to below 90",
                         "use degrees");
  EXPECT_STREQ(error.what(), "site.toml:14: friction_deg is 250, expected 0 to below 90");
  EXPECT_EQ(error.hint(), "use degrees");
}

TEST(Text, DoubleReadsBackExactly) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const double value = random.normal() * std::pow(10, random.uniform(-300, 300));
    double back = 0;
    ASSERT_TRUE(parse_double(text(value), back));
    EXPECT_EQ(back, value);
  }
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(12.3456, 4), "12.35");
}

TEST(Text, OnlyWholeFiniteNumbersAreRead) {
  double value = 7;
  for (const char* bad : {"", " ", "1,5", "12 m", "nan", "inf", "1e999", "0x1p3", "--1"})
    EXPECT_FALSE(parse_double(bad, value)) << bad;
  EXPECT_EQ(value, 7);
  EXPECT_TRUE(parse_double(" +1.5e3\r", value));
  EXPECT_EQ(value, 1500);
}

TEST(Folded, PartsLongLinesBehindSemicolons) {
  EXPECT_EQ(folded("a b; c", 24), "a b; c");
  EXPECT_EQ(folded("run_1: aaaa bbbb; cccc dddd; eeee ffff gggg hhhh; x", 24),
            "run_1: aaaa bbbb;\n  cccc dddd;\n  eeee ffff gggg hhhh; x");
  EXPECT_EQ(folded("one phrase without an end; x", 24), "one phrase without an end;\n  x");
  EXPECT_EQ(folded("one phrase without any place", 24), "one phrase without any place");
  EXPECT_EQ(folded("1234567890; 1234567890; ", 12), "1234567890;\n  1234567890;\n  ");
}

TEST(NearestName, FindsTheMisspeltAndLeavesTheUnlike) {
  const std::vector<std::string> known = {"friction_deg", "cohesion_pa", "tension_pa"};
  EXPECT_EQ(nearest_name("fricton_deg", known), "friction_deg");
  EXPECT_EQ(nearest_name("tensoin_pa", known), "tension_pa");
  EXPECT_EQ(nearest_name("colour", known), "");
}

TEST(Sha256Test, EqualsPublishedDigests) {
  const auto digest = [](const std::string& bytes) {
    Sha256 hash;
    hash.add(bytes.data(), bytes.size());
    return hash.hex();
  };
  EXPECT_EQ(digest(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(digest(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256Test, DoesNotDependOnHowBytesArrive) {
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(i * 7);
  Sha256 whole;
  whole.add(bytes.data(), bytes.size());
  Random random(2);
  Sha256 parts;
  for (size_t at = 0; at < bytes.size();) {
    const size_t n = std::min<size_t>(1 + random.below(130), bytes.size() - at);
    parts.add(bytes.data() + at, n);
    at += n;
  }
  EXPECT_EQ(whole.hex(), parts.hex());
}

TEST(Random, SameSeedSameNumbersOtherStreamOtherNumbers) {
  Random a(5, "joints"), b(5, "joints"), c(5, "release");
  int n_equal = 0;
  for (int i = 0; i < 100; ++i) {
    const double value = a.uniform();
    EXPECT_EQ(value, b.uniform());
    n_equal += value == c.uniform() ? 1 : 0;
  }
  EXPECT_EQ(n_equal, 0);
}

// Means and variances within five standard errors of 1e5 draws.
TEST(Random, DistributionsHaveTheirMoments) {
  Random random(3);
  const int n = 100000;
  double normal = 0, normal_sq = 0, exponential = 0, uniform = 0;
  int n_low = 0;
  for (int i = 0; i < n; ++i) {
    const double z = random.normal();
    normal += z, normal_sq += z * z;
    exponential += random.exponential();
    uniform += random.uniform(2, 4);
    n_low += random.below(10) < 3 ? 1 : 0;
  }
  EXPECT_NEAR(normal / n, 0, 5 / std::sqrt(n));
  EXPECT_NEAR(normal_sq / n, 1, 5 * std::sqrt(2.0 / n));
  EXPECT_NEAR(exponential / n, 1, 5 / std::sqrt(n));
  EXPECT_NEAR(uniform / n, 3, 5 * std::sqrt(1.0 / 3 / n));
  EXPECT_NEAR(n_low / double(n), 0.3, 5 * std::sqrt(0.21 / n));
}

TEST(XmlEscaped, NothingOfTheTextIsMarkup) {
  EXPECT_EQ(xml_escaped("<a href=\"x\">&</a>"), "&lt;a href=&quot;x&quot;&gt;&amp;&lt;/a&gt;");
  EXPECT_EQ(xml_escaped(std::string("a\0b\001c\nd", 7)), "abc\nd");
}
