#include "sim/emit/footprint/step_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vegard::sim {
namespace {

constexpr int kMaxWidths = 33;
constexpr double kRowKm = HeightProfile::kStepKm;

/// The integral of a piecewise linear curve from its first row on; beyond the ends it stays level.
class Integral {
 public:
  explicit Integral(const std::vector<double>& curve) : curve_(curve), sum_(curve.size(), 0.0) {
    for (std::size_t i = 1; i < curve.size(); ++i) sum_[i] = sum_[i - 1] + 0.5 * (curve[i - 1] + curve[i]);
  }
  /// Up to a row, in rows.
  double operator()(double row) const {
    const double last = static_cast<double>(curve_.size() - 1);
    if (row <= 0.0) return row * curve_.front();
    if (row >= last) return sum_.back() + (row - last) * curve_.back();
    const auto i = static_cast<std::size_t>(row);
    const double part = row - static_cast<double>(i);
    return sum_[i] + part * (curve_[i] + 0.5 * part * (curve_[i + 1] - curve_[i]));
  }

 private:
  const std::vector<double>& curve_;
  std::vector<double> sum_;
};

bool is_lit(const HeightProfile& profile, int row) {
  const float* rates = profile.rate.data() + static_cast<std::size_t>(row) * profile.stride;
  return std::any_of(rates, rates + profile.lines, [](float rate) { return rate != 0.0f; });
}

}  // namespace

StepProfile::StepProfile(const ProfileTable& table, double top_km, double widest_km)
    : ln_first_(table.ln_first), ln_step_(table.ln_step) {
  const HeightProfile& any = table.of_energy.front();
  lines_ = any.lines;
  stride_ = any.stride;
  energies_ = static_cast<int>(table.of_energy.size());
  // From the row before the first light its rate rises; and a mean over a row reaches a row farther.
  const double top = std::min(top_km, HeightProfile::kTopKm);
  const int last = static_cast<int>(std::ceil((top - HeightProfile::kBottomKm) / kRowKm - 1e-9));
  int first = last;
  for (const HeightProfile& profile : table.of_energy)
    for (int row = 0; row < first; ++row)
      if (is_lit(profile, row)) first = std::max(0, row - 2);
  bottom_km_ = HeightProfile::altitude_km(first);
  rows_ = last - first + 2;
  // A quarter of a kilometre is little against every profile's bends; coarser only for the longest steps.
  width_step_km_ = std::max(kRowKm, widest_km / (kMaxWidths - 1));
  widths_ = 1 + static_cast<int>(std::ceil(widest_km / width_step_km_ - 0.5));
  // A row more, since the last row is read with a next one that has no weight.
  rate_.assign((static_cast<std::size_t>(energies_) * widths_ * rows_ + 1) * stride_, 0.0f);
  slope_ = rate_;
  std::vector<double> curve(rows_);
  const auto fill = [&](const std::vector<float>& from, int energy, int line, std::vector<float>& to) {
    // Above the first row at or above top_km, where the profile may be dark, it goes on as it is there: the
    // march itself ends at top_km.
    for (int row = 0; row < rows_; ++row)
      curve[row] = from[static_cast<std::size_t>(std::min(first + row, last)) * stride_ + line];
    const Integral integral(curve);
    for (int w = 0; w < widths_; ++w) {
      const double half = 0.5 * w * width_step_km_ / kRowKm;
      for (int row = 0; row < rows_; ++row)
        to[offset(energy, w) + static_cast<std::size_t>(row) * stride_ + line] = static_cast<float>(
            w == 0 ? curve[row] : (integral(row + half) - integral(row - half)) / (2.0 * half));
    }
  };
  for (int e = 0; e < energies_; ++e)
    for (int l = 0; l < lines_; ++l) {
      fill(table.of_energy[e].rate, e, l, rate_);
      fill(table.of_energy[e].d_rate_d_ln_energy, e, l, slope_);
    }
}

}  // namespace vegard::sim
