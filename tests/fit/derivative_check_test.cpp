// The doctor knows right Jacobians from wrong ones, whatever the size of the parameter's unit.
#include "fit/derivative_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/render/render.h"
#include "tests/support/expect_error.h"
#include "tests/support/small_scene.h"

namespace vegard::fit::derivative_check_test {
namespace {

/// Residuals sin(k a) and exp(k b / 8); the third coordinate does nothing. Mistakes can be built in.
class Waves : public ceres::CostFunction {
 public:
  double factor_a = 1.0;   ///< of the derivative by a
  bool forgets_b = false;  ///< zeros for the derivative by b
  double invents_c = 0.0;  ///< derivative by c, which there is none of
  double noise = 0.0;      ///< rounding of residuals

  Waves() {
    set_num_residuals(2 * kCount);
    mutable_parameter_block_sizes()->push_back(3);
  }
  bool Evaluate(double const* const* x, double* r, double** jacobians) const override {
    const double a = x[0][0], b = x[0][1];
    for (int k = 0; k < kCount; ++k) {
      r[2 * k] = rounded(std::sin(k * a));
      r[2 * k + 1] = rounded(std::exp(k * b / 8.0));
      if (jacobians == nullptr) continue;
      double* const even = jacobians[0] + 6 * k;
      double* const odd = even + 3;
      even[0] = factor_a * k * std::cos(k * a);
      even[1] = odd[0] = 0.0;
      odd[1] = forgets_b ? 0.0 : k / 8.0 * std::exp(k * b / 8.0);
      even[2] = odd[2] = invents_c;
    }
    return true;
  }

 private:
  static constexpr int kCount = 10;
  double rounded(double x) const { return noise > 0.0 ? noise * std::round(x / noise) : x; }
};

std::vector<DerivativeVerdict> verdicts(const Waves& cost) {
  std::vector<DerivativeVerdict> found;
  for (const DerivativeCheck& check :
       check_derivatives(cost, {{"a", 0.3, 1.0}, {"b", 0.2, 1.0}, {"c", 5.0, 1.0}}))
    found.push_back(check.verdict);
  return found;
}

constexpr DerivativeVerdict kAgree = DerivativeVerdict::agree, kDiffer = DerivativeVerdict::differ,
                            kNoEffect = DerivativeVerdict::no_effect;
using Verdicts = std::vector<DerivativeVerdict>;

TEST(CheckDerivatives, ARightJacobianAgrees) {
  EXPECT_EQ(verdicts(Waves()), (Verdicts{kAgree, kAgree, kNoEffect}));
  const DerivativeCheck b =
      check_derivatives(Waves(), {{"a", 0.3, 1.0}, {"b", 0.2, 2.0}, {"c", 5.0, 1.0}})[1];
  EXPECT_EQ(b.name, "b");
  double square = 0.0;  // the length of d exp(k b / 8) / db, two of them to the natural step
  for (int k = 0; k < 10; ++k) square += std::pow(2.0 * k / 8.0 * std::exp(k * 0.2 / 8.0), 2);
  EXPECT_NEAR(b.effect, std::sqrt(square), 1e-12);
  // Central differences err by the step squared: a hundred times less for a tenth of the step.
  ASSERT_EQ(b.differences.size(), derivative_steps().size());
  EXPECT_NEAR(b.differences[0] / b.differences[2], 100.0, 2.0);
  EXPECT_LT(b.best_difference, 1e-8);
  EXPECT_LT(b.best_step, 1e-3);
}

TEST(CheckDerivatives, AWrongJacobianDiffers) {
  Waves wrong_by_a_little, of_wrong_sign, forgetful, inventive, without_a_number;
  wrong_by_a_little.factor_a = 1.07;
  EXPECT_EQ(verdicts(wrong_by_a_little), (Verdicts{kDiffer, kAgree, kNoEffect}));
  of_wrong_sign.factor_a = -1.0;
  EXPECT_EQ(verdicts(of_wrong_sign), (Verdicts{kDiffer, kAgree, kNoEffect}));
  forgetful.forgets_b = true;
  EXPECT_EQ(verdicts(forgetful), (Verdicts{kAgree, kDiffer, kNoEffect}));
  inventive.invents_c = 0.3;
  EXPECT_EQ(verdicts(inventive), (Verdicts{kAgree, kAgree, kDiffer}));
  without_a_number.factor_a = std::nan("");
  EXPECT_EQ(verdicts(without_a_number)[0], kDiffer);
}

TEST(CheckDerivatives, RoundedResidualsAgreeAtLongerSteps) {
  Waves rounded;
  rounded.noise = 1e-4;
  const std::vector<DerivativeCheck> checks =
      check_derivatives(rounded, {{"a", 0.3, 1.0}, {"b", 0.2, 1.0}, {"c", 5.0, 1.0}});
  EXPECT_EQ(checks[1].verdict, kAgree);
  EXPECT_GT(checks[1].best_step, 2e-3);
  EXPECT_GT(checks[1].differences.back(), 0.5) << "a step of 1e-5 is lost in the rounding";
  EXPECT_EQ(checks[2].verdict, kNoEffect);
}

TEST(CheckDerivatives, EndsWhenItIsToldTo) {
  const std::atomic<bool> stop{true};
  EXPECT_TRUE(check_derivatives(Waves(), {{"a", 0.3, 1.0}, {"b", 0.2, 1.0}, {"c", 5.0, 1.0}}, nullptr, &stop)
                  .empty());
}

/// The whole cost of a fit. With a brightness per band the gains take up all of the flux.
TEST(CheckDerivatives, OfAPhotographsWholeCost) {
  sim::Scene scene = tests::small_scene();
  scene.sheets[0].beams = 2000;
  scene.emission.flux_law = sim::FluxLaw::linear;  // else the flux changes the colour too
  scene.sky.level = {0.02, 0.03, 0.05};
  scene.fit.bands = 3;
  for (const char* path : {"sheet.main.center_km.north", "sheet.main.energy_kev", "sheet.main.phase_rad",
                           "sheet.main.energy_flux_mw_m2"}) {
    sim::FreeParameter free;
    free.path = path;
    scene.fit.free.push_back(free);
  }
  sim::Scene elsewhere = scene;
  elsewhere.sheets[0].center_km.north += 6.0;
  Photo photo;
  photo.linear = sim::render(elsewhere).rgb;
  photo.usable.assign(photo.linear.data.size(), 1);
  photo.floating = true;
  photo.srgb = false;
  double share = 0.0;
  const std::vector<DerivativeCheck> checks =
      check_derivatives(scene, photo, 1, [&](double finished) { share = finished; });
  EXPECT_EQ(share, 1.0);
  ASSERT_EQ(checks.size(), 4u);
  for (int j = 0; j < 3; ++j) {
    EXPECT_EQ(checks[j].verdict, kAgree) << checks[j].name << " " << checks[j].best_difference;
    EXPECT_GT(checks[j].effect, 1.0) << checks[j].name;
  }
  EXPECT_EQ(checks[3].verdict, kNoEffect) << checks[3].effect;
}

}  // namespace
}  // namespace vegard::fit::derivative_check_test
