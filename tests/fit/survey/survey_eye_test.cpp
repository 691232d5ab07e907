// What a camera must tell for the work that a survey is to do.
#include "fit/survey/survey_frame.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::fit::survey_eye_test {
namespace {

TEST(SurveyEye, OfTheFilterNeedsASite) {
  SurveyEye eye;
  const std::string words =
      tests::expect_error(sim::ErrorKind::scene, [&] { check_eye(eye, {SurveyWork::filter}); });
  EXPECT_NE(words.find("site"), std::string::npos) << words;
  check_eye(eye, {SurveyWork::border});
  eye.scene.site.latitude_deg = 61.2;
  eye.scene.site.longitude_deg = 21.3;
  check_eye(eye, {SurveyWork::filter});
}

TEST(SurveyEye, OfLightNeedsAKnownCurve) {
  SurveyEye eye;
  eye.decoding.kind = Decoding::Kind::unknown;
  for (const SurveyWork work : {SurveyWork::profile, SurveyWork::map})
    tests::expect_error(sim::ErrorKind::scene, [&] { check_eye(eye, {work}); });
  check_eye(eye, {SurveyWork::border});
}

}  // namespace
}  // namespace vegard::fit::survey_eye_test
