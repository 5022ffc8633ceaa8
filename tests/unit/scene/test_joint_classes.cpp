// Classes of joint faces: friction and restitution of pairs.
#include <gtest/gtest.h>

#include "scene/bonds.hpp"
#include "scene/joint_classes.hpp"

namespace {

using namespace talus;

GroundClass rock(double friction, double restitution) {
  GroundClass out;
  out.friction = friction;
  out.restitution = restitution;
  return out;
}

// Two blocks that touch with faces of sets `set_a` and `set_b`, -1: of no set.
PairManifold touching(int set_a, int set_b) {
  PairManifold m{};
  m.block_a = 0;
  m.block_b = 1;
  m.joint_set_a = set_a;
  m.joint_set_b = set_b;
  return m;
}

TEST(JointClasses, WithoutAnyThePairHasTheClassOfTheScene) {
  Scene scene;
  scene.joint = rock(0.7, 0.3);
  EXPECT_EQ(pair_class(scene, touching(2, -1)).friction, 0.7);
  EXPECT_EQ(pair_class(scene, touching(2, -1)).restitution, 0.3);
}

TEST(JointClasses, ThePairHasTheSmallerFrictionAndRestitutionOfItsRocks) {
  Scene scene;
  scene.joints.of_block = {rock(0.8, 0.2), rock(0.6, 0.4)};
  const GroundClass pair = pair_class(scene, touching(-1, -1));
  EXPECT_EQ(pair.friction, 0.6);
  EXPECT_EQ(pair.restitution, 0.2);
}

// A face of a set has the set's friction and strength; a set without friction that of the rock.
TEST(JointClasses, AFaceOfASetHasItsFrictionAndStrength) {
  Scene scene;
  scene.joints.of_block = {rock(0.8, 0.2), rock(0.9, 0.4)};
  GroundClass filled = rock(0.3, 0), rough = rock(-1, 0);
  filled.cohesion = filled.tension = 1000;
  rough.cohesion = rough.tension = 500;
  scene.joints.of_set = {filled, rough};
  const GroundClass both_filled = pair_class(scene, touching(0, 0)),
                    both_rough = pair_class(scene, touching(1, 1)),
                    one_bare = pair_class(scene, touching(0, -1));
  EXPECT_EQ(both_filled.friction, 0.3);
  EXPECT_EQ(both_filled.cohesion, 1000);
  EXPECT_EQ(both_rough.friction, 0.8);
  EXPECT_EQ(both_rough.tension, 500);
  EXPECT_EQ(one_bare.friction, 0.3);
  EXPECT_EQ(one_bare.cohesion, 0);
}

}  // namespace
