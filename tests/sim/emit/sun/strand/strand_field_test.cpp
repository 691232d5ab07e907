// Strands as a field in space against their definition.
#include "sim/emit/sun/strand/strand_field.h"

#include <gtest/gtest.h>

#include "sim/base/error.h"
#include "sim/base/number/random.h"
#include "sim/emit/sun/strand/closest_point.h"
#include "tests/support/sun_rays.h"

namespace vegard::sim::strand_field_test {
namespace {

constexpr std::uint64_t kSeed = 3;

Strands<double> some_strands() {
  Strands<double> strands;
  for (std::uint32_t n = 0; n < 12; ++n) {
    Strand<double> strand;
    for (std::uint32_t p = 0; p < 4; ++p) {
      const Words w = random_words(kSeed, Stream::strand, n, p);
      strand.points.push_back({2.0 + 6.0 * uniform(w[0]), 6.0 * uniform(w[1]), 6.0 * uniform(w[2])});
    }
    strand.radius_first = 0.3;
    strand.radius_last = n % 2 == 0 ? 0.3 : 0.9;
    strand.along = {1.0, 0.3, 0.8};
    strands.all.push_back(strand);
  }
  return strands;
}

std::array<double, 3> random_place(std::uint32_t n) {
  const Words w = random_words(kSeed, Stream::bundle, n);
  return {1.0 + 8.0 * uniform(w[0]), -1.0 + 8.0 * uniform(w[1]), -1.0 + 8.0 * uniform(w[2])};
}

TEST(StrandField, IsTheSumOfDensities) {
  const Strands<double> strands = some_strands();
  const StrandField field(strands, tests::level_sun(100.0), {2.0}, 1);
  int lit = 0;
  for (std::uint32_t n = 0; n < 5000; ++n) {
    const std::array<double, 3> place = random_place(n);
    double expected = 0.0;
    for (const Strand<double>& strand : strands.all) expected += density_at(strand, strands.falloff, place);
    // Newton's method stops at a millionth of the radius.
    ASSERT_NEAR(field.density_at(place.data()), expected, 1e-5) << n;
    if (expected > 0.0) {
      ++lit;
      EXPECT_FALSE(field.is_dark({{place[0], place[1], place[2]}, {place[0], place[1], place[2]}}));
    }
  }
  EXPECT_GT(lit, 100);
}

TEST(StrandField, RefusesStrandsThatAreTooThinToKeep) {
  const Sun sun = tests::level_sun(100.0);
  Strands<double> strands = some_strands();
  EXPECT_NO_THROW(StrandField(strands, sun, {2.0}, 1, 10 << 20));
  EXPECT_THROW(StrandField(strands, sun, {2.0}, 1, 10 << 10), Error);
  for (Strand<double>& strand : strands.all) strand.radius_first = strand.radius_last = 1e-4;
  EXPECT_THROW(StrandField(strands, sun, {2.0}, 1, 10 << 20), Error);
  // Here numbers of cells would not fit into 32 bits, whatever the memory.
  for (Strand<double>& strand : strands.all) strand.radius_first = strand.radius_last = 1e-10;
  EXPECT_THROW(StrandField(strands, sun, {2.0}, 1, ~std::uint64_t{0}), Error);
}

TEST(StrandField, IsDarkOnlyWhereNothingShines) {
  const StrandField field(some_strands(), tests::level_sun(100.0), {2.0}, 1);
  int dark = 0;
  for (std::uint32_t n = 0; n < 300; ++n) {
    const std::array<double, 3> low = random_place(n);
    const Box3 box{{low[0], low[1], low[2]}, {low[0] + 0.4, low[1] + 0.4, low[2] + 0.4}};
    if (!field.is_dark(box)) continue;
    ++dark;
    for (std::uint32_t k = 0; k < 50; ++k) {
      const Words w = random_words(kSeed, Stream::bundle, n, k, 1);
      const double place[3] = {low[0] + 0.4 * uniform(w[0]), low[1] + 0.4 * uniform(w[1]),
                               low[2] + 0.4 * uniform(w[2])};
      EXPECT_EQ(field.density_at(place), 0.0);
    }
  }
  EXPECT_GT(dark, 20);
  EXPECT_TRUE(field.is_dark({{20.0, 20.0, 20.0}, {30.0, 30.0, 30.0}}));
  EXPECT_FALSE(field.is_dark({{-1e6, -1e6, -1e6}, {1e6, 1e6, 1e6}}));
}

TEST(StrandField, GivesPhotonsOfTheRayleighsAndNothingBelowThePhotosphere) {
  Sun sun = tests::level_sun(100.0);
  sun.radius = 5.0;
  sun.unit_km = 10.0;
  const StrandField field({RadialFalloff::smooth, {tests::straight({0, 0, 0}, {10, 0, 0}, 1.0)}}, sun,
                          {3.0, 0.5}, 2);
  EXPECT_EQ(field.unit_cm(), 1e6);
  const double x[2] = {4.0, 6.0}, y[2] = {0.0, 0.0};
  const double* point[3] = {x, y, y};
  float one[2], other[2], density[2];
  float* emission[2] = {one, other};
  field.sample(2, point, emission, density);
  EXPECT_EQ(one[0], 0.0f);
  // A rayleigh is 1e6 photons cm^-2 s^-1 in a column: here to 1e6 cm.
  EXPECT_FLOAT_EQ(one[1], 3.0f);
  EXPECT_FLOAT_EQ(other[1], 0.5f);
  EXPECT_EQ(density[1], 0.0f);
}

TEST(StrandField, OfNoStrandsIsDark) {
  const StrandField field({RadialFalloff::smooth, {}}, tests::level_sun(100.0), {1.0}, 1);
  EXPECT_TRUE(field.is_dark({{-1, -1, -1}, {1, 1, 1}}));
  const double place[3] = {0.0, 0.0, 0.0};
  EXPECT_EQ(field.density_at(place), 0.0);
}

}  // namespace
}  // namespace vegard::sim::strand_field_test
