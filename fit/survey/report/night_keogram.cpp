#include "fit/survey/report/night_keogram.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/region.h"
#include "fit/report/keogram_plot.h"
#include "sim/base/error.h"
#include "sim/base/number/constants.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {
namespace {

struct ChosenFrame {
  int frame = 0, block = 0;  ///< of the plan
  double time_s = 0.0;
};

std::vector<ChosenFrame> chosen_frames(const SurveyReader& reader, const CameraNight& night, int most) {
  std::vector<ChosenFrame> all, chosen;
  for (const FrameRange& range : night.ranges)
    reader.frames(range.first, range.end, [&](const FrameAnswer& answer) {
      if (answer.status == FrameStatus::done || answer.status == FrameStatus::filtered)
        all.push_back({answer.frame, answer.block, answer.time_s});
    });
  std::stable_sort(all.begin(), all.end(),
                   [](const ChosenFrame& a, const ChosenFrame& b) { return a.time_s < b.time_s; });
  if (all.empty()) return chosen;
  // Every n-th frame is taken, so that their times are as even as the camera's: uneven ones would look like
  // gaps.
  const std::size_t every =
      (all.size() + static_cast<std::size_t>(most) - 1) / static_cast<std::size_t>(most);
  for (std::size_t i = 0; i < all.size(); i += every)
    if (chosen.empty() || all[i].time_s > chosen.back().time_s) chosen.push_back(all[i]);
  return chosen;
}

KeogramLine line_of_eye(const SurveyEye& eye, const Photo& photo) {
  constexpr double kLooksUp_deg = 60.0;
  constexpr int kStripShare = 50;
  const int width = photo.linear.width, height = photo.linear.height;
  const Region region = checked_region({}, width, height);
  const sim::Camera& camera = eye.scene.camera;
  if (camera.width == width && camera.height == height) {
    MeridianOptions meridian;
    meridian.azimuth_deg =
        camera.elevation_deg > kLooksUp_deg ? eye.scene.field.declination_deg : camera.azimuth_deg;
    try {
      return meridian_line(sim::direction_map(camera), region, meridian);
    } catch (const sim::Error&) {
      // It shows nothing of that plane.
    }
  }
  return column_line(region, std::max(1, width / kStripShare));
}

}  // namespace

NightKeogram night_keogram(const SurveyReader& reader, const CameraNight& night, const SurveyFrames& frames,
                           int most) {
  NightKeogram made;
  if (frames.plan == nullptr) {
    made.why_none = "where the frames are was not said (--plan)";
    return made;
  }
  const SurveyPlan& plan = *frames.plan;
  const std::vector<ChosenFrame> chosen = chosen_frames(reader, night, most);
  if (chosen.empty()) made.why_none = "no frame was measured";
  LatestEye eyes(frames.eye);
  PictureSeries series;
  Keogram keogram;
  keogram.time_kind = PictureTimes::Kind::utc;
  keogram.time_source = "the survey";
  int calibration = -1;
  for (const ChosenFrame& one : chosen) {
    try {
      const auto block_number = static_cast<std::size_t>(one.block);
      const int first =
          block_number < plan.blocks.size() ? plan.blocks[block_number].first_frame : one.frame + 1;
      if (one.frame < first ||
          static_cast<std::size_t>(one.frame - first) >= plan.blocks[block_number].frames.size())
        throw sim::Error(sim::ErrorKind::unreadable_input,
                         "frame " + std::to_string(one.frame) + " of the database is not in the plan");
      const PlannedBlock& block = plan.blocks[block_number];
      const PlannedFrame& planned = block.frames[static_cast<std::size_t>(one.frame - first)];
      const SurveyEye& eye = eyes.of(block.camera, block.calibration);
      Photo photo = read_photo_of(series.read(plan.place(planned.file)), eye.decoding, &eye.scene);
      if (!eye.mask.empty()) apply_mask(photo, eye.mask);
      if (keogram.columns.empty()) {
        keogram.line = line_of_eye(eye, photo);
        calibration = block.calibration;
      } else if (calibration != block.calibration) {
        continue;  // the line's pixels look elsewhere now
      }
      add_picture(photo, one.time_s, keogram);
    } catch (const sim::Error& error) {
      ++made.unreadable;
      if (made.why_none.empty()) made.why_none = error.details().problem;
    }
  }
  made.columns = static_cast<int>(keogram.columns.size());
  if (made.columns > 0) {
    made.keogram = std::move(keogram);
    made.why_none.clear();
  }
  return made;
}

std::optional<double> crossing_deg(const BorderAtTime& border, const KeogramLine& line) {
  if (!line.of_directions) return std::nullopt;
  const auto eastwards = [](double from_deg, double to_deg) {
    const double turn = std::fmod(to_deg - from_deg, 360.0);
    return turn < 0.0 ? turn + 360.0 : turn;
  };
  const double range_deg = eastwards(border.from_azimuth_deg, border.to_azimuth_deg);
  std::optional<double> crossing;
  double nearest_deg = 90.0;  // a great circle is below the horizon beyond a quarter turn from its top
  for (const bool beyond_zenith : {false, true}) {
    const double azimuth_deg = line.azimuth_deg + (beyond_zenith ? 180.0 : 0.0);
    const double off_deg = std::abs(std::remainder(azimuth_deg - border.highest_azimuth_deg, 360.0));
    if (eastwards(border.from_azimuth_deg, azimuth_deg) > range_deg || off_deg >= nearest_deg) continue;
    nearest_deg = off_deg;
    const double slope = std::tan(border.highest_deg * sim::kRadiansPerDegree);
    const double elevation_deg =
        std::max(border.lowest_deg,
                 std::atan(slope * std::cos(off_deg * sim::kRadiansPerDegree)) / sim::kRadiansPerDegree);
    crossing = beyond_zenith ? 180.0 - elevation_deg : elevation_deg;
  }
  return crossing;
}

Plot keogram_with_border(const Keogram& keogram, const NightDigest& digest, const ShownSpan& span) {
  Plot plot = keogram_plot(keogram);
  plot.title.clear();
  plot.note.clear();
  plot.panel_width_px = kNightPanel_px;
  plot.panel_height_px = 300;
  Panel& panel = plot.panels.front();
  panel.x = time_axis(span, "");
  if (!keogram.line.of_directions) return plot;
  constexpr Colour kOverLight{255, 140, 60};
  FollowedSeries crossings;
  crossings.work = SurveyWork::border;
  crossings.kind = FollowedKind::border;
  for (const BorderAtTime& border : digest.borders)
    if (const std::optional<double> angle = crossing_deg(border, keogram.line))
      crossings.points.push_back({border.time_s, *angle, border.sigma_deg, border.is_good});
  panel.series = series_of(crossings, span, "lower border, where it crosses this plane", kOverLight);
  return plot;
}

}  // namespace vegard::fit
