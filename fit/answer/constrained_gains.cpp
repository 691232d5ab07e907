#include "fit/answer/constrained_gains.h"

#include <map>
#include <string>

#include "fit/photo/grey_light.h"

namespace vegard::fit {

std::vector<std::vector<double>> gain_sigmas(const FittedPhoto& fitted) {
  static const char* const kChannel[3] = {"red", "green", "blue"};
  std::map<std::string, double> known;
  for (const SolvedNumber& s : fitted.solved) known[s.name] = s.sigma.value_or(0.0);
  const bool per_band = fitted.best.fit.band_brightness, per_channel = !fitted.best.fit.white_balance_known;
  std::vector<std::vector<double>> sigmas;
  for (std::size_t b = 0; b < fitted.gain.size(); ++b) {
    sigmas.emplace_back();
    for (int c = 0; c < 3; ++c) {
      const int channel = is_grey(fitted.best) ? kGreyChannel : c;
      const auto found = known.find(std::string("gain") + (per_band ? ".band_" + std::to_string(b) : "") +
                                    (per_channel ? std::string(".") + kChannel[channel] : ""));
      sigmas.back().push_back(found == known.end() ? 0.0 : found->second);
    }
  }
  return sigmas;
}

bool is_constrained(double gain, double sigma) { return gain > 0.0 && sigma < gain; }

std::vector<std::vector<bool>> constrained_gains(const FittedPhoto& fitted) {
  const std::vector<std::vector<double>> sigmas = gain_sigmas(fitted);
  std::vector<std::vector<bool>> constrained;
  for (std::size_t b = 0; b < sigmas.size(); ++b) {
    constrained.emplace_back();
    for (std::size_t c = 0; c < sigmas[b].size(); ++c)
      constrained.back().push_back(is_constrained(fitted.gain[b][c], sigmas[b][c]));
  }
  return constrained;
}

}  // namespace vegard::fit
