#include "fit/sky_kind/sky_kind.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "fit/photo/mask/circle.h"
#include "fit/photo/mask/horizon.h"
#include "fit/photo/mask/text.h"
#include "fit/sky_kind/kind_model.h"
#include "fit/sky_kind/sky_lines.h"

namespace vegard::fit {
namespace sky_kind {
namespace {

/// A frame of a closed camera: nearly no light, and nothing in it.
bool is_black(const SkyFeatures& features) {
  constexpr double kLevel_dex = -2.5, kStars = 0.2, kContrast_dex = 0.2;
  return feature(features, SkyFeature::level) < kLevel_dex &&
         feature(features, SkyFeature::star_cover) < kStars &&
         feature(features, SkyFeature::contrast) < kContrast_dex;
}

std::string percent(double probability) {
  constexpr int kMost = 99;  // no answer is certain
  return fmt::format("{} %", std::min(kMost, static_cast<int>(std::lround(100.0 * probability))));
}

/// "Aurora (83 %): one arc (70 %)." or, where no kind is likely enough, "Aurora (83 %), kind unsure: one arc
/// (40 %) or rayed aurora (22 %)."
std::string sentence_of(const SkyFinding& found) {
  const auto of = [&](SkyKind kind) { return found.probabilities[static_cast<std::size_t>(kind)]; };
  if (found.kind == SkyKind::black) return "A black frame, of a closed camera: there is no sky to be seen.";
  const bool has_aurora = is_aurora(found.kind);
  const double either = has_aurora ? found.aurora : 1.0 - found.aurora;
  constexpr double kPerhaps = 0.7;
  const char* words = has_aurora          ? either < kPerhaps ? "Perhaps aurora" : "Aurora"
                      : either < kPerhaps ? "Perhaps no aurora"
                                          : "No aurora";
  std::string text = fmt::format("{} ({})", words, percent(either));
  const auto kind_text = [&](SkyKind kind) {
    return fmt::format("{} ({})", sky_kind_words(kind), percent(of(kind)));
  };
  if (found.is_kind_sure) return text + ": " + kind_text(found.kind) + ".";
  std::optional<SkyKind> second;
  for (int k = 0; k < kSkyKinds; ++k) {
    const auto kind = static_cast<SkyKind>(k);
    if (kind != found.kind && is_aurora(kind) == has_aurora && (!second || of(kind) > of(*second)))
      second = kind;
  }
  return text + ", kind unsure: " + kind_text(found.kind) + " or " + kind_text(*second) + ".";
}

}  // namespace
}  // namespace sky_kind

PixelSet not_sky(const Photo& photo) {
  const int w = photo.linear.width, h = photo.linear.height;
  constexpr double kMargin_px = 2.0;
  PixelSet out(w, h);
  if (const std::optional<CircleFound> circle = find_circle(photo)) {
    add(out, outside_of(circle->circle, w, h, kMargin_px));
  } else if (const std::optional<HorizonFound> horizon = find_horizon(photo)) {
    add(out, below(horizon->horizon, h, kMargin_px));
  }
  add(out, boxes(find_text(photo), w, h));
  return out;
}

SkyFinding kind_of_sky(const SkyFeatures& features) {
  SkyFinding found;
  found.features = features;
  const double sky = sky_kind::is_black(features) ? 0.0 : 1.0;
  if (sky == 0.0) {
    found.probabilities[static_cast<std::size_t>(SkyKind::black)] = 1.0;
  } else {
    found.probabilities = KindModel::built_in().probabilities(features);
  }
  for (int k = 0; k < kSkyKinds; ++k)
    if (is_aurora(static_cast<SkyKind>(k))) found.aurora += found.probabilities[static_cast<std::size_t>(k)];

  // Aurora or none first: five kinds share its probability.
  constexpr double kLikelierThanNot = 0.5;
  found.probability = -1.0;
  for (int k = 0; k < kSkyKinds; ++k) {
    const auto kind = static_cast<SkyKind>(k);
    const double probability = found.probabilities[static_cast<std::size_t>(k)];
    if (is_aurora(kind) != (found.aurora > kLikelierThanNot) || probability <= found.probability) continue;
    found.kind = kind;
    found.probability = probability;
  }
  constexpr double kSureShare = 0.6;
  const double either = is_aurora(found.kind) ? found.aurora : sky - found.aurora;
  found.is_kind_sure = found.kind == SkyKind::black || found.probability >= kSureShare * either;
  found.sentence = sky_kind::sentence_of(found);
  return found;
}

SkyFinding kind_of_sky(const Photo& photo, const PixelSet& left_out) {
  std::vector<std::uint8_t> kept(left_out.in.size());
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = left_out.in[i] == 0 ? 1 : 0;
  SkyFeatures features =
      sky_features(photo, sky_cells(photo.linear.width, photo.linear.height, kept, photo.file_name));
  add_lines(photo, left_out, features);
  return kind_of_sky(features);
}

}  // namespace vegard::fit
