#include "sim/emit/footprint/map/make_footprint.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/emit/footprint/map/footprint_map.h"

namespace vegard::sim::sheet_footprint_test {
namespace {

constexpr double kSqrtTwoPi = 2.5066282746310002;
const NumberAs<double> kPlain = [](const double& n) { return n; };

Scene one_sheet() {
  Scene scene;
  Sheet sheet;
  sheet.center_km = {20.0, 180.0};
  sheet.bearing_deg = 70.0;
  sheet.length_km = 120.0;
  sheet.thickness_km = 5.0;
  sheet.width_km = 2.0;
  sheet.energy_kev = 4.0;
  scene.sheets = {sheet};
  return scene;
}

Footprint box() {
  Footprint f;
  f.source = FootprintSource::sheets;
  f.center_km = {20.0, 180.0};
  f.size_km = {200.0, 120.0};
  f.energy_kev = 2.0;
  return f;
}

double total(const PlaneFootprint<double>& plane) {
  double sum = 0.0;
  for (const double flux : plane.grid.flux_mw_m2) sum += flux;
  return sum * plane.cell_km * plane.cell_km;
}

double of_beams(const Sheet& sheet) {
  return sheet.energy_flux_mw_m2 * kSqrtTwoPi * sheet.width_km * sheet.length_km * sheet.layers * sheet.arcs;
}

TEST(SheetFootprint, HasTheFluxOfTheBeams) {
  Scene scene = one_sheet();
  scene.sheets[0].fold_spacing_km = 25.0;
  scene.sheets[0].curl_spacing_km = 30.0;
  // Every beam's share is laid down whole: what differs is rounding.
  EXPECT_NEAR(total(sheet_plane(scene, box(), kPlain, 2)), of_beams(scene.sheets[0]),
              1e-9 * of_beams(scene.sheets[0]));
}

TEST(SheetFootprint, IsTheGaussianOfAStraightLayer) {
  Scene scene = one_sheet();
  Sheet& sheet = scene.sheets[0];
  sheet.bearing_deg = 90.0;
  sheet.thickness_km = 0.0;
  sheet.layers = 1;
  Footprint f = box();
  f.cell_km = 0.5;
  const PlaneFootprint<double> plane = sheet_plane(scene, f, kPlain, 1);
  double worst = 0.0;
  for (int row = 90; row < 150; ++row)
    for (int column = 150; column < 250; ++column) {
      const double off = plane.south_km + (row + 0.5) * 0.5 - 180.0;
      worst = std::max(worst, std::abs(plane.grid.flux_mw_m2[row * plane.grid.columns + column] -
                                       5.0 * std::exp(-off * off / 8.0)));
    }
  // Sharing out among cells widens the Gaussian by cell² / 6 = 0.04 of 4 km², 0.5 % of the peak; beams on a
  // Hammersley set, some 60 to a cell at the peak, add about 1 / 60 of it.
  EXPECT_LT(worst, 5.0 * 0.03);
}

TEST(SheetFootprint, HasTheSheetsEnergyAndTheirMeanWhereTheyOverlap) {
  Scene scene = one_sheet();
  const PlaneFootprint<double> one = sheet_plane(scene, box(), kPlain, 1);
  scene.sheets.push_back(scene.sheets[0]);
  scene.sheets[1].energy_kev = 8.0;
  scene.sheets[1].energy_flux_mw_m2 = 3.0 * scene.sheets[0].energy_flux_mw_m2;
  const PlaneFootprint<double> two = sheet_plane(scene, box(), kPlain, 2);
  EXPECT_NEAR(total(two), 4.0 * total(one), 1e-9 * total(two));
  double weighed = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < one.grid.cells(); ++i) {
    if (one.grid.flux_mw_m2[i] > 0.0) {
      EXPECT_NEAR(one.grid.ln_energy[i], std::log(2.0), 1e-12);
    }
    weighed += two.grid.flux_mw_m2[i] * two.grid.ln_energy[i];
    sum += two.grid.flux_mw_m2[i];
  }
  EXPECT_NEAR(weighed / sum, 0.25 * std::log(2.0) + 0.75 * std::log(4.0), 1e-9);
}

TEST(SheetFootprint, RaysRedistributeTheFlux) {
  Scene scene = one_sheet();
  const PlaneFootprint<double> smooth = sheet_plane(scene, box(), kPlain, 1);
  scene.sheets[0].ray_contrast = 0.7;
  scene.sheets[0].ray_width_km = 1.0;
  const PlaneFootprint<double> rayed = sheet_plane(scene, box(), kPlain, 2);
  // The light of rays is log-normal with a mean of 1 and a variance of exp(0.49) - 1 = 0.63; about a hundred
  // independent rays along 120 km leave its mean uncertain by 8 %.
  EXPECT_NEAR(total(rayed), total(smooth), 0.25 * total(smooth));
  double most = 0.0;
  for (const double flux : rayed.grid.flux_mw_m2) most = std::max(most, flux);
  double most_smooth = 0.0;
  for (const double flux : smooth.grid.flux_mw_m2) most_smooth = std::max(most_smooth, flux);
  EXPECT_GT(most, 1.5 * most_smooth);
}

TEST(SheetFootprint, DerivativesByTheSheetsNumbersAreThoseOfDifferences) {
  Scene scene = one_sheet();
  Footprint f = box();
  Sheet& sheet = scene.sheets[0];
  double* const numbers[] = {&sheet.energy_flux_mw_m2, &sheet.energy_kev, &f.energy_kev};
  const NumberAs<FreeDual> seeded = [&](const double& n) {
    FreeDual dual(n);
    for (int k = 0; k < 3; ++k)
      if (numbers[k] == &n) dual.d.t[k] = 1.0;
    return dual;
  };
  const PlaneFootprint<FreeDual> dual = sheet_plane(scene, f, seeded, 1);
  const PlaneFootprint<double> plain = sheet_plane(scene, f, kPlain, 1);
  for (std::size_t i = 0; i < dual.grid.cells(); ++i) {
    EXPECT_NEAR(dual.grid.flux_mw_m2[i].v, plain.grid.flux_mw_m2[i], 1e-12);
    EXPECT_NEAR(dual.grid.flux_mw_m2[i].d.t[0], plain.grid.flux_mw_m2[i] / 5.0, 1e-12);
    if (plain.grid.flux_mw_m2[i] == 0.0) continue;
    EXPECT_NEAR(dual.grid.ln_energy[i].d.t[1], 0.25, 1e-9);
    EXPECT_NEAR(dual.grid.ln_energy[i].d.t[2], -0.5, 1e-9);
  }
}

}  // namespace
}  // namespace vegard::sim::sheet_footprint_test
