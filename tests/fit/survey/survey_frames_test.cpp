// Frames of folders and lists, with their times, and those that are skipped.
#include "fit/survey/survey_frames.h"

#include <gtest/gtest.h>

#include "fit/survey/survey_toml.h"
#include "sim/base/utc_time.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_frames_test {
namespace {

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
  for (const ListedFrame& frame : listed.frames) names.push_back(frame.file);
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
  for (const ListedFrame& frame : listed.frames) reasons.push_back(frame.skip);
  EXPECT_EQ(reasons, (std::vector<std::string>{"", "fog", "fog", "a lamp"}));
}

TEST(SurveyFrames, AreRefusedWhereTheyTellNoTimeOrAreNotThere) {
  const tests::TemporaryFolder folder;
  put(folder / "in.png", "");
  put(folder / "list.txt", "20190301_221000.png\nframe.png 22:10\n");
  std::filesystem::create_directories(folder / "empty");
  const auto error_of = [&](sim::ErrorKind kind, const std::string& frames) {
    return tests::expect_error(kind, [&] { frames_of(survey_in(folder, frames)); });
  };
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"in.png\"").find("tells no time"),
            std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"list.txt\"").find("list.txt:2"), std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"none\"").find("there is no such file"),
            std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::unreadable_input, "\"none.txt\"").find("none.txt"), std::string::npos);
  EXPECT_NE(error_of(sim::ErrorKind::scene, "\"empty\"").find("has no frame"), std::string::npos);
}

}  // namespace
}  // namespace vegard::fit::survey_frames_test
