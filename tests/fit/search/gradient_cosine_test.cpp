// The measure of levelness on costs whose answer can be written down.
#include "fit/search/descent.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vegard::fit::gradient_cosine_test {
namespace {

/// Residuals a + M x with a constant M.
class Linear : public ceres::CostFunction {
 public:
  Linear(std::vector<double> constant, std::vector<std::vector<double>> columns)
      : constant_(std::move(constant)), columns_(std::move(columns)) {
    set_num_residuals(static_cast<int>(constant_.size()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(columns_.size()));
  }
  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    for (std::size_t k = 0; k < constant_.size(); ++k) {
      residuals[k] = constant_[k];
      for (std::size_t j = 0; j < columns_.size(); ++j) {
        residuals[k] += columns_[j][k] * x[0][j];
        if (jacobians != nullptr) jacobians[0][k * columns_.size() + j] = columns_[j][k];
      }
    }
    return true;
  }

 private:
  std::vector<double> constant_;
  std::vector<std::vector<double>> columns_;
};

TEST(SteepestCosine, ItsSquareIsTheShareOfChi2ThatOneParameterCouldTake) {
  // From residuals (3, 4, 12), the first parameter can take away 3^2, the second the 4^2; of 13^2.
  const Linear cost({3.0, 4.0, 12.0}, {{1e-3, 0.0, 0.0}, {0.0, 50.0, 0.0}});
  EXPECT_NEAR(gradient_cosine(cost, {0.0, 0.0}), 4.0 / 13.0, 1e-15);
  EXPECT_NEAR(gradient_cosine(cost, {0.0, 0.0}, {false, true}), 3.0 / 13.0, 1e-15);
}

TEST(SteepestCosine, IsNothingAtTheMinimum) {
  const Linear cost({3.0, 4.0, 12.0}, {{1e-3, 0.0, 0.0}, {0.0, 50.0, 0.0}, {0.0, 0.0, 0.0}});
  EXPECT_NEAR(gradient_cosine(cost, {-3e3, -4.0 / 50.0, 7.0}), 0.0, 1e-15);
}

TEST(SteepestCosine, IsUnknownWhereNothingHasAnEffect) {
  const Linear cost({3.0, 4.0}, {{0.0, 0.0}, {1.0, 0.0}});
  EXPECT_TRUE(std::isnan(gradient_cosine(cost, {0.0, 0.0}, {false, true})));
  EXPECT_NEAR(gradient_cosine(cost, {0.0, 0.0}), 0.6, 1e-15);
}

}  // namespace
}  // namespace vegard::fit::gradient_cosine_test
