#include "footprint_floor.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/footprint_floor.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vegard::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, 16>;
using I = hn::RebindToSigned<F>;
using V = hn::Vec<F>;

constexpr int kLines = 3;

std::size_t March(const sim::FootprintKernel& kernel, int face, const sim::MarchSpan* spans,
                  std::size_t count, sim::SpanLight* out) {
  const F d;
  const I di;
  const std::size_t lanes = hn::Lanes(d);
  const sim::TexelWindow& window = kernel.window[face];
  const sim::StepProfile& profile = *kernel.profile;
  const float* rate = profile.rate(0, 0);
  const auto all = [&](double x) { return hn::Set(d, static_cast<float>(x)); };
  constexpr double kRadius = 6371.0;
  std::size_t marched = 0;
  const int a = face / 2;
  const double sign = face % 2 == 0 ? 1.0 : -1.0;
  for (std::size_t first = 0; first < count; first += lanes) {
    HWY_ALIGN float place[3][16], direction[3][16], square[16], along[16], from[16], step[16], steps[16];
    int most = 0;
    for (std::size_t i = 0; i < lanes; ++i) {
      const sim::MarchSpan& span = spans[std::min(first + i, count - 1)];
      for (int axis = 0; axis < 3; ++axis) {
        place[axis][i] = static_cast<float>(span.place_km[axis]);
        direction[axis][i] = static_cast<float>(span.direction[axis]);
      }
      square[i] = static_cast<float>(span.square_km2);
      along[i] = static_cast<float>(span.along_km);
      from[i] = static_cast<float>(span.first_km);
      step[i] = static_cast<float>(span.step_km);
      steps[i] = static_cast<float>(span.steps);
      most = std::max(most, span.steps);
    }
    const auto lane = [&](const float* x) { return hn::Load(d, x); };
    V light[kLines] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    for (int s = 0; s < most; ++s) {
      const V number = all(s);
      const V u = hn::Add(lane(from), hn::Mul(hn::Add(number, all(0.5)), lane(step)));
      const V x = hn::Add(lane(place[a]), hn::Mul(u, lane(direction[a])));
      const V y = hn::Add(lane(place[(a + 1) % 3]), hn::Mul(u, lane(direction[(a + 1) % 3])));
      const V z = hn::Add(lane(place[(a + 2) % 3]), hn::Mul(u, lane(direction[(a + 2) % 3])));
      const V q = hn::Add(lane(square), hn::Mul(u, hn::Add(hn::Add(lane(along), lane(along)), u)));
      const V h = hn::Div(q, hn::Add(hn::Sqrt(hn::Add(q, all(kRadius * kRadius))), all(kRadius)));
      const V ahead = hn::Mul(x, all(sign));
      const V inverse = hn::Div(all(1.0), hn::Max(ahead, all(1.0)));
      const V column =
          hn::Add(hn::Mul(hn::Mul(y, inverse), all(kernel.texels)), all(kernel.first_x - window.first_x));
      const V row =
          hn::Add(hn::Mul(hn::Mul(z, inverse), all(kernel.texels)), all(kernel.first_y - window.first_y));
      const auto inside = hn::And(hn::Lt(number, lane(steps)), hn::Gt(ahead, all(1.0)));
      const auto split = [&](V v, int count_of, hn::Vec<I>& whole) {
        const V in = hn::Min(hn::Max(v, hn::Zero(d)), all(count_of - 1));
        whole = hn::Min(hn::ConvertTo(di, in), hn::Set(di, count_of - 2));
        return hn::Sub(in, hn::ConvertTo(d, whole));
      };
      hn::Vec<I> c, r, k;
      const V fx = split(column, window.columns, c), fy = split(row, window.rows, r);
      const V fh = split(hn::Mul(hn::Sub(h, all(profile.bottom_km())), all(4.0)), profile.rows(), k);
      const auto texel = hn::Add(hn::Mul(r, hn::Set(di, window.columns)), c);
      const auto mix = [&](V low, V high, V part) { return hn::Add(low, hn::Mul(hn::Sub(high, low), part)); };
      const float* next = window.flux + window.columns;
      const V low =
          mix(hn::GatherIndex(d, window.flux, texel), hn::GatherIndex(d, window.flux + 1, texel), fx);
      const V high = mix(hn::GatherIndex(d, next, texel), hn::GatherIndex(d, next + 1, texel), fx);
      const V flux = hn::IfThenElseZero(inside, mix(low, high, fy));
      const auto at = hn::Mul(k, hn::Set(di, profile.stride()));
      for (int l = 0; l < kLines; ++l)
        light[l] =
            hn::Add(light[l], hn::Mul(flux, mix(hn::GatherIndex(d, rate + l, at),
                                                hn::GatherIndex(d, rate + profile.stride() + l, at), fh)));
    }
    for (int l = 0; l < kLines; ++l) {
      HWY_ALIGN float sum[16];
      hn::Store(light[l], d, sum);
      for (std::size_t i = 0; i < std::min(lanes, count - first); ++i)
        out[first + i].rayleigh[l] = 0.1 * spans[first + i].step_km * sum[i];
    }
    marched += static_cast<std::size_t>(most) * std::min(lanes, count - first);
  }
  return marched;
}

}  // namespace HWY_NAMESPACE
}  // namespace vegard::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vegard::bench {

HWY_EXPORT(March);

std::size_t march_side_by_side(const sim::FootprintKernel& kernel, int face, const sim::MarchSpan* spans,
                               std::size_t count, sim::SpanLight* out) {
  return HWY_DYNAMIC_DISPATCH(March)(kernel, face, spans, count, out);
}

}  // namespace vegard::bench
#endif
