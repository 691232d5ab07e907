// Residuals and Jacobian of a scene's fit, put together from the fit's own parts as its last descents have
// them: what Python's must be, bit by bit. Writes doubles to standard output: the residuals, then
// [residual][parameter] by values. usage: cost_numbers SCENE PHOTO [VALUE...]
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "fit/compare/observation.h"
#include "fit/compare/profile_cost.h"
#include "fit/parameters/free_parameters.h"
#include "fit/photo/averaging.h"
#include "fit/photo/photo.h"
#include "fit/search/profile_rounds.h"
#include "sim/scene/file/scene_toml.h"

int main(int argc, char** argv) {
  using namespace vegard;
  if (argc < 3) return 2;
  const sim::Scene scene = sim::read_scene(argv[1]);
  const fit::Photo photo =
      fit::read_photo(argv[2], fit::Decoding::automatic, &scene, fit::averaging_for_fit(scene));
  const std::vector<fit::FreeNumber> free = fit::free_numbers(scene);
  std::vector<fit::Observation> observations;
  observations.push_back(fit::observed(scene, photo, 1));
  fit::EvaluationLog log;
  const fit::ProfileCost cost(
      free, fit::cost_terms(observations, free, fit::Detail::full), log,
      {{}, {}, fit::spline_prior(scene, free, fit::first_smoothness(scene)), fit::kFirstPriorWeight});
  std::vector<double> at, slopes;
  for (std::size_t j = 0; j < free.size(); ++j) {
    const int word = 3 + static_cast<int>(j);
    at.push_back(free[j].coordinate(word < argc ? std::atof(argv[word]) : free[j].start));
    slopes.push_back(free[j].slope(at.back()));
  }
  const auto rows = static_cast<std::size_t>(cost.num_residuals());
  std::vector<double> residuals(rows), jacobian(rows * free.size());
  const double* parameters[] = {at.data()};
  double* jacobians[] = {jacobian.data()};
  if (!cost.Evaluate(parameters, residuals.data(), jacobians)) return 1;
  for (std::size_t i = 0; i < jacobian.size(); ++i) jacobian[i] *= 1.0 / slopes[i % free.size()];
  std::fwrite(residuals.data(), sizeof(double), residuals.size(), stdout);
  std::fwrite(jacobian.data(), sizeof(double), jacobian.size(), stdout);
  return 0;
}
