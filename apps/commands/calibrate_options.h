// The options of `vegard calibrate`, and what the picture's metadata add to them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/options/command.h"
#include "apps/options/direction_maps.h"
#include "fit/photo/photo_facts.h"
#include "fit/photo/pointing/lens_choice.h"
#include "fit/photo/pointing/star_table.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// As given on the command line.
struct CalibrateOptions {
  std::string stars, image, at, output, camera, time;
  std::string residuals, json, plot, overlay, mask, decoding;
  std::string lens, terms, stars_out, date;
  std::string wcs, acc, axy_out, corr_out;
  MapOptions maps;
  std::vector<std::string> free, site;
  std::vector<double> centre_px, offset_px;
  std::vector<int> size_px;
  std::optional<int> acc_line;
  std::optional<double> first_pixel;
  double faintest = 4.0, min_elevation_deg = 5.0, twist_deg = 5.0, shift_px = 12.0, scale_percent = 0.0,
         radius_px = 12.0, min_signal = 4.0;
  bool vacuum = false, centre_held = false, overwrite = false, no_metadata = false, level = false;
};

/// `options` must outlive the parsing.
void add_calibrate_options(const Command& command, CalibrateOptions& options);

/// Returns the time and the site by --time and --site, or the site of --camera. Throws Error(usage).
fit::SkyOfPicture sky_of(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene);

/// Returns the settings by --lens, --terms, --free, --hold-centre; `start` is the camera of --camera. Throws
/// Error(usage).
fit::LensSettings lens_settings(const CalibrateOptions& options, const std::optional<fit::SkyCamera>& start);

/// What the options and the picture's metadata give together.
struct PictureSays {
  fit::SkyOfPicture sky;              ///< sky_of(), completed by the metadata
  std::optional<sim::Scene> camera;   ///< that of --camera, with the picture's focal length if it has none
  std::vector<fit::PhotoFact> taken;  ///< what was taken from the metadata, in the order of a scene file
  std::vector<std::string> notes;
};

/// Completes the options by the picture's metadata: the time unless --time is given (the time in --camera's
/// file is that of another picture); the place unless --site or the camera's site is given, and its height
/// only together with it; the field of view if --camera is a pinhole that gives neither it nor a size of its
/// own. Nothing is taken with --no-metadata. Throws Error(usage).
PictureSays with_metadata(const CalibrateOptions& options, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata);

}  // namespace vegard::apps
