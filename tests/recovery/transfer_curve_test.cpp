// The shipped photograph, made by another program, with its numbers put through other curves than sRGB: what
// that costs who does not know, and what a fit that is told so finds.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "fit/fit.h"
#include "sim/scene/file/scene_toml.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::transfer_curve_test {
namespace {

const std::string kShipped = tests::source_folder() + "/data/examples/h000";
constexpr double kEnergy = 4.3298;  // truth.json
constexpr int kOfEnergy = 6;        // among the free numbers

double by_power(double light) { return sim::BentSrgb{1.3, 1.3}.encode(light); }

/// Contrast as picture programs put it on: steeper in the middle, flatter at both ends.
double by_s_curve(double light) {
  const double v = sim::srgb_encode(light);
  return 0.5 * v + 0.5 * v * v * (3.0 - 2.0 * v);
}

struct Case {
  const char* name;
  double (*encode)(double);
  int unknowns;
  double exponent;  ///< where there is one truth
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class TransferCurveOfThePhotograph : public testing::TestWithParam<Case> {};

void tell(const std::string& what, const FitResult& r) {
  const FittedParameter& e = r.parameters[kOfEnergy];
  std::cout << what << ": E0 " << e.value << " +- " << e.sigma.value_or(NAN) << " keV ("
            << (e.value - kEnergy) / e.sigma.value_or(NAN) << " sigma), chi2/dof " << r.chi2 / r.dof
            << ", inflation " << r.error_inflation << ", evaluations " << r.evaluations;
  if (r.transfer_curve)
    std::cout << ", " << r.transfer_curve->words << ", " << r.transfer_curve->trials.size() << " trials";
  std::cout << "\n  " << r.verdict_line << std::endl;
}

TEST_P(TransferCurveOfThePhotograph, IsFound) {
  const Case& c = GetParam();
  const sim::Scene scene = sim::read_scene(kShipped + "/scene.toml");
  Photo photo = tests::encoded_photo(read_photo(kShipped + "/photo.jpg", Decoding::srgb), c.encode, 0.0, 1);
  photo.unknowns = c.unknowns;
  const FitResult as_srgb = fit_photo(scene, photo, {});
  tell(std::string(c.name) + " as sRGB", as_srgb);
  const FitResult found = fit_photo_and_transfer_curve(scene, photo, {});
  tell(std::string(c.name) + " unknown", found);
  ASSERT_EQ(found.parameters[kOfEnergy].path, "sheet.main.energy_kev");
  ASSERT_TRUE(found.parameters[kOfEnergy].sigma);
  // Three standard deviations each.
  EXPECT_NEAR(found.parameters[kOfEnergy].value, kEnergy, 3.0 * *found.parameters[kOfEnergy].sigma);
  if (c.exponent > 0.0) {
    const FittedTransferCurve::Exponent& e = found.transfer_curve->exponents[0];
    EXPECT_NEAR(e.value, c.exponent, 3.0 * e.sigma);
  }
}

std::string name_of(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Slow, TransferCurveOfThePhotograph,
                         testing::Values(Case{"Srgb", sim::srgb_encode, 1, 1.0},
                                         Case{"Power", by_power, 1, 1.3}, Case{"SCurve", by_s_curve, 1, 0.0},
                                         Case{"SCurveByTwo", by_s_curve, 2, 0.0}),
                         name_of);

}  // namespace
}  // namespace vegard::fit::transfer_curve_test
