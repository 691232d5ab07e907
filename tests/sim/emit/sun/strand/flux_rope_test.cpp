#include "sim/emit/sun/strand/flux_rope.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "sim/emit/sun/strand/strand_emitter.h"
#include "tests/support/light_derivatives.h"
#include "tests/support/seeded_numbers.h"
#include "tests/support/sun_rays.h"

namespace vegard::sim::flux_rope_test {
namespace {

using tests::plain_double;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// At longitude 0, in the plane of the sky.
struct Eruption {
  Sun sun = tests::level_sun(4000.0);
  double instant_s = 0.0;
  Ejection ejection;

  Eruption() {
    sun.radius = 700.0;
    ejection.longitude_deg = 90.0;
    ejection.bearing_deg = 20.0;
    ejection.start_height = 50.0;
    ejection.speed_km_s = 1.0;
    ejection.strands = 12;
    ejection.strand_radius = 0.4;
    ejection.rayleigh = {1.0};
  }
  Strands<double> strands() const { return rope_strands<double>(sun, instant_s, ejection, plain_double); }
  StrandEmitter<double> emitter(const Sun& stop) const {
    return {strands(), stop, SunFrame<double>(sun, plain_double), {1.0}};
  }
};

TEST(FluxRope, FrontRisesAndFeetStay) {
  Eruption e;
  e.ejection.strands = 400;  // some come close to the disc's rim
  for (const double age : {0.0, 100.0, 3000.0}) {
    e.ejection.age_s = 0.25 * age;
    e.instant_s = 0.75 * age;
    double farthest = 0.0, foot = 0.0;
    for (const Strand<double>& s : e.strands().all) farthest = std::max(farthest, length3(s.points[0]));
    // Rope radius a quarter of the front's height; the outermost strand at sqrt(1 - 1/800) of it, and nodes
    // a sixteenth of a turn or less from the top.
    const double front = 50.0 + age;
    EXPECT_LE(farthest, 700.0 + front + 1e-9);
    EXPECT_GE(farthest, 700.0 + 0.97 * front);
    const Strands<double> strands = e.strands();
    const std::size_t pieces = strands.all.size() / 400;
    for (int k = 0; k < 400; ++k) {
      const auto& p = strands.all[k * pieces].points[0];
      foot = std::max(foot, std::acos(std::min(p[1] / length3(p), 1.0)) / kDegree);
      EXPECT_NEAR(length3(p), 700.0 - 3.75, 3.75) << "below the photosphere, slanting a little";
    }
    // Half the width, and the foot's radius 0.3 · 0.25 · 50 of 700, which is 0.31 degrees; a slant of up to
    // 25 degrees shortens that by a tenth.
    EXPECT_NEAR(foot, 20.0 + 3.75 / 700.0 / kDegree, 0.04);
  }
}

TEST(FluxRope, BeforeItsTimeItStands) {
  Eruption e;
  e.instant_s = -500.0;
  EXPECT_EQ(front_height<double>(e.sun, e.instant_s, e.ejection, plain_double), 50.0 + 100.0);
  e.ejection.age_s = 100.0;
  EXPECT_EQ(front_height<double>(e.sun, e.instant_s, e.ejection, plain_double), 50.0);
}

// r0 + v t + a t² / 2, in the Sun's unit of 10 km; slowed down it comes to rest at v² / 2 |a| over r0.
TEST(FluxRope, FrontMovesByItsSpeedAndAcceleration) {
  Eruption e;
  e.sun.unit_km = 10.0;
  e.ejection.age_s = 0.0;
  e.ejection.speed_km_s = 300.0;
  const auto front = [&](double age) { return front_height<double>(e.sun, age, e.ejection, plain_double); };
  for (const double acceleration : {0.0, 25.0, 400.0, -50.0}) {
    e.ejection.acceleration_m_s2 = acceleration;
    for (const double age : {0.0, 60.0, 1000.0, 5000.0})
      EXPECT_NEAR(front(age), 50.0 + (300.0 * age + 0.5e-3 * acceleration * age * age) / 10.0,
                  1e-9 * front(age))
          << acceleration << " " << age;
  }
  // At 6000 s, 900 000 km up.
  EXPECT_NEAR(front(6000.0), 50.0 + 90000.0, 1e-6);
  EXPECT_NEAR(front(20000.0), 50.0 + 90000.0, 1e-6);
}

TEST(FluxRope, WindingsAreWhole) {
  Eruption e;
  e.ejection.age_s = 800.0;
  const Strands<double> strands = e.strands();
  const std::size_t pieces = strands.all.size() / 12;
  for (std::size_t i = 0; i + 1 < strands.all.size(); ++i) {
    if ((i + 1) % pieces == 0) continue;
    const Strand<double>&a = strands.all[i], &b = strands.all[i + 1];
    EXPECT_NEAR(length3(minus3(a.points[3], b.points[0])), 0.0, 1e-9);
    EXPECT_EQ(a.radius_last, b.radius_first);
    // No kink either: as fast and in the same direction.
    EXPECT_NEAR(length3(minus3(minus3(a.points[3], a.points[2]), minus3(b.points[1], b.points[0]))), 0.0,
                1e-9);
  }
}

// Three strands at (share, phase) of a disc tell where its middle is: the weights that leave nothing of the
// shares. What is not wound stands at a right angle to the way from the disc before to the one after, but for
// what a chord of an eighth of the arch departs from the tangent.
TEST(FluxRope, DiscsStandAcrossTheAxis) {
  Eruption e;
  e.ejection.strands = 3;
  e.ejection.turns = 0.0;
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  Eigen::Matrix3d of_strand;
  for (int k = 0; k < 3; ++k) {
    const double share = std::sqrt((k + 0.5) / 3.0);
    of_strand.col(k) << 1.0, share * std::cos(golden * k), share * std::sin(golden * k);
  }
  const Eigen::Vector3d weight = of_strand.inverse() * Eigen::Vector3d(1.0, 0.0, 0.0);
  for (const double age : {0.0, 800.0}) {
    e.ejection.age_s = age;
    const std::vector<Strand<double>> all = e.strands().all;
    const std::size_t pieces = all.size() / 3;
    const auto node = [&](int k, std::size_t j) {
      const auto& p = all[static_cast<std::size_t>(k) * pieces + j].points[0];
      return Eigen::Vector3d(p[0], p[1], p[2]);
    };
    const auto middle = [&](std::size_t j) {
      return Eigen::Vector3d(weight[0] * node(0, j) + weight[1] * node(1, j) + weight[2] * node(2, j));
    };
    for (std::size_t j = 1; j + 1 < pieces; ++j) {
      const Eigen::Vector3d along = (middle(j + 1) - middle(j - 1)).normalized();
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((node(k, j) - middle(j)).normalized().dot(along), 0.0, 0.02)
            << "node " << j << " at " << age << " s";
    }
  }
}

TEST(FluxRope, KeepsItsMass) {
  // On a film of the whole rope, which nothing hides. Cells are a tenth of a strand's radius at its top, or a
  // pixel where it is narrower: what ThinStrandsKeepTheirLightOnAnyFilm allows.
  Eruption e;
  e.sun.distance_km = 1e7;
  Sun nothing = e.sun;
  nothing.radius = 0.0;
  double before = 0.0;
  for (const double age : {0.0, 200.0, 1500.0}) {
    e.ejection.age_s = age;
    const double mass = tests::light_of_film(e.emitter(nothing), 1e7, 1.1 * (750.0 + age), 220);
    if (before > 0.0) {
      EXPECT_NEAR(mass / before, 1.0, 0.02);
    }
    before = mass;
  }
  EXPECT_GT(before, 0.0);
}

TEST(FluxRope, DerivativesAreThoseOfItsLight) {
  Eruption e;
  e.ejection.age_s = 400.0;
  Ejection& j = e.ejection;
  const std::vector<double*> numbers = {&j.latitude_deg,
                                        &j.longitude_deg,
                                        &j.bearing_deg,
                                        &j.width_deg,
                                        &j.speed_km_s,
                                        &j.start_height,
                                        &j.age_s,
                                        &j.aspect,
                                        &j.turns,
                                        &j.strand_radius,
                                        &j.density,
                                        &e.sun.distance_km,
                                        &e.sun.latitude_deg,
                                        &j.acceleration_m_s2};
  const NumberAs<FreeDual> number = tests::seeded({numbers.begin(), numbers.end()});
  const StrandEmitter<FreeDual> dual(rope_strands<FreeDual>(e.sun, e.instant_s, j, number), e.sun,
                                     SunFrame<FreeDual>(e.sun, number), {FreeDual(1.0)});
  std::vector<std::array<double, 2>> places;
  for (int k = 0; k < 12; ++k) places.push_back({1010.0 + 20.0 * k, 200.0 * std::sin(3.0 * k)});
  const auto make = [&] { return std::make_unique<StrandEmitter<double>>(e.emitter(e.sun)); };
  EXPECT_GE(tests::expect_light_derivatives(dual, numbers, make, 4000.0, places, 1e-3), 7);
}

}  // namespace
}  // namespace vegard::sim::flux_rope_test
