// Volumes found again in pictures of which the truth is known: the examples of docs/fitting.md, "Volumes".
//
// The picture is the simulator's own, with the noise of the scene's sensor; what is tested is the fit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "fit/fit.h"
#include "sim/base/file/number_text.h"
#include "sim/scene/file/scene_toml.h"
#include "sim/scene/table/parameter_table.h"
#include "tests/support/rendered_photo.h"
#include "tests/support/source_folder.h"

namespace vegard::fit::volumes_test {
namespace {

sim::Scene example(const std::string& name) {
  return sim::read_scene(tests::source_folder() + "/data/examples/" + name);
}

/// Of a chi2 of as many degrees of freedom as there are numbers: what one draw in 10 000 exceeds is 4.2 sigma
/// for the largest of eight. The fit's error bars leave correlations out here, so that is wide enough.
constexpr double kMaxSigma = 4.2;

/// Fits the start to a picture of the truth and compares.
FitResult recovered(const std::string& folder) {
  const sim::Scene truth = example(folder + "/truth.toml"), start = example(folder + "/scene.toml");
  const FitResult result = fit_photo(start, tests::noisy_photo(truth, 0.004, truth.seed), {});
  std::printf("%s: %s\n", folder.c_str(), result.verdict_line.c_str());
  for (const FittedParameter& p : result.parameters) {
    const double true_value = *sim::real_value(truth, sim::resolve(truth, p.path).front());
    EXPECT_TRUE(p.sigma) << p.path << ": " << p.why_no_sigma;
    if (!p.sigma) continue;
    const double off = (p.value - true_value) / *p.sigma;
    std::printf("  %-42s %s, true %g: %.2f sigma\n", p.path.c_str(),
                sim::number_with_error(p.value, p.sigma).c_str(), true_value, off);
    EXPECT_LT(std::abs(off), kMaxSigma) << p.path;
  }
  return result;
}

// Q is told by the gain, to the 5 % of the scene's calibration_error: truth and start say the same gain.
TEST(VolumeRecovery, FindsAnArcByItsFootprintAgain) {
  const FitResult result = recovered("arc");
  EXPECT_NE(result.verdict, Verdict::failed);
  bool has_flux = false;
  for (const DerivedNumber& d : result.derived) {
    if (d.name != "energy flux Q of the arc footprint") continue;
    has_flux = true;
    ASSERT_TRUE(d.sigma);
    std::printf("  %s %s, true 8\n", d.name.c_str(), sim::number_with_error(d.value, d.sigma).c_str());
    EXPECT_NEAR(d.value, 8.0, *d.sigma) << "5 % of calibration, of which there is no error here";
    // In quadrature with the gain's own, which is small beside it.
    EXPECT_GT(*d.sigma, 0.0499 * d.value);
    EXPECT_LT(*d.sigma, 0.055 * 8.0);
  }
  EXPECT_TRUE(has_flux);
}

TEST(VolumeRecovery, FindsALobedNebulaAgain) {
  const FitResult result = recovered("lobes");
  EXPECT_NE(result.verdict, Verdict::failed);
}

}  // namespace
}  // namespace vegard::fit::volumes_test
