#include "fit/photo/taken_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "sim/base/utc_time.h"

namespace vegard::fit::taken_time_test {
namespace {

constexpr double kDay_s = 86400.0;

/// A clock's reading without its zone.
std::string clock_text(double seconds) {
  std::string text = sim::utc_text(seconds);
  text.pop_back();
  return text;
}

sim::PictureMetadata with(double clock_s, double gps_s) {
  sim::PictureMetadata m;
  m.taken_local = clock_text(clock_s);
  m.gps_time_utc = sim::utc_text(gps_s);
  return m;
}

double utc_of(const TakenTime& taken) { return sim::utc_seconds(taken.utc).value_or(NAN); }

bool has_note(const TakenTime& taken, const std::string& words) {
  for (const std::string& note : taken.notes)
    if (note.find(words) != std::string::npos) return true;
  return false;
}

const double kTrue = *sim::utc_seconds("2024-01-18T19:30:40Z");

TEST(TakenTime, ClockAndGpsThatAgreeSayNothing) {
  const TakenTime taken = taken_time(with(kTrue + 3600.0 + 1.0, kTrue));
  EXPECT_EQ(utc_of(taken), kTrue);
  EXPECT_TRUE(taken.notes.empty());
  EXPECT_GE(taken.error_s, 1.0);
  EXPECT_LT(taken.error_s, 1.2);
}

TEST(TakenTime, ADateOfTheGpsThatIsOffIsSaid) {
  // A receiver that has begun to count anew, and the local calendar's day.
  for (const double days : {-7168.0, 1.0, -1.0, 7168.0}) {
    const TakenTime taken = taken_time(with(kTrue + 3600.0, kTrue + days * kDay_s));
    EXPECT_EQ(utc_of(taken), kTrue) << days;
    ASSERT_EQ(taken.notes.size(), 1u) << days;
    EXPECT_TRUE(has_note(taken, sim::utc_text(kTrue + days * kDay_s)));
    EXPECT_TRUE(has_note(taken, "used: 2024-01-18T19:30:40Z"));
    EXPECT_EQ(has_note(taken, "1024 weeks"), std::abs(days) > 1.0);
  }
}

TEST(TakenTime, AnOldGpsGivesTheZoneAlone) {
  const TakenTime taken = taken_time(with(kTrue + 3600.0, kTrue - 420.0));
  EXPECT_EQ(utc_of(taken), kTrue);
  EXPECT_NEAR(taken.error_s, 420.0, 1.0);
  EXPECT_TRUE(has_note(taken, "7 min 0 s old"));
  // A position cannot be later than the picture: then it is the clock that is slow.
  const TakenTime slow = taken_time(with(kTrue + 3600.0 - 180.0, kTrue));
  EXPECT_EQ(utc_of(slow), kTrue);
  EXPECT_TRUE(has_note(slow, "slow"));
}

TEST(TakenTime, AZoneByTheCamera) {
  sim::PictureMetadata m = with(kTrue + 3600.0, kTrue - 4000.0);
  m.utc_offset = "+01:00";
  const TakenTime old = taken_time(m);
  EXPECT_EQ(utc_of(old), kTrue);
  EXPECT_TRUE(has_note(old, "differ"));
  // Summer time that was not set: the GPS agrees in another zone to the second.
  m = with(kTrue + 3600.0, kTrue);
  m.utc_offset = "+02:00";
  const TakenTime summer = taken_time(m);
  EXPECT_EQ(utc_of(summer), kTrue);
  EXPECT_TRUE(has_note(summer, "+01:00"));
  m = with(kTrue + 3600.0, kTrue);
  m.gps_time_utc.reset();
  m.utc_offset = "-13:10";
  const TakenTime none = taken_time(m);
  EXPECT_TRUE(none.utc.empty());
  EXPECT_TRUE(has_note(none, "-13:10"));
}

TEST(TakenTime, AGpsWithoutATimeIsNone) {
  // No satellite was ever seen: neither the date nor the time of day means anything.
  const TakenTime taken = taken_time(with(kTrue + 3600.0, 300.0));
  EXPECT_TRUE(taken.utc.empty());
  EXPECT_EQ(taken.notes.size(), 1u);
  sim::PictureMetadata alone;
  alone.gps_time_utc = "1970-01-01T00:00:00Z";
  EXPECT_TRUE(taken_time(alone).utc.empty());
  EXPECT_EQ(taken_time(alone).notes.size(), 1u);
}

// Thirty clocks in random zones in use, with a GPS that is right, has another date or is minutes old. Seed
// 4501. A GPS up to 7 minutes old is told apart from every neighbouring zone, which is 15 minutes off at
// least.
TEST(TakenTime, OfRandomClocks) {
  std::mt19937 random(4501);
  // Beyond 10 h to the west and 12 h to the east, where a zone of the neighbouring day is possible, no clock
  // can tell a date that is a day off.
  const int zones[] = {-570, -540, -480, -300, -210, -180, -60, 0,  60,
                       120,  210,  330,  345,  480,  570,  660, 720};
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  int said = 0;
  for (int i = 0; i < 30; ++i) {
    const double utc_s = *sim::utc_seconds("2001-01-01T00:00:00Z") + below(25 * 365) * kDay_s + below(86400);
    const int zone = zones[below(17)];
    const int kind = i % 4;
    const double dates[] = {0.0, -1.0, 1.0, -7168.0};
    const double days = kind == 1 ? dates[1 + below(3)] : 0.0;
    const double old_s = kind == 2 ? 60.0 + below(360) : below(9);
    sim::PictureMetadata m = with(utc_s + zone * 60.0, utc_s - old_s + days * kDay_s);
    m.longitude_deg = std::remainder(zone / 60.0 * 15.0, 360.0);
    if (kind == 3) m.utc_offset = sim::zone_text(zone);
    const TakenTime taken = taken_time(m);
    const std::string what =
        sim::utc_text(utc_s) + " zone " + std::to_string(zone) + " kind " + std::to_string(kind);
    // Of what agrees, the GPS's own time is taken.
    EXPECT_NEAR(utc_of(taken), utc_s, kind == 2 || kind == 3 ? 0.0 : old_s) << what;
    EXPECT_GE(taken.error_s * 1.001, kind == 3 ? 0.0 : std::abs(utc_of(taken) - utc_s)) << what;
    EXPECT_EQ(taken.notes.size(), kind == 1 || kind == 2 ? 1u : 0u) << what;
    for (const std::string& note : taken.notes) {
      ++said;
      for (const std::string& named : {*m.taken_local, *m.gps_time_utc, taken.utc})
        EXPECT_NE(note.find(named), std::string::npos) << what << ": " << note;
    }
  }
  EXPECT_EQ(said, 15);
}

// Thirty names with random zones. Seed 4502.
TEST(TimeInName, OfRandomNames) {
  std::mt19937 random(4502);
  const auto below = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  for (int i = 0; i < 30; ++i) {
    const double utc_s = *sim::utc_seconds("2001-01-01T00:00:00Z") + below(25 * 365) * kDay_s + below(86400);
    const int zone = -720 + 15 * below(105);
    std::string local = clock_text(utc_s + zone * 60.0), offset = sim::zone_text(zone);
    if (i % 2 == 0) offset.erase(3, 1);
    for (char& c : local)
      if (c == ':') c = '-';
    if (i % 3 == 0) local[10] = '_';
    const std::string separator = i % 5 == 0 ? "_" : "";
    std::string name = (i % 4 == 0 ? "sky_" : "") + local + separator + offset + ".png";
    const auto time = sim::time_in_name(name);
    // Behind a minus two pairs of digits with a colon are an offset as well.
    ASSERT_TRUE(time) << name;
    EXPECT_EQ(time->unclear, "") << name;
    EXPECT_EQ(time->offset_minutes, zone) << name;
    EXPECT_EQ(time->utc_s(), utc_s) << name;
  }
}

TEST(ContradictedByName, TellsTimesThatNoZoneJoins) {
  sim::PictureMetadata m;
  m.header_time_utc = "2019-03-01T22:10:03Z";
  m.sources.header_time = "FITS DATE-OBS";
  for (const char* name : {"20190301_221003Z.fits", "2019-03-01T23-10-03+0100.fits", "20190301_231003.fits",
                           "20190302_034003.fits", "dark.fits"})
    EXPECT_EQ(contradicted_by_name(name, m), "") << name;
  for (const char* name : {"20190301_231003Z.fits", "20190301_231703.fits", "20190303_221003.fits"}) {
    const std::string words = contradicted_by_name(name, m);
    EXPECT_NE(words.find("FITS DATE-OBS 2019-03-01T22:10:03Z"), std::string::npos) << name << words;
  }
}

}  // namespace
}  // namespace vegard::fit::taken_time_test
