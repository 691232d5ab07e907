// Whether frames are of one camera that stood still and of one exposure, as a sequence of maps takes them to
// be: asked of all of them before the first is mapped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/joint/still_camera.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::fit {

class FrameCheck {
 public:
  explicit FrameCheck(const sim::Scene& scene)
      : scene_(scene), watch_(scene.camera, scene.site.latitude_deg) {}

  /// The next frame in the order of time. `sky`: per pixel 0 where there is none; empty: everywhere. Throws
  /// sim::Error(unreadable_input) for a frame of another size or exposure than the first, and for one whose
  /// stars say that the camera was moved (fit/photo/pointing/joint/still_camera.h).
  void add(const Photo& frame, const sim::PictureMetadata& metadata, double time_s,
           const std::vector<char>& sky);

  const CameraWatch& camera() const { return watch_; }

 private:
  /// What the metadata of the first frame that has it say.
  struct Known {
    std::optional<double> value;
    std::string name, words;
  };

  void require_same_exposure(const std::string& name, const sim::PictureMetadata& metadata);

  const sim::Scene& scene_;
  CameraWatch watch_;
  Known exposure_s_, f_number_, iso_;
};

}  // namespace vegard::fit
