#include <algorithm>
#include <cmath>

#include "fit/report/corner_plot.h"
#include "sim/base/file/short_path.h"

namespace vegard::fit {

CornerData corner_data(const FitResult& result) {
  CornerData data;
  const std::size_t n = result.parameters.size();
  const bool one_sheet = result.best.sheets.size() == 1;
  const bool has_chain = result.chain && !result.chain->samples.empty();
  std::vector<std::size_t> shown;
  for (std::size_t j = 0; j < n && result.correlation.size() == n; ++j) {
    const FittedParameter& p = result.parameters[j];
    if (p.of_profile) continue;
    if (p.sigma || (has_chain && result.chain->sigma[j] > 0.0))
      shown.push_back(j);
    else
      data.left_out.push_back(sim::short_path(p.path, one_sheet));
  }
  for (const std::size_t j : shown) {
    const FittedParameter& p = result.parameters[j];
    data.parameters.push_back({sim::short_path(p.path, one_sheet), p.unit, p.value, p.sigma});
    data.correlation.emplace_back();
    for (const std::size_t k : shown) data.correlation.back().push_back(result.correlation[j][k]);
  }
  if (has_chain)
    for (std::size_t i = 0; i < result.chain->samples.size(); i += n)
      for (const std::size_t j : shown) data.samples.push_back(result.chain->samples[i + j]);
  return data;
}

std::vector<std::size_t> most_correlated(const CornerData& data, std::size_t most) {
  const std::size_t n = data.parameters.size();
  std::vector<std::size_t> order;
  std::vector<double> strongest(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    order.push_back(j);
    for (std::size_t k = 0; k < n; ++k)
      if (j != k && std::isfinite(data.correlation[j][k]))
        strongest[j] = std::max(strongest[j], std::abs(data.correlation[j][k]));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return strongest[a] > strongest[b]; });
  order.resize(std::min(order.size(), most));
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace vegard::fit
