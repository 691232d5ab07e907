#include "sim/emit/aurora/sheet.h"

#include "sim/base/normal_quantile.h"
#include "sim/base/random.h"

namespace vegard::sim {
namespace {

/// Van der Corput's sequence in base 2: the bits of i mirrored at the point.
double van_der_corput(std::uint32_t i) {
  std::uint32_t bits = 0;
  for (int b = 0; b < 32; ++b) bits |= ((i >> b) & 1u) << (31 - b);
  return (static_cast<double>(bits) + 0.5) / 4294967296.0;
}

}  // namespace

std::vector<BeamPlace> beam_places(const Sheet& sheet, std::uint32_t sheet_index, std::uint32_t layer,
                                   std::uint64_t seed) {
  const auto n = static_cast<std::uint32_t>(sheet.beams);
  const std::uint32_t which = sheet_index * 256 + layer;
  const bool literal = sheet.spacing_rule == "literal";
  const double even_step = 1.0 / n;
  const double shift = uniform(random_words(seed, Stream::cross_section, 0, which)[0]);
  std::vector<BeamPlace> places(n);
  double s = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    const Words words = random_words(seed, Stream::beam_spacing, i, which);
    const double u = uniform(words[0]);
    const double step = literal ? even_step * (u > 0.5 ? 1.0 + u : 1.0 - u)
                                : even_step * (1.0 + sheet.spacing_jitter * (2.0 * u - 1.0));
    BeamPlace& place = places[i];
    place.s = literal ? s : s + 0.5 * step;
    place.s_of_phase = literal ? i * even_step : place.s;
    place.share = literal ? even_step : step;
    s += step;
    double across = van_der_corput(i) + shift;
    if (across >= 1.0) across -= 1.0;
    place.across = normal_quantile(across);
    place.depth = uniform(random_words(seed, Stream::depth, i, which)[0]);
  }
  if (!literal) {
    for (BeamPlace& place : places) {
      place.s /= s;
      place.s_of_phase = place.s;
      place.share /= s;
    }
  }
  return places;
}

}  // namespace vegard::sim
