#include "sim/emit/aurora/motion.h"

#include "sim/base/number/smooth_step.h"

namespace vegard::sim {
std::vector<double> instants_s(const Time& time) {
  std::vector<double> all;
  for (int k = 0; k < time.instants; ++k) all.push_back(time.start_s + k * time.exposure_s / time.instants);
  return all;
}

double substorm_level(const Substorm& s, double instant_s) {
  if (s.quiet >= 1.0) return 1.0;
  const double since_onset = instant_s - s.onset_s;
  if (since_onset < 0.0) return s.quiet + (s.grown - s.quiet) * smooth_step(1.0 + since_onset / s.growth_s);
  if (since_onset < s.expansion_s)
    return s.grown + (1.0 - s.grown) * smooth_step(since_onset / s.expansion_s);
  return 1.0 + (s.quiet - 1.0) * smooth_step((since_onset - s.expansion_s) / s.recovery_s);
}

}  // namespace vegard::sim
