#include "apps/options/site_words.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace vegard::apps::site_words_test {
namespace {

// A minute is a 60th and a second a 3600th of a degree: to the last bits of sums of two quotients.
constexpr double kRounding = 1e-12;

TEST(SiteWords, SaysTheSamePlaceInEveryForm) {
  const std::vector<std::vector<std::string>> forms = {{"78.15", "-16.05"},
                                                       {"78.15N", "16.05W"},
                                                       {"78.15 n", " 16.05w"},
                                                       {"N78.15", "W 16.05"},
                                                       {"16.05W", "78.15N"},
                                                       {"78\u00b09'N", "16\u00b03'W"},
                                                       {"78d9'0\"N", "16d3'W"},
                                                       {"78\u00b0 9\u2032 0\u2033 N", "16\u00b0 3\u2032 W"},
                                                       {"+78.15", "-16.05"},
                                                       {"78\u00b09'", "-16\u00b03'"},
                                                       {"78.15\u00b0N", "16.05\u00b0W"}};
  for (const std::vector<std::string>& form : forms) {
    const sim::Observer place = site_place(form);
    EXPECT_NEAR(place.latitude_deg, 78.15, kRounding) << form[0];
    EXPECT_NEAR(place.longitude_deg, -16.05, kRounding) << form[1];
    EXPECT_EQ(place.height_m, 0.0);
  }
  EXPECT_NEAR(site_place({"0\u00b00'36\"S", "0"}).latitude_deg, -0.01, kRounding);
}

TEST(SiteWords, HasAHeightInMetres) {
  EXPECT_EQ(site_place({"65", "20", "520"}).height_m, 520.0);
  EXPECT_EQ(site_place({"65", "20", "520m"}).height_m, 520.0);
  EXPECT_EQ(site_place({"65", "340", "-3.5 m"}).height_m, -3.5);
  EXPECT_EQ(site_place({"65", "340"}).longitude_deg, 340.0);
}

TEST(SiteWords, RefusesWhatIsNone) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"65"},
                                             {"65N", "20N"},
                                             {"65E", "20"},
                                             {"-65N", "20E"},
                                             {"91", "20"},
                                             {"65", "-181"},
                                             {"nan", "20"},
                                             {"", "20"},
                                             {"65x", "20"},
                                             {"6.5.1", "20"},
                                             {"65", "20", "high"},
                                             {"65\u00b061'N", "20"},
                                             {"65\u00b03'60\"N", "20"},
                                             {"1e1", "20"},
                                             {"65", "20", "inf"}}) {
    const std::string message =
        tests::expect_error(sim::ErrorKind::usage, [&] { site_place(words, "--site"); });
    EXPECT_NE(message.find("--site"), std::string::npos) << (words.empty() ? "" : words[0]);
  }
}

}  // namespace
}  // namespace vegard::apps::site_words_test
