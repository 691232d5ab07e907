#include "fit/photo/pointing/blind/asterisms.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "fit/photo/pointing/catalogue_sky.h"

namespace vegard::tests::asterisms_test {
namespace {

const std::vector<Eigen::Vector3d> kFour = {
    Eigen::Vector3d(0.1, 0.2, 1.0).normalized(), Eigen::Vector3d(-0.2, 0.15, 1.0).normalized(),
    Eigen::Vector3d(0.05, -0.1, 1.0).normalized(), Eigen::Vector3d(-0.03, 0.12, 1.0).normalized()};

// The code is of the figure alone: a rotation of the sphere and another order change nothing.
TEST(Asterisms, CodesDoNotTurn) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  std::vector<Eigen::Vector3d> turned;
  for (const Eigen::Vector3d& v : kFour) turned.push_back(turn * v);
  fit::Asterism one, other;
  ASSERT_TRUE(fit::make_asterism(kFour, {0, 1, 2, 3}, one));
  ASSERT_TRUE(fit::make_asterism(turned, {3, 1, 0, 2}, other));
  EXPECT_EQ(one.members, other.members);
  EXPECT_NEAR(one.size_rad, other.size_rad, 1e-12);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(one.code[i], other.code[i], 1e-12);
}

// The mirror image has another code: the sky's right way round can be told.
TEST(Asterisms, MirrorImagesDiffer) {
  std::vector<Eigen::Vector3d> mirrored;
  for (const Eigen::Vector3d& v : kFour) mirrored.emplace_back(-v[0], v[1], v[2]);
  fit::Asterism one, other;
  ASSERT_TRUE(fit::make_asterism(kFour, {0, 1, 2, 3}, one));
  ASSERT_TRUE(fit::make_asterism(mirrored, {0, 1, 2, 3}, other));
  EXPECT_NEAR(one.code[1], -other.code[1], 1e-12);
  EXPECT_GT(std::abs(one.code[1]), 0.05);
}

// Every figure of neighbouring bright stars is found by its own code: the Plough's bowl and handle's root.
TEST(Asterisms, TheIndexHasThePlough) {
  std::vector<Eigen::Vector3d> places;
  fit::AsterismMembers plough{};
  int n = 0;
  const std::vector<fit::StarSighting>& sky = fit::equatorial_sky();
  for (std::size_t i = 0; i < sky.size(); ++i) {
    places.emplace_back(sky[i].enu[0], sky[i].enu[1], sky[i].enu[2]);
    for (const char* name : {"Dubhe", "Merak", "Phecda", "Alioth"})
      if (sky[i].name == name) plough[n++] = static_cast<int>(i);
  }
  ASSERT_EQ(n, 4);
  fit::Asterism figure;
  ASSERT_TRUE(fit::make_asterism(places, plough, figure));
  std::vector<const fit::Asterism*> found;
  fit::bright_star_asterisms().find(figure, 0.01, 1.1, found);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                          [&](const fit::Asterism* one) { return one->members == figure.members; }));
}

TEST(Asterisms, CoincidingStarsMakeNone) {
  fit::Asterism one;
  EXPECT_FALSE(fit::make_asterism({kFour[0], kFour[0], kFour[0], kFour[0]}, {0, 1, 2, 3}, one));
}

}  // namespace
}  // namespace vegard::tests::asterisms_test
