// Layers at the limb, of light whose heights are known.
#include "fit/measure/limb_layer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sim/base/number/constants.h"

namespace vegard::fit::limb_layer_test {
namespace {

constexpr double kObserverKm = 390.0;

/// Abel's integral of a layer of constant emission between two altitudes has a closed form: the length of
/// the line inside.
double slab_column_km(double tangent_km, double low_km, double high_km) {
  const auto half = [&](double z_km) {
    const double h = sim::kEarthRadiusKm + tangent_km, z = sim::kEarthRadiusKm + z_km;
    return z > h ? std::sqrt(z * z - h * h) : 0.0;
  };
  return 2.0 * (half(high_km) - half(low_km));
}

/// The layer as a stack of slabs, each with the emission of its middle.
double stacked_column_km(double tangent_km, double peak_km, double lower_km, double upper_km) {
  constexpr double kSlabKm = 0.05;
  double sum = 0.0;
  for (double z = peak_km - 60.0; z < peak_km + 100.0; z += kSlabKm) {
    const double off =
        (z + 0.5 * kSlabKm - peak_km) / (z < peak_km ? peak_km - lower_km : upper_km - peak_km);
    sum += std::exp2(-off * off) * slab_column_km(tangent_km, z, z + kSlabKm);
  }
  return sum;
}

TEST(LimbLayer, ColumnIsThatOfSlabs) {
  for (const double tangent_km : {0.0, 60.0, 90.0, 96.0, 105.0, 125.0}) {
    const double slabs_km = stacked_column_km(tangent_km, 96.0, 91.0, 106.0);
    EXPECT_NEAR(limb_column_km(tangent_km, 96.0, 91.0, 106.0), slabs_km, 2e-3 * slabs_km) << tangent_km;
  }
}

// Noise of 1 % of the peak on 60 points. Seed 29028787. Told are 4 of the error bars, which themselves are
// known to a tenth from 55 degrees of freedom.
TEST(LimbLayer, IsFoundWhereItIs) {
  std::mt19937_64 random(29028787);
  std::normal_distribution<double> normal;
  std::vector<double> tangent_km, light;
  const double max_km = stacked_column_km(93.0, 96.0, 91.0, 106.0);
  for (double h = 10.0; h < 200.0; h += 3.0) {
    tangent_km.push_back(h);
    // Below 40 km there is other light, which may not matter.
    const double clouds = h < kLimbAirKm ? 5.0 : 0.0;
    light.push_back(0.02 + clouds +
                    0.4 * (stacked_column_km(h, 96.0, 91.0, 106.0) / max_km + 0.01 * normal(random)));
  }
  const std::optional<LimbLayer> layer = find_limb_layer(tangent_km, light, kObserverKm);
  ASSERT_TRUE(layer);
  EXPECT_NEAR(layer->peak_km, 96.0, 4.0 * layer->sigma_peak_km);
  EXPECT_LT(layer->sigma_peak_km, 1.0);
  EXPECT_NEAR(layer->upper_km, 106.0, 2.0);
  EXPECT_NEAR(layer->lower_km, 91.0, 2.0);
  EXPECT_LT(layer->apparent_peak_km, layer->peak_km) << "the limb is brightest below the layer's middle";
  EXPECT_GT(layer->apparent_peak_km, layer->lower_km - 2.0);
  EXPECT_NEAR(layer->sky, 0.02, 0.004);
}

TEST(LimbLayer, IsNotSeenWhereThereIsNone) {
  std::vector<double> tangent_km, falling;
  for (double h = 45.0; h < 200.0; h += 3.0) {
    tangent_km.push_back(h);
    falling.push_back(std::exp(-h / 30.0));
  }
  EXPECT_FALSE(find_limb_layer(tangent_km, falling, kObserverKm));
  EXPECT_FALSE(find_limb_layer(tangent_km, std::vector<double>(tangent_km.size(), 0.1), kObserverKm));
  EXPECT_FALSE(find_limb_layer({50, 60, 70}, {0, 1, 0}, kObserverKm));
}

}  // namespace
}  // namespace vegard::fit::limb_layer_test
