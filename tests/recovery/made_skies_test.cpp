// Stars recognised in 200 made pictures that have some and in 200 that have none, without a camera and with
// an earlier one. VEGARD_MADE_SKIES=FIRST,COUNT runs a part and tells of each picture; FIRST,COUNT,20 draws
// only fields of 20 degrees and more, FIRST,COUNT,5,20 leaves out those that are wider than 20 degrees.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <optional>

#include "fit/photo/pointing/blind/sky_place.h"
#include "fit/photo/pointing/catalogue_sky.h"
#include "fit/photo/pointing/identification.h"
#include "sim/base/number/constants.h"
#include "tests/recovery/made_skies/made_stars.h"

namespace vegard::tests::made_skies_test {
namespace {

// Of pictures with six findable stars, of 20 degrees and more and of less; 97 % are asked for.
constexpr double kLeastShare = 0.85, kLeastNarrowShare = 0.75;

struct Part {
  unsigned first = 0, count = 200;
  double narrowest_deg = 5.0, widest_deg = 180.0;
};

Part part() {
  Part one;
  if (const char* words = std::getenv("VEGARD_MADE_SKIES"))
    std::sscanf(words, "%u,%u,%lf,%lf", &one.first, &one.count, &one.narrowest_deg, &one.widest_deg);
  return one;
}

/// The camera of the observer's sky that is claimed without an earlier one.
std::optional<fit::SkyCamera> recognised(const MadeStars& sky) {
  fit::RecognitionSettings settings;
  settings.zenith = fit::zenith_of(sky.observer, sky.julian_date);
  const fit::PictureStars found = fit::recognise_picture(sky.picture, {}, {}, settings);
  if (!found.recognition.found) return std::nullopt;
  const fit::LocalStars local = fit::local_stars(found, sky.frame, sky.observer, sky.julian_date, 4.0, 5.0);
  if (local.elsewhere) return std::nullopt;
  return local.camera;
}

/// The same from an earlier camera, three degrees off, as `vegard calibrate --camera` does.
std::optional<fit::SkyCamera> found_from_earlier(const MadeStars& sky, std::uint32_t number) {
  fit::SkyCamera earlier = sky.truth;
  const double most = std::min(3.0 * sim::kRadiansPerDegree, 10.0 / sky.truth.numbers[fit::focal_px_number]);
  for (int i = 0; i < 3; ++i)
    earlier.numbers[i] = most * (2.0 * drawn(91, number, 1, static_cast<std::uint32_t>(i)) - 1.0);
  earlier = fit::with_rotation_applied(earlier);
  fit::IdentificationSettings settings;
  settings.free = {fit::turn_about_right, fit::turn_about_down, fit::turn_about_forward, fit::centre_x_number,
                   fit::centre_y_number};
  const std::vector<fit::StarSighting> catalogue =
      fit::field_sky(earlier, sky.frame, sky.observer, sky.julian_date, 5.0);
  settings.faintest = fit::faintest_for_field(earlier, sky.frame, catalogue, settings.faintest);
  settings.first_magnitude = std::max(settings.first_magnitude, settings.faintest - 1.5);
  const fit::Identification found =
      fit::identify(earlier, sky.frame, catalogue, fit::find_stars(sky.picture), settings);
  if (!fit::is_trustworthy(found)) return std::nullopt;
  return found.camera;
}

/// What became of a picture.
struct Outcome {
  bool claimed = false, right = false;
  double seconds = 0.0;  ///< of the processor, over all threads: the same on a machine that does other things
};

Outcome outcome_of(const MadeStars& sky, const std::function<std::optional<fit::SkyCamera>()>& search) {
  const std::clock_t begin = std::clock();
  const std::optional<fit::SkyCamera> found = search();
  return {found.has_value(), found && is_right(sky, *found),
          static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC};
}

const char* word_of(const Outcome& one) { return one.right ? "right" : one.claimed ? "WRONG" : "refused"; }

/// Counts over pictures of a kind.
struct Tally {
  int of = 0, right = 0, wrong = 0;
  double longest_s = 0.0, longest_refusal_s = 0.0, total_s = 0.0;

  void add(const Outcome& one) {
    ++of;
    right += one.right;
    wrong += one.claimed && !one.right;
    total_s += one.seconds;
    longest_s = std::max(longest_s, one.seconds);
    if (!one.claimed) longest_refusal_s = std::max(longest_refusal_s, one.seconds);
  }
  void tell(const char* kind) const {
    std::printf("%-58s %3d of %3d right, %d wrong; %.2f s each, %.1f s at most, a refusal %.1f s\n", kind,
                right, of, wrong, of > 0 ? total_s / of : 0.0, longest_s, longest_refusal_s);
  }
};

// Seed 45. A claim is made at an expected 1e-8 wrong ones a search: one would be a mistake of the test of
// chance. The catalogue ends at magnitude 8: in fields below 20 degrees many of the picture's stars are not
// in it, and they are counted apart.
TEST(MadeSkies, AreRecognisedWhereStarsAre) {
  Tally wide, narrow, few, wide_earlier, narrow_earlier, few_earlier;
  const Part those = part();
  for (std::uint32_t number = those.first; number < those.first + those.count; ++number) {
    const MadeStars sky = made_stars(45, number, true, those.narrowest_deg);
    if (sky.fov_deg > those.widest_deg) continue;
    const Outcome blind = outcome_of(sky, [&] { return recognised(sky); });
    const Outcome earlier = outcome_of(sky, [&] { return found_from_earlier(sky, number); });
    const bool is_narrow = sky.fov_deg < 20.0, is_few = sky.findable < 6;
    (is_few ? few : is_narrow ? narrow : wide).add(blind);
    (is_few ? few_earlier : is_narrow ? narrow_earlier : wide_earlier).add(earlier);
    if (!blind.right || !earlier.right || std::getenv("VEGARD_MADE_SKIES") != nullptr)
      std::printf(
          "sky %u: %d findable stars of the catalogue and %d others, %.0f degrees: %s in %.1f s, from an "
          "earlier "
          "camera %s\n",
          number, sky.findable, sky.nameless, sky.fov_deg, word_of(blind), blind.seconds, word_of(earlier));
  }
  wide.tell("six findable stars or more, 20 to 180 degrees:");
  wide_earlier.tell("  from an earlier camera:");
  narrow.tell("six findable stars or more, 5 to 20 degrees:");
  narrow_earlier.tell("  from an earlier camera:");
  few.tell("fewer findable stars:");
  few_earlier.tell("  from an earlier camera:");
  for (const Tally* one : {&wide, &narrow, &few, &wide_earlier, &narrow_earlier, &few_earlier})
    EXPECT_EQ(one->wrong, 0);
  EXPECT_GE(wide.right, wide.of * kLeastShare);
  EXPECT_GE(narrow.right, narrow.of * kLeastNarrowShare);
}

TEST(MadeSkies, NothingIsClaimedWithoutStars) {
  Tally blind, earlier;
  const Part those = part();
  for (std::uint32_t number = those.first; number < those.first + those.count; ++number) {
    const MadeStars sky = made_stars(46, number, false, those.narrowest_deg);
    if (sky.fov_deg > those.widest_deg) continue;
    const Outcome alone = outcome_of(sky, [&] { return recognised(sky); });
    const Outcome from_earlier = outcome_of(sky, [&] { return found_from_earlier(sky, number); });
    blind.add(alone);
    earlier.add(from_earlier);
    if (alone.claimed || from_earlier.claimed || std::getenv("VEGARD_MADE_SKIES") != nullptr)
      std::printf("no stars, %u: %.0f degrees: %s in %.1f s, from an earlier camera %s\n", number,
                  sky.fov_deg, alone.claimed ? "CLAIMED" : "refused", alone.seconds,
                  from_earlier.claimed ? "CLAIMED" : "refused");
  }
  blind.tell("without stars (claims are wrong or right alike):");
  earlier.tell("  from an earlier camera:");
  EXPECT_EQ(blind.wrong + blind.right, 0);
  EXPECT_EQ(earlier.wrong + earlier.right, 0);
}

}  // namespace
}  // namespace vegard::tests::made_skies_test
