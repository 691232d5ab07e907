#include "fit/map/sequence/curtain_tracks.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "fit/map/sequence/drift_fit.h"

#include "sim/base/number/constants.h"

namespace vegard::fit::curtain_tracks_test {
namespace {

/// A curtain from west to east.
Curtain arc(double west_km, double east_km, double north_km, double flux_mw_m2 = 5.0) {
  Curtain curtain;
  for (double east = west_km; east <= east_km; east += 5.0) {
    CurtainPoint p;
    p.foot_km = {east, north_km};
    p.distance_km = std::hypot(east, north_km);
    p.distance_error_km = 3.0;
    p.flux_mw_m2 = {flux_mw_m2, 0.5};
    p.energy_kev = {4.0, 0.4};
    p.lower_border_km = {104.0, 2.0};
    curtain.points.push_back(p);
  }
  curtain.length_km = east_km - west_km;
  return curtain;
}

/// A frame whose light is known not to move.
MapOfFrame frame(std::size_t number) {
  const sim::GroundGrid grid(sim::SquareCells{0.0, 0.0, 2.0, 2, 2});
  return {number, MapResult(sim::Scene(), grid), drift_before(DriftNet::over(grid))};
}

std::vector<CurtainTrack> followed(const std::vector<std::vector<Curtain>>& frames) {
  CurtainTracker tracker;
  for (std::size_t i = 0; i < frames.size(); ++i) tracker.add(frame(i), frames[i], i == 0 ? 0.0 : 10.0);
  return tracker.tracks();
}

TEST(CurtainTracks, FollowsACurtainThatMoves) {
  std::vector<std::vector<Curtain>> frames;
  for (int i = 0; i < 5; ++i) frames.push_back({arc(-100.0, 100.0, 200.0 + 4.0 * i)});
  const std::vector<CurtainTrack> tracks = followed(frames);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].frames.size(), 5u);
  EXPECT_TRUE(tracks[0].seen_first);
  EXPECT_TRUE(tracks[0].seen_last);
  EXPECT_DOUBLE_EQ(tracks[0].frames[2].distance_km.value, 208.0);
  EXPECT_DOUBLE_EQ(tracks[0].frames[2].energy_kev.value, 4.0);
  EXPECT_DOUBLE_EQ(tracks[0].frames[2].energy_kev.error, 0.4);
}

TEST(CurtainTracks, TellsTwoCurtainsApart) {
  std::vector<std::vector<Curtain>> frames;
  for (int i = 0; i < 4; ++i)  // in either order
    frames.push_back(i % 2 == 0 ? std::vector<Curtain>{arc(-100, 100, 200), arc(-80, 80, 260)}
                                : std::vector<Curtain>{arc(-80, 80, 260), arc(-100, 100, 200)});
  const std::vector<CurtainTrack> tracks = followed(frames);
  ASSERT_EQ(tracks.size(), 2u);
  for (const CurtainTrack& track : tracks)
    for (const TrackedCurtain& t : track.frames)
      EXPECT_DOUBLE_EQ(t.distance_km.value, track.frames[0].distance_km.value);
}

TEST(CurtainTracks, BridgesAFrameWithoutIt) {
  const std::vector<CurtainTrack> tracks = followed(
      {{arc(-100, 100, 200)}, {arc(-100, 100, 200)}, {}, {arc(-100, 100, 203)}, {arc(-100, 100, 203)}});
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_EQ(tracks[0].frames.size(), 4u);
}

TEST(CurtainTracks, EndsOverAGap) {
  CurtainTracker tracker;
  for (std::size_t i = 0; i < 8; ++i) {
    MapOfFrame one = frame(i);
    if (i == 4) one.drift = {};  // nothing was carried over to it
    tracker.add(one, {arc(-100, 100, 200)}, 10.0);
  }
  const std::vector<CurtainTrack> tracks = tracker.tracks();
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].frames.size(), 4u);
  EXPECT_FALSE(tracks[0].seen_last);
}

TEST(CurtainTracks, DropsWhatPasses) {
  const std::vector<CurtainTrack> tracks = followed({{arc(-100, 100, 200)},
                                                     {arc(-100, 100, 200), arc(-20, 20, 320)},
                                                     {arc(-100, 100, 200)},
                                                     {arc(-100, 100, 200)}});
  ASSERT_EQ(tracks.size(), 1u);
}

TEST(CurtainTracks, SaysWhatSplitsAndMerges) {
  const Curtain whole = arc(-200, 200, 200), west = arc(-200, -10, 200), east = arc(10, 150, 200);
  const std::vector<CurtainTrack> split = followed({{whole}, {west, east}, {west, east}, {west, east}});
  ASSERT_EQ(split.size(), 2u);
  EXPECT_EQ(split[0].frames.size(), 4u);
  EXPECT_EQ(split[1].split_from, 1);
  const std::vector<CurtainTrack> merged = followed({{west, east}, {west, east}, {west, east}, {whole}});
  ASSERT_EQ(merged.size(), 2u);
  EXPECT_EQ(merged[1].merged_into, 1);
  // A piece that comes and goes is none of its own.
  const std::vector<CurtainTrack> broken = followed({{whole}, {west, east}, {whole}, {whole}});
  ASSERT_EQ(broken.size(), 1u);
}

}  // namespace
}  // namespace vegard::fit::curtain_tracks_test
