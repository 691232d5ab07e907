// Frames of folders and lists, with their times, and those that are skipped.
#include "fit/survey/survey_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit/survey/survey.h"
#include "sim/base/utc_time.h"
#include "tests/support/expect_error.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/frames/made_video.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_frames_test {
namespace {

using tests::expect_error;
using tests::put;

Survey survey_in(const tests::TemporaryFolder& folder, const std::string& frames,
                 const std::string& more = "") {
  return parse_survey(
      "[survey]\nname = \"a\"\nwork = [\"border\"]\nscene = \"a.toml\"\n[[camera]]\nname = \"b\"\nframes = "
      "[" +
          frames + "]\n" + more,
      folder / "survey.toml");
}

ListedFrames frames_of(const Survey& survey) { return survey_frames(survey, survey.cameras[0]); }

std::vector<std::string> names_of(const ListedFrames& listed) {
  std::vector<std::string> names;
  for (const PlannedFrame& frame : listed.frames) names.push_back(frame.file);
  return names;
}

TEST(SurveyFrames, OfAFolderAreInTheOrderOfTime) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in/second");
  std::filesystem::create_directories(folder / "in/.hidden");
  for (const char* name :
       {"in/b_20190301_221003.png", "in/second/a_20190301_221000.JPG", "in/a_20190301_221003.png",
        "in/.partial_20190301_221001.png", "in/.hidden/a_20190301_221001.png", "in/notes.md",
        "in/20190301_221000.txt", "in/.png"})
    put(folder / name, "");
  const ListedFrames listed = frames_of(survey_in(folder, "\"in/\", \"./in\""));
  EXPECT_EQ(names_of(listed),
            (std::vector<std::string>{"in/second/a_20190301_221000.JPG", "in/a_20190301_221003.png",
                                      "in/b_20190301_221003.png"}));
  EXPECT_EQ(listed.frames[1].time_s, *sim::utc_seconds("2019-03-01T22:10:03Z"));
  ASSERT_EQ(listed.sources.size(), 2u);
  EXPECT_EQ(listed.sources[0].sha256, listed.sources[1].sha256);
}

TEST(SurveyFrames, OfAListMayTellTheirTimesAndNeedNotExist) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "lists");
  put(folder / "lists/a.txt",
      "# when\n\nnight.pgm.gz#1 2019-03-01T22:10:03.5Z\r\n../my frame.png 2019-03-01 "
      "22:10:00\nb/20190301_221001.png\n");
  const ListedFrames listed = frames_of(survey_in(folder, "\"lists/a.txt\""));
  EXPECT_EQ(names_of(listed), (std::vector<std::string>{"my frame.png", "lists/b/20190301_221001.png",
                                                        "lists/night.pgm.gz#1"}));
  EXPECT_EQ(listed.frames[2].time_s - listed.frames[0].time_s, 3.5);
}

TEST(SurveyFrames, ThatAreSkippedKeepTheirReason) {
  const tests::TemporaryFolder folder;
  for (const char* name :
       {"20190301_221000.png", "20190301_221001.png", "20190301_221002.png", "20190301_221003.png"})
    put(folder / name, "");
  put(folder / "bad.txt", "20190301_221003.png\n20190301_221001.png\n");
  const ListedFrames listed = frames_of(survey_in(
      folder, "\".\"",
      "[[skip]]\nfrom = \"2019-03-01T22:10:01Z\"\nuntil = \"2019-03-01T22:10:03Z\"\nreason = \"fog\"\n"
      "[[skip]]\nlist = \"bad.txt\"\nreason = \"a lamp\"\n"));
  std::vector<std::string> reasons;
  for (const PlannedFrame& frame : listed.frames) reasons.push_back(frame.skip);
  EXPECT_EQ(reasons, (std::vector<std::string>{"", "fog", "fog", "a lamp"}));
}

std::vector<double> seconds_of(const ListedFrames& listed, const std::string& from) {
  std::vector<double> seconds;
  for (const PlannedFrame& frame : listed.frames) seconds.push_back(frame.time_s - *sim::utc_seconds(from));
  return seconds;
}

TEST(SurveyFrames, OfAFileOfManyAreEachWithItsOwnTime) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  const std::string name = "20140310_0603_gill_themis19_full.pgm";
  put(folder / ("in/" + name + ".gz"), tests::gzip_stored(tests::frames_bytes()));
  tests::MadeFrames next;
  next.begin = "2014-03-10 06:04:";
  put(folder / "next.pgm", tests::frames_bytes(next));
  put(folder / "list.txt", "next.pgm\nin/20140310_0605_gill_themis19_full.pgm.gz\n");
  const ListedFrames listed = frames_of(survey_in(folder, "\"in\", \"list.txt\""));
  EXPECT_EQ(names_of(listed),
            (std::vector<std::string>{"in/" + name + ".gz#0", "in/" + name + ".gz#1", "in/" + name + ".gz#2",
                                      "next.pgm#0", "next.pgm#1", "next.pgm#2",
                                      "in/20140310_0605_gill_themis19_full.pgm.gz"}));
  EXPECT_EQ(seconds_of(listed, "2014-03-10T06:03:00Z"),
            (std::vector<double>{0.25, 3.25, 6.25, 60.25, 63.25, 66.25, 120.0}));
}

TEST(SurveyFrames, OfAFileOfOneIsThatFile) {
  const tests::TemporaryFolder folder;
  const std::string frame = frame_bytes(tests::MadeFrames(), 1);
  put(folder / "20140310_0600_gill_themis19_full.pgm.gz", tests::gzip_stored(frame));
  put(folder / "20140310_0607_gill_themis19_full.pgm", "P5 1 1 255\nx");  // says nothing of itself
  const ListedFrames listed = frames_of(survey_in(folder, "\".\""));
  EXPECT_EQ(names_of(listed), (std::vector<std::string>{"20140310_0600_gill_themis19_full.pgm.gz",
                                                        "20140310_0607_gill_themis19_full.pgm"}));
  EXPECT_EQ(seconds_of(listed, "2014-03-10T06:03:00Z"), (std::vector<double>{3.25, 240.0}));
}

// Of one whose pixels are cut that frame itself is what cannot be read.
TEST(SurveyFrames, BehindDamageAreOneThatStandsForThem) {
  const tests::TemporaryFolder folder;
  const std::string whole = tests::frames_bytes();
  put(folder / "cut_20140310_060300.pgm", whole.substr(0, whole.size() - 20));
  std::string damaged = whole;
  damaged.replace(damaged.rfind("P5"), 2, "XX");
  put(folder / "cut_20140310_060400.pgm", damaged);
  put(folder / "cut_20140310_060500.pgm.gz", tests::gzip_stored(whole).substr(0, 100));
  const ListedFrames listed = frames_of(survey_in(folder, "\".\""));
  std::vector<std::string> names = names_of(listed);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"cut_20140310_060300.pgm#0", "cut_20140310_060300.pgm#1",
                                             "cut_20140310_060300.pgm#2", "cut_20140310_060400.pgm#0",
                                             "cut_20140310_060400.pgm#1", "cut_20140310_060400.pgm#2",
                                             "cut_20140310_060500.pgm.gz"}));
}

TEST(SurveyFrames, AreRefusedWhereTheyTellNoTimeOrAreNotThere) {
  const tests::TemporaryFolder folder;
  put(folder / "in.png", "");
  put(folder / "list.txt", "20190301_221000.png\nframe.png 22:10\n");
  std::filesystem::create_directories(folder / "empty");
  const auto error_of = [&](sim::ErrorKind kind, const std::string& frames) {
    return tests::expect_error(kind, [&] { frames_of(survey_in(folder, frames)); });
  };
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"in.png\"").find("has no time"), std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"list.txt\"").find("list.txt:2"), std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"none\"").find("no such file"), std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"none.txt\"").find("none.txt"), std::string::npos);
  put(folder / "many_20190301_221000.pgm", "P5 1 1 255\nxP5 1 1 255\ny");
  EXPECT_TRUE(tests::has_facts(error_of(sim::ErrorKind::unreadable_input, "\"many_20190301_221000.pgm\""),
                               "frame 0 | 'many_20190301_221000.pgm'"));
  EXPECT_NE(error_of(sim::ErrorKind::scene, "\"empty\"").find("has no frame"), std::string::npos);
}

TEST(SurveyFrames, OfAFilmAreTakenFromItsNameOrFromAStart) {
  const tests::TemporaryFolder folder;
  tests::MadeVideo made;
  made.times_ms = {0, 500, 2000};
  made.words = {{"creation_time", "2019-03-01T23:00:00Z"}};
  made.codes = [](int) { return std::array<int, 3>{100, 128, 128}; };
  put(folder / "sky_20190301_221000.mp4", tests::video_bytes(made));
  put(folder / "film.mp4", tests::video_bytes(made));
  const double start_s = *sim::utc_seconds("2019-03-01T22:10:00Z");
  const auto expect_times = [&](const ListedFrames& listed, const std::vector<double>& after_s) {
    ASSERT_EQ(listed.frames.size(), after_s.size());
    for (std::size_t i = 0; i < after_s.size(); ++i)
      EXPECT_NEAR(listed.frames[i].time_s, start_s + after_s[i], 1e-6);
  };
  const ListedFrames named = frames_of(survey_in(folder, "\"sky_20190301_221000.mp4\""));
  EXPECT_EQ(named.frames[1].file, "sky_20190301_221000.mp4#1");
  expect_times(named, {0.0, 0.5, 2.0});

  const std::string refusal =
      expect_error(sim::ErrorKind::unreadable_input, [&] { frames_of(survey_in(folder, "\"film.mp4\"")); });
  EXPECT_TRUE(tests::has_facts(refusal, "film.mp4 | start | creation_time | 2019-03-01T23:00:00"));
  const std::string start = "start = \"2019-03-01T22:10:00Z\"\n";
  expect_times(frames_of(survey_in(folder, "\"film.mp4\"", start)), {0.0, 0.5, 2.0});
  expect_times(frames_of(survey_in(folder, "\"film.mp4\"", start + "step_s = 10\n")), {0.0, 10.0, 20.0});
  const std::string second = expect_error(sim::ErrorKind::unreadable_input, [&] {
    frames_of(survey_in(folder, "\"film.mp4\", \"sky_20190301_221000.mp4\"", start));
  });
  EXPECT_TRUE(tests::has_facts(second, "step_s"));
}

TEST(SurveyFrames, OfATimeLapseHaveStartAndStep) {
  const tests::TemporaryFolder folder;
  for (const char* name : {"in/IMG_0002.jpg", "in/IMG_0001.jpg", "in/IMG_0003.jpg"}) {
    std::filesystem::create_directories(folder / "in");
    put(folder / name, "");
  }
  const std::string start = "start = \"2019-03-01T22:10:00Z\"\nstep_s = 12.5\n";
  const ListedFrames listed = frames_of(survey_in(folder, "\"in\"", start));
  EXPECT_EQ(names_of(listed),
            (std::vector<std::string>{"in/IMG_0001.jpg", "in/IMG_0002.jpg", "in/IMG_0003.jpg"}));
  EXPECT_EQ(listed.frames[2].time_s, *sim::utc_seconds("2019-03-01T22:10:25Z"));
  EXPECT_TRUE(tests::has_facts(
      expect_error(sim::ErrorKind::scene, [&] { survey_in(folder, "\"in\"", "step_s = 12.5\n"); }), "start"));
}

}  // namespace
}  // namespace vegard::fit::survey_frames_test
