// A survey's pages: nights, what is counted, what is thinned, and when a folder is replaced.
#include "fit/survey/report/survey_report.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fit/survey/report/night_digest.h"
#include "fit/survey/survey_results.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_report_test {
namespace {

using tests::bytes_of;

/// Two nights of two cameras, a frame every ten minutes from 20 to 2 o'clock UTC; "abisko" has no flux.
SurveyPlan made_nights_plan() {
  SurveyPlan plan = tests::made_survey_plan(4, 36, "nights");
  plan.cameras.push_back(plan.cameras[0]);
  plan.cameras[0].name = "abisko";
  plan.cameras[1].name = "gill";
  for (int b = 0; b < 4; ++b) {
    PlannedBlock& block = plan.blocks[static_cast<std::size_t>(b)];
    block.camera = b / 2;
    for (std::size_t f = 0; f < block.frames.size(); ++f)
      block.frames[f].time_s = 1551470400.0 + 86400.0 * (b % 2) + 600.0 * static_cast<double>(f);  // 20:00
  }
  plan.sha256 = sim::sha256(plan_json(plan));
  return plan;
}

FrameAnswer made_night_answer(const SurveyPlan& plan, int block, int number) {
  FrameAnswer answer = tests::made_answer(plan, block, number);
  answer.camera = block < 2 ? "abisko" : "gill";
  if (answer.status != FrameStatus::done) return answer;
  WorkAnswer& border = answer.works[0];
  if (number % 2 == 0) {
    border.verdict = "good";
    border.quantities = {{1, "highest elevation", "deg", 30.0 + number, 0.4, {}, {}},
                         {1, "nearest azimuth", "deg", 10.0, {}, {}, {}},
                         {2, "highest elevation", "deg", 88.0, 0.4, {}, {}}};
  }
  WorkAnswer& fit = answer.works[1];
  fit.quantities.push_back(
      {0, "mean electron energy of the main sheet", "keV", 3.0 + 0.1 * number, 0.2, {}, {}});
  if (block >= 2) fit.quantities[1] = {0, "energy flux Q of the main sheet", "mW", 2.0 + number, 0.1, {}, {}};
  if (number == 3) {
    fit.verdict = "refused";
    fit.words = "the file ends after 3000 bytes <script>";
  }
  return answer;
}

std::string made_database(const tests::TemporaryFolder& folder, const SurveyPlan& plan) {
  const std::string name = folder / "nights.sqlite";
  ShardResults results(name, plan);
  std::vector<FrameAnswer> all;  // at once: each transaction waits for the disk
  for (int b = 0; b < 4; ++b)
    for (int f = 0; f < 36; ++f) all.push_back(made_night_answer(plan, b, f));
  results.add(all);
  return name;
}

TEST(SurveyReport, EndsNightsWhereNobodyLooks) {
  std::vector<int> steps(144, 0);
  for (int s = 17 * 6; s < 24 * 6; ++s) steps[s] = 3;
  for (int s = 0; s < 5 * 6; ++s) steps[s] = 3;
  EXPECT_EQ(night_boundary_s(steps), 11 * 3600);
  // Alaska: from 3 to 15 o'clock UTC.
  std::fill(steps.begin(), steps.end(), 0);
  for (int s = 3 * 6; s < 15 * 6; ++s) steps[s] = 3;
  EXPECT_EQ(night_boundary_s(steps), 21 * 3600);
  // Without a pause: where there are fewest.
  std::fill(steps.begin(), steps.end(), 9);
  steps[70] = 2;
  EXPECT_EQ(night_boundary_s(steps), 70 * 600 + 300);
}

TEST(SurveyReport, FindsTheNightsOfAllCameras) {
  const tests::TemporaryFolder folder;
  const SqliteFile database(made_database(folder, made_nights_plan()), SqliteFile::Opening::read);
  const SurveyNights nights = survey_nights(database);
  ASSERT_EQ(nights.nights.size(), 2u);
  EXPECT_EQ(nights.nights[0].name, "2019-03-01");
  EXPECT_EQ(nights.nights[1].name, "2019-03-02");
  for (const SurveyNight& night : nights.nights) {
    ASSERT_EQ(night.cameras.size(), 2u);
    EXPECT_EQ(night.cameras[0].camera, "abisko");
    for (const CameraNight& camera : night.cameras) {
      ASSERT_EQ(camera.ranges.size(), 1u);
      EXPECT_EQ(camera.ranges[0].end - camera.ranges[0].first, 36);
    }
  }
}

TEST(SurveyReport, CountsWhatTheFramesSay) {
  const tests::TemporaryFolder folder;
  const SqliteFile database(made_database(folder, made_nights_plan()), SqliteFile::Opening::read);
  const SurveyReader reader(database);
  const NightDigest digest = digest_night(reader, {"gill", {{72, 108}}}, {});
  EXPECT_EQ(digest.frames, 36);
  // Frames 72, 77, … are missing: number % 5 == 0.
  EXPECT_EQ(digest.statuses.at(FrameStatus::missing), 8);
  EXPECT_EQ(digest.verdicts.at(SurveyWork::fit).at("good"), 27);
  EXPECT_EQ(digest.verdicts.at(SurveyWork::fit).at("refused"), 1);
  // Even numbers without those that are missing (0, 10, 20, 30).
  EXPECT_EQ(digest.verdicts.at(SurveyWork::border).at("good"), 14);
  EXPECT_EQ(points_of(digest, FollowedKind::border).size(), 14u);  // of the brightest trace alone
  EXPECT_EQ(points_of(digest, FollowedKind::energy).size(), 27u);
  EXPECT_EQ(digest.energies.size(), 27u);
  EXPECT_EQ(digest.verdicts_of_hour.size(), 6u);
  ASSERT_EQ(digest.failures.size(), 2u);
  EXPECT_EQ(digest.failures.at("missing: there is no such file").frames, 8);
  EXPECT_EQ(digest.failures.at("missing: there is no such file").some.size(), 5u);
  EXPECT_EQ(digest.failures.count("fit refused: the file ends after \u2026 bytes <script>"), 1u);
  const NightDigest other = digest_night(reader, {"abisko", {{0, 36}}}, {});
  EXPECT_TRUE(other.energies.empty());
  EXPECT_TRUE(tests::has_facts(other.why_no_flux, "no gain"));
}

TEST(SurveyReport, KnowsWhereACurtainStood) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_nights_plan();
  const std::string name = folder / "one.sqlite";
  ShardResults results(name, plan);
  FrameAnswer answer = made_night_answer(plan, 0, 0);
  answer.works[0].quantities = {{1, "distance if 105 km high", "km", 6371.0 * 0.0174532925, 1.0, {}, {}},
                                {1, "nearest azimuth", "deg", 0.0, {}, {}, {}}};
  results.add({answer});
  const SqliteFile database(name, SqliteFile::Opening::read);
  sim::Site site;
  site.latitude_deg = 65.0;
  const NightDigest digest =
      digest_night(SurveyReader(database), {"abisko", {{0, 1}}}, [&](int) { return &site; });
  ASSERT_EQ(digest.latitudes.size(), 1u);
  EXPECT_NEAR(digest.latitudes[0].latitude_deg, 66.0, 1e-6);  // a degree to the north
}

TEST(SurveyReport, ThinsByTheMedianOfEachStretch) {
  std::vector<FollowedPoint> points;
  for (int i = 0; i < 900; ++i) points.push_back({i + 0.5, i % 9 == 4 ? 1e6 : i % 9, 0.5, true});
  const std::vector<FollowedPoint> kept = thinned(points, {0.0, 900.0}, 100);
  ASSERT_EQ(kept.size(), 100u);
  // Of 0, 1, 2, 3, 10^6, 5, 6, 7, 8 that is 5, the sixth frame of each stretch.
  for (std::size_t i = 0; i < kept.size(); ++i) {
    EXPECT_EQ(kept[i].value, 5.0);
    EXPECT_EQ(kept[i].time_s, 9.0 * static_cast<double>(i) + 5.5);
  }
  EXPECT_EQ(thinned(points, {0.0, 900.0}, 1000).size(), 900u);
}

TEST(SurveyReport, WritesAPageForEachNightAndOneForAll) {
  const tests::TemporaryFolder folder;
  const SurveyPlan plan = made_nights_plan();
  const SqliteFile database(made_database(folder, plan), SqliteFile::Opening::read);
  SurveyReportOptions options;
  const SurveyReport report = write_survey_report(database, folder / "pages", options);
  EXPECT_EQ(report.nights, 2);
  EXPECT_EQ(report.keograms, 0);
  EXPECT_NE(report.why_no_keogram.find("--plan"), std::string::npos);
  const std::string index = bytes_of(folder / "pages/index.html"),
                    night = bytes_of(folder / "pages/night-2019-03-01.html");
  EXPECT_TRUE(tests::has_facts(index, "144 frames | 2 cameras | 2 nights"));
  EXPECT_NE(index.find("<a href=\"night-2019-03-02.html\">"), std::string::npos);
  EXPECT_TRUE(tests::has_facts(night, "72 frames | 2 cameras | 20:00 | 01:50"));
  EXPECT_NE(night.find("night-2019-03-02.html\">2019-03-02"), std::string::npos);
  for (const std::string& page : {index, night}) {
    EXPECT_NE(page.find("no such file"), std::string::npos);
    EXPECT_NE(page.find("bytes &lt;script&gt;"), std::string::npos);
    // Nothing is run, and nothing is fetched.
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    EXPECT_EQ(page.find("href=\"http"), std::string::npos);
  }
  // Again: the same bytes; not in the place of the old one unasked, nor of a stranger's folder.
  tests::expect_error(sim::ErrorKind::existing_output,
                      [&] { write_survey_report(database, folder / "pages", options); });
  options.overwrite = true;
  write_survey_report(database, folder / "pages", options);
  EXPECT_EQ(bytes_of(folder / "pages/index.html"), index);
  EXPECT_EQ(bytes_of(folder / "pages/night-2019-03-01.html"), night);
  std::filesystem::create_directory(folder / "mine");
  std::ofstream(folder / "mine/index.html") << "<html>mine</html>";
  tests::expect_error(sim::ErrorKind::existing_output,
                      [&] { write_survey_report(database, folder / "mine", options); });
  EXPECT_EQ(bytes_of(folder / "mine/index.html"), "<html>mine</html>");
  // A plan that it is not of.
  const SurveyPlan other = tests::made_survey_plan(4, 36, "other");
  options.frames.plan = &other;
  tests::expect_error(sim::ErrorKind::usage,
                      [&] { write_survey_report(database, folder / "other", options); });
  EXPECT_FALSE(std::filesystem::exists(folder / "other"));
}

// All fits ask for the same: half a standard deviation of a mode, of which 630.0 nm has 30 %.
TEST(SurveyReport, SaysWhatTheNightAsksOfTheTables) {
  const tests::TemporaryFolder folder;
  const SqliteFile database(made_database(folder, made_nights_plan()), SqliteFile::Opening::read);
  SurveyReportOptions options;
  options.keograms = false;
  write_survey_report(database, folder / "pages", options);
  const std::string page = bytes_of(folder / "pages/night-2019-03-01.html");
  EXPECT_NE(page.find("630.0 nm over 557.7 nm"), std::string::npos);
  EXPECT_NE(page.find("night-2019-03-01-physics.csv"), std::string::npos);
  const std::string table = bytes_of(folder / "pages/night-2019-03-01-physics.csv");
  EXPECT_NE(table.find("\ncamera,file,time_utc,physics,name,"), std::string::npos);
  EXPECT_NE(
      table.find("\nabisko,gill/0.png,2019-03-01T20:00:00Z,used,distance of the main sheet,km,220,3.25,"),
      std::string::npos);
  // A report is written again in the place of one.
  options.overwrite = true;
  write_survey_report(database, folder / "pages", options);
  EXPECT_EQ(bytes_of(folder / "pages/night-2019-03-01-physics.csv"), table);
  SqliteFile spoilt(folder / "nights.sqlite", SqliteFile::Opening::write);
  spoilt.run("UPDATE result SET physics = '{\"modes\": 3}' WHERE work = 'fit'");
  EXPECT_NE(tests::expect_error(sim::ErrorKind::unreadable_input,
                                [&] { write_survey_report(spoilt, folder / "other", options); })
                .find("nights.sqlite"),
            std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::survey_report_test
