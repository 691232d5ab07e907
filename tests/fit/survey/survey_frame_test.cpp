// One frame of a survey: whatever is wrong with it is in its answer.
#include "fit/survey/survey_frame.h"

#include <gtest/gtest.h>

#include <atomic>

#include "fit/photo/mask/mask_picture.h"
#include "sim/base/file/sha256.h"
#include "tests/fit/survey/made_answers.h"
#include "tests/support/expect_error.h"
#include "tests/support/fits_bytes.h"
#include "tests/support/frames/gzip_bytes.h"
#include "tests/support/frames/made_frames.h"
#include "tests/support/temporary_folder.h"

namespace vegard::fit::survey_frame_test {
namespace {

/// A survey of borders whose frames are these, in a folder.
class SurveyOfFiles {
 public:
  explicit SurveyOfFiles(const std::vector<std::string>& files) : plan_(tests::made_survey_plan(1, 1)) {
    plan_.file = folder_ / "plan.json";
    plan_.work = {SurveyWork::border};
    plan_.blocks[0].frames.clear();
    for (const std::string& file : files)
      plan_.blocks[0].frames.push_back(
          {file, 1551478200.0 + 3.0 * static_cast<double>(plan_.blocks[0].frames.size()), {}});
    eye_.scene.camera.width = 40;
    eye_.scene.camera.height = 30;
  }

  void put(const std::string& name, const std::string& bytes) { tests::put(folder_ / name, bytes); }
  static std::string png(int width, int height) { return mask_png(PixelSet(width, height)); }

  std::optional<FrameAnswer> answer(int number, const std::atomic<bool>* stop = nullptr) const {
    FitOptions options;
    options.threads = 1;
    options.stop = stop;
    return survey_frame({&plan_, 0, number, nullptr}, &eye_, options, pictures_);
  }

  SurveyEye& eye() { return eye_; }
  SurveyPlan& plan() { return plan_; }
  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  tests::TemporaryFolder folder_;
  SurveyPlan plan_;
  SurveyEye eye_;
  mutable SurveyPictures pictures_;
};

TEST(SurveyFrame, ThatCannotBeHadSaysWhy) {
  SurveyOfFiles survey({"none.png", "junk.png", "folder", "a.png#3", "a.png"});
  survey.put("junk.png", "no picture");
  survey.put("a.png", SurveyOfFiles::png(40, 30));
  std::filesystem::create_directories(survey.path("folder"));
  const FrameAnswer none = *survey.answer(0), junk = *survey.answer(1);
  EXPECT_EQ(none.status, FrameStatus::missing);
  EXPECT_TRUE(tests::has_facts(none.reason.value_or(""), "no such file"));
  EXPECT_FALSE(none.sha256);
  EXPECT_EQ(junk.status, FrameStatus::unreadable);
  EXPECT_EQ(junk.sha256, sim::sha256("no picture"));
  ASSERT_TRUE(junk.reason);
  EXPECT_EQ(junk.reason->find(survey.path("")), std::string::npos) << *junk.reason;  // of no machine
  EXPECT_EQ(survey.answer(2)->reason, "is a directory");
  EXPECT_EQ(survey.answer(3)->status, FrameStatus::unreadable);
  survey.plan().blocks[0].frames[4].skip = "fog";
  EXPECT_EQ(survey.answer(4)->status, FrameStatus::skipped);
  EXPECT_EQ(survey.answer(4)->reason, "fog");
}

TEST(SurveyFrame, HasAnAnswerForEachWork) {
  SurveyOfFiles survey({"a.png", "b.png"});
  survey.put("a.png", SurveyOfFiles::png(40, 30));
  survey.put("b.png", SurveyOfFiles::png(41, 30));
  const FrameAnswer good = *survey.answer(0), other_size = *survey.answer(1);
  EXPECT_EQ(good.status, FrameStatus::done);
  EXPECT_EQ(good.frame, 0);
  EXPECT_EQ(good.time_s, 1551478200.0);
  ASSERT_EQ(good.works.size(), 1u);
  EXPECT_EQ(good.works[0].verdict, "none");  // all of it is clipped
  ASSERT_TRUE(good.works[0].words);
  EXPECT_EQ(other_size.status, FrameStatus::done);
  EXPECT_EQ(other_size.works[0].verdict, "refused");
  EXPECT_NE(other_size.works[0].words->find("41"), std::string::npos) << *other_size.works[0].words;
}

TEST(SurveyFrame, WithAMaskOfAnotherSizeIsRefused) {
  SurveyOfFiles survey({"a.png"});
  survey.put("a.png", SurveyOfFiles::png(40, 30));
  survey.put("mask.png", SurveyOfFiles::png(20, 30));
  survey.eye().mask = survey.path("mask.png");
  EXPECT_EQ(survey.answer(0)->works[0].verdict, "refused");
}

TEST(SurveyFrame, IsOneOfAFileOfMany) {
  SurveyOfFiles survey({"minute.pgm#0", "minute.pgm#2", "minute.pgm#3", "cut.pgm#2"});
  tests::MadeFrames frames;
  frames.width_px = 40;
  frames.height_px = 30;
  frames.options = "WIDTH=40 HEIGHT=30 XBIN=1 YBIN=1";
  const std::string bytes = tests::frames_bytes(frames);
  survey.put("minute.pgm", bytes);
  survey.put("cut.pgm", bytes.substr(0, bytes.size() - 10));
  const FrameAnswer first = *survey.answer(0), last = *survey.answer(1), none = *survey.answer(2);
  EXPECT_EQ(first.status, FrameStatus::done) << first.reason.value_or("");
  EXPECT_EQ(last.status, FrameStatus::done) << last.reason.value_or("");
  EXPECT_EQ(last.file, "minute.pgm#2");
  EXPECT_EQ(last.sha256, sim::sha256(bytes));  // of the file, which is what may change
  EXPECT_EQ(none.status, FrameStatus::unreadable);
  EXPECT_NE(none.reason->find("no frame 3"), std::string::npos) << *none.reason;
  EXPECT_EQ(survey.answer(3)->status, FrameStatus::unreadable);
}

TEST(SurveyFrame, MayBePackedAndIsToBeChosenAmongMany) {
  SurveyOfFiles survey({"one.pgm.gz", "many.pgm", "packed.fits.gz"});
  tests::MadeFrames frames;
  frames.width_px = 40;
  frames.height_px = 30;
  frames.options = "WIDTH=40 HEIGHT=30 XBIN=1 YBIN=1";
  const std::string one = tests::gzip_stored(tests::frame_bytes(frames, 0)),
                    many = tests::frames_bytes(frames);
  survey.put("one.pgm.gz", one);
  survey.put("many.pgm", many);
  survey.put("packed.fits.gz",
             tests::gzip_stored(tests::fits_image(16, {40, 30}, std::vector<double>(1200, 100.0))));
  const FrameAnswer packed = *survey.answer(0), unchosen = *survey.answer(1), fits = *survey.answer(2);
  EXPECT_EQ(packed.status, FrameStatus::done) << packed.reason.value_or("");
  EXPECT_EQ(packed.sha256, sim::sha256(one));
  EXPECT_EQ(unchosen.status, FrameStatus::unreadable);
  EXPECT_NE(unchosen.reason->find("one picture"), std::string::npos) << *unchosen.reason;
  EXPECT_EQ(unchosen.sha256, sim::sha256(many));
  EXPECT_EQ(fits.status, FrameStatus::done) << fits.reason.value_or("");
}

TEST(SurveyFrame, IsGivenUpWhenStopped) {
  SurveyOfFiles survey({"a.png"});
  survey.put("a.png", SurveyOfFiles::png(40, 30));
  const std::atomic<bool> stop{true};
  EXPECT_FALSE(survey.answer(0, &stop));
}

}  // namespace
}  // namespace vegard::fit::survey_frame_test
