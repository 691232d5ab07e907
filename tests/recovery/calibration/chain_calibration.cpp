// Simulation-based calibration of the chain: ranks of truths, number by number, and whether they are flat.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "apps/options/command.h"
#include "sim/base/parallel.h"
#include "tests/recovery/calibration/calibrated_case.h"
#include "tests/recovery/calibration/rank_statistic.h"

namespace vegard::calibration {
namespace {

int run(int argc, char** argv) {
  std::uint64_t set = 1;
  int count = 100, jobs = 2, steps = 100;
  bool of_draws = false;
  apps::Program program("chain_calibration",
                        "Ranks of truths among the samples of a fit's chain, and whether they are flat", {},
                        argc, argv);
  const apps::Command app = program.root();
  app.option("--seed", set, "The set of scenes").shows_default();
  app.option("--count", count, "How many scenes").range(1, 100000).shows_default();
  app.option("--jobs", jobs, "Scenes side by side, one thread each, at most as many as there are cores")
      .range(1, 256)
      .shows_default();
  app.option("--steps", steps, "Of a chain").range(25, 100000).shows_default();
  app.flag("--draws", of_draws, "Photographs of a draw of beams, as JPEG, in place of what the fit assumes");
  if (const std::optional<int> end = program.read()) return *end;

  std::vector<Ranks> all(static_cast<std::size_t>(count));
  sim::parallel_for(all.size(), jobs, [&](std::size_t i, int) {
    all[i] = ranks_of_case(set, static_cast<int>(i),
                           of_draws ? Photographs::of_draws : Photographs::as_assumed, steps);
    std::fprintf(stderr, "scene %zu: fewest effective samples %.0f, inflation %.2f%s\n", i,
                 all[i].fewest_effective, all[i].inflation, all[i].rank.empty() ? ", no chain" : "");
  });
  const auto without = std::count_if(all.begin(), all.end(), [](const Ranks& r) { return r.rank.empty(); });
  if (without > 0) std::printf("%td of %d scenes have no chain and are left out\n", without, count);

  const std::vector<std::string> names = free_numbers_of_calibration();
  for (std::size_t j = 0; j < names.size(); ++j) {
    std::vector<std::size_t> ranks;
    for (const Ranks& of_case : all)
      if (!of_case.rank.empty()) ranks.push_back(of_case.rank[j]);
    const std::array<int, kBins> histogram = histogram_of(ranks);
    std::printf("| `%s` |", names[j].c_str());
    for (const int in_bin : histogram) std::printf(" %d", in_bin);
    std::printf(" | %.3f |\n", probability_of(histogram));
  }
  return 0;
}

}  // namespace
}  // namespace vegard::calibration

int main(int argc, char** argv) {
  try {
    return vegard::calibration::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "chain_calibration: %s\n", error.what());
    return 1;
  }
}
