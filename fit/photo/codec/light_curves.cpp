#include "fit/photo/codec/light_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace vegard::fit {
namespace light_curves {

LightCurve sampled_curve(const std::function<double(double)>& light_of, const std::string& name) {
  std::vector<double> light(kCurveSamples);
  const double white = light_of(1.0);
  for (int i = 0; i < kCurveSamples; ++i)
    light[i] = std::clamp(light_of(i / double{kCurveSamples - 1}) / white, i > 0 ? light[i - 1] : 0.0, 1.0);
  return {false, curve_of_samples(light, name), name};
}

}  // namespace light_curves

LightCurve gamma_curve(double gamma) {
  constexpr double kOne = 1e-4;
  if (std::abs(gamma - 1.0) < kOne) return {true, nullptr, "linear"};
  const auto tone = std::make_shared<const sim::ToneCurve>(sim::ToneCurve::of_gamma(gamma));
  return {false, tone, tone->name()};
}

std::shared_ptr<const sim::ToneCurve> curve_of_samples(const std::vector<double>& light,
                                                       const std::string& name) {
  std::string table = "linear,encoded\n0,0\n";
  double last = 0.0;
  const double black = light.front(), range = light.back() - light.front();
  for (std::size_t i = 1; i < light.size(); ++i) {
    const double now = i + 1 < light.size() ? (light[i] - black) / range : 1.0;
    // A table rises from row to row; where light does not, the first row with the next light counts.
    constexpr double kLeastStep = 1e-12;
    const bool is_last = i + 1 == light.size();
    if (!is_last && !(now > last + kLeastStep && now < 1.0 - kLeastStep)) continue;
    table +=
        fmt::format("{:.15g},{:.15g}\n", now, static_cast<double>(i) / static_cast<double>(light.size() - 1));
    last = now;
  }
  return std::make_shared<const sim::ToneCurve>(sim::ToneCurve::of_table(table, name));
}

std::optional<LightCurve> curve_of_h273(int transfer) {
  using light_curves::sampled_curve;
  constexpr int kPower22 = 4, kPower28 = 5, kSmpte240 = 7, kLinear = 8, kLog100 = 9, kLog316 = 10,
                kXvYcc = 11, kSrgb = 13, kPq = 16, kSmpte428 = 17, kHlg = 18;
  switch (transfer) {
    case 1:
    case 6:
    case kXvYcc:
    case 12:
    case 14:
    case 15: {
      constexpr double kAlpha = 1.09929682680944, kBeta = 0.018053968510807;
      return sampled_curve(
          [](double v) {
            return v < 4.5 * kBeta ? v / 4.5 : std::pow((v + kAlpha - 1.0) / kAlpha, 1.0 / 0.45);
          },
          "BT.709");
    }
    case kPower22:
      return gamma_curve(2.2);
    case kPower28:
      return gamma_curve(2.8);
    case kSmpte240:
      return sampled_curve(
          [](double v) { return v < 4.0 * 0.0228 ? v / 4.0 : std::pow((v + 0.1115) / 1.1115, 1.0 / 0.45); },
          "SMPTE 240M");
    case kLinear:
      return LightCurve{true, nullptr, "linear"};
    case kLog100:
      return sampled_curve([](double v) { return v > 0.0 ? std::pow(10.0, 2.0 * (v - 1.0)) : 0.0; },
                           "log 100");
    case kLog316:
      return sampled_curve([](double v) { return v > 0.0 ? std::pow(10.0, 2.5 * (v - 1.0)) : 0.0; },
                           "log 316");
    case kSrgb:
      return LightCurve{false, nullptr, "sRGB"};
    case kPq:
      return sampled_curve(
          [](double v) {
            constexpr double kM1 = 0.1593017578125, kM2 = 78.84375, kC1 = 0.8359375, kC2 = 18.8515625,
                             kC3 = 18.6875;
            const double p = std::pow(v, 1.0 / kM2);
            return std::pow(std::max(p - kC1, 0.0) / (kC2 - kC3 * p), 1.0 / kM1);
          },
          "PQ");
    case kSmpte428:
      return gamma_curve(2.6);
    case kHlg:
      return sampled_curve(
          [](double v) {
            constexpr double kA = 0.17883277, kB = 0.28466892, kC = 0.55991073;
            return v <= 0.5 ? v * v / 3.0 : (std::exp((v - kC) / kA) + kB) / 12.0;
          },
          "HLG");
    default:
      return std::nullopt;
  }
}

}  // namespace vegard::fit
