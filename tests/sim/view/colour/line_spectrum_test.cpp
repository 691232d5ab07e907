// The wavelengths of a scene's line, and the colour of a continuum.
#include "sim/view/colour/line_spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/colour/radiometry.h"
#include "tests/support/expect_error.h"

namespace vegard::sim::line_spectrum_test {
namespace {

/// A scene of one line of its own, at 601 nm, whose spectrum is this table.
Scene scene_of(const std::string& csv) {
  Scene scene;
  OwnLine own;
  own.name = "mine";
  own.wavelength_nm = 601.0;
  own.spectrum_file = "mine.csv";
  scene.own_lines = {own};
  scene.emission.lines = {601.0};
  scene.blur.width_deg = {0.0};
  scene.tables = {{"line.mine.spectrum_file", csv}};
  return scene;
}

double mean_nm(const std::vector<LineComponent>& components) {
  return std::accumulate(components.begin(), components.end(), 0.0,
                         [](double sum, const LineComponent& c) { return sum + c.share * c.wavelength_nm; });
}

TEST(LineSpectrum, IsLinearBetweenTheRowsOfItsTable) {
  // Photons rise from 0 to 2: half of them are above the wavelength where the integral is a half.
  const auto components = components_of_line(scene_of("wavelength_nm,photons\n500,0\n600,2\n"), 601.0);
  double sum = 0.0;
  for (const LineComponent& component : components) {
    sum += component.share;
    EXPECT_GT(component.wavelength_nm, 500.0);
    EXPECT_LT(component.wavelength_nm, 600.0);
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  // The mean of a density that grows in proportion, 500 + 2/3 of 100; the steps of 5 nm add 5^2 / 12 / 50.
  EXPECT_NEAR(mean_nm(components), 500.0 + 200.0 / 3.0, 0.05);
}

TEST(LineSpectrum, OfAContinuumIsTheColourOfThatContinuum) {
  // The same light by another way: colour_of_continuum() sums radiances every 5 nm, of 1 kR in 400 to 700 nm.
  const Scene scene = scene_of("wavelength_nm,photons\n400,1\n700,1\n");
  const auto radiance = [](double nm) {
    const bool inside = nm >= 400.0 && nm <= 700.0;
    const double weight = nm == 400.0 || nm == 700.0 ? 0.5 : 1.0;  // of a trapezoid's ends
    return inside ? weight * 1000.0 / 300.0 * radiance_w_m2_sr_per_rayleigh(nm) : 0.0;
  };
  const Vector3 by_line = line_colours(scene).front(), by_continuum = colour_of_continuum(scene, radiance);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(by_line[c], by_continuum[c], 2e-3 * std::abs(by_continuum[1])) << c;
}

TEST(LineSpectrum, OfSteveIsNearlyWhite) {
  // Photographs have STEVE from white to mauve: no channel lacks, and green is not the largest.
  Scene scene;
  scene.emission.lines = {610.0};
  scene.blur.width_deg = {0.0};
  const Vector3 colour = line_colours(scene).front();
  EXPECT_GT(colour[0], colour[1]);
  EXPECT_GT(colour[2], 0.6 * colour[1]);
  EXPECT_LT(colour[0], 1.6 * colour[1]);
}

TEST(LineSpectrum, IsRefusedWithoutLight) {
  for (const char* csv : {"wavelength_nm,photons\n500,0\n600,0\n", "wavelength_nm,photons\n500,1\n",
                          "wavelength_nm,photons\n600,1\n500,1\n", "wavelength_nm,photons\n500,-1\n600,1\n",
                          "wavelength_nm,light\n500,1\n600,1\n"})
    EXPECT_THROW(components_of_line(scene_of(csv), 601.0), Error) << csv;
}

}  // namespace
}  // namespace vegard::sim::line_spectrum_test
