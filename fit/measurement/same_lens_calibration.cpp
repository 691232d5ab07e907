#include "fit/measurement/same_lens_calibration.h"

#include <filesystem>

#include <fmt/format.h>

#include "fit/measurement/calibration_words.h"
#include "fit/photo/pointing/calibration_doubts.h"
#include "fit/photo/pointing/joint/same_lens.h"
#include "sim/base/error.h"

namespace vegard::fit {

std::vector<CameraCalibration> calibrate_same_lens(const std::vector<CalibrationRequest>& requests,
                                                   const Tell& tell) {
  std::vector<CameraCalibration> all;
  std::vector<LensPicture> pictures;
  std::vector<std::size_t> members;
  for (const CalibrationRequest& request : requests) {
    const std::string name = std::filesystem::path(request.source()).filename().string();
    tell(name + ":");
    all.push_back(calibrate_camera(request, tell));
    CameraCalibration& one = all.back();
    one.photo.reset();  // a night of pictures is larger than the memory
    if (!one.calibration) {
      one.has_answer = false;
      tell(name + " is left out");
      continue;
    }
    const Frame& first = all[members.empty() ? all.size() - 1 : members.front()].frame;
    if (one.frame.width_px != first.width_px || one.frame.height_px != first.height_px)
      throw sim::unreadable(request.source(),
                            fmt::format("{} x {} px", one.frame.width_px, one.frame.height_px))
          .expected(fmt::format("{} x {} px, the size of the first", first.width_px, first.height_px));
    members.push_back(all.size() - 1);
    StarSet used;
    for (const StarResidual& star : one.calibration->residuals) used.push_back(star.used);
    pictures.push_back({request.source(), one.calibration->camera, one.calibration->stars, used});
    tell(rms_line(*one.calibration));
  }
  if (pictures.size() < 2)
    throw sim::unreadable(requests.front().source(), "fewer than two pictures are recognised")
        .expected("at least two pictures for one lens");
  LensSettings settings = lens_settings(requests.front(), std::nullopt);
  std::vector<Calibration> together =
      fit::calibrate_same_lens(settings, pictures, all[members.front()].frame, "--same-lens");
  for (std::size_t i = 0; i < members.size(); ++i) {
    CameraCalibration& one = all[members[i]];
    together[i].explained = one.calibration->explained;
    if (const std::string words = time_and_site_doubt(together[i]); !words.empty())
      together[i].warnings.push_back(words);
    one.calibration = std::move(together[i]);
    one.origin.same_lens = static_cast<int>(members.size());
  }
  return all;
}

}  // namespace vegard::fit
