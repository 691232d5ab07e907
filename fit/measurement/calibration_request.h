// What a calibration is asked to use, and what the picture's metadata add to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/photo_facts.h"
#include "fit/photo/pointing/lens_choice.h"
#include "fit/photo/pointing/star_table.h"
#include "fit/photo/sky_map_file.h"
#include "fit/photo/star_instant.h"
#include "sim/base/picture/picture_metadata.h"
#include "sim/scene/structs/scene.h"
#include "sim/view/camera/direction_map.h"

namespace vegard::fit {

/// Where every pixel looks, by files of another program.
struct KnownMaps {
  std::string file;   ///< the one that messages name
  std::string names;  ///< of all of them, without folders
  sim::DirectionMap map;
  std::optional<SkyMapPlace> place;  ///< where the camera stands, if the file says
};

/// The parts have the names of the options of `vegard calibrate`, which messages use.
struct CalibrationRequest {
  std::string stars, image, camera, mask, decoding;  ///< files and a word; empty: none
  std::string wcs, acc;                              ///< directions by Astrometry.net, by AIDA_tools
  std::vector<std::string> by_hand;                  ///< stars in `image` and their places, "Vega=812,344"
  std::optional<int> acc_line;
  std::optional<KnownMaps> maps;
  SkyMapFlip flip;          ///< of `wcs` and `acc`
  bool flip_given = false;  ///< false: stars in `image` may settle it
  std::string output;  ///< the camera that will be written; empty: none, only what the stars say is asked for
  std::string corr_out;    ///< pairs of stars that will be written, which need time and site; empty: none
  std::string time, date;  ///< time: the beginning of the exposure
  std::optional<double> exposure_s;  ///< none: as the picture says; 0: `time` is the middle itself
  std::optional<sim::Observer> site;
  std::string lens, terms;
  std::vector<std::string> free;
  std::vector<double> centre_px, offset_px;
  std::vector<int> size_px;
  std::optional<double> first_pixel;
  std::optional<double> faintest;  ///< none: 4, and deeper where the picture shows fainter stars
  double min_elevation_deg = 5.0, twist_deg = 5.0, shift_px = 12.0, scale_percent = 0.0, radius_px = 12.0,
         min_signal = 4.0;
  bool vacuum = false, centre_held = false, keeps_all = false, no_metadata = false, level = false;
  bool finds_points = false;      ///< the points of light of `image` are asked for, needed or not
  bool keeps_recognised = false;  ///< the stars that are recognised blindly are asked for

  double first_faintest() const { return faintest.value_or(4.0); }
  bool by_directions() const { return maps || !wcs.empty() || !acc.empty(); }
  /// Whether the stars of `image` are recognised without a camera to start from.
  bool blind() const { return !by_directions() && stars.empty() && camera.empty() && by_hand.empty(); }
  /// The file that directions or stars come from.
  const std::string& source() const;
};

/// Throws Error(usage) for what does not belong together, and for what is lacking.
void check_together(const CalibrationRequest& request);

/// Returns the settings by lens, terms, free and centre_held; `start` is the rough camera. Throws
/// Error(usage).
LensSettings lens_settings(const CalibrationRequest& request, const std::optional<SkyCamera>& start);

/// What the request and the picture's metadata give together.
struct PictureSays {
  SkyOfPicture sky;  ///< time and site of the request, or the site of its camera; completed. The time is that
                     ///< of the stars
  std::optional<StarInstant> instant;  ///< that time, and where it comes from
  std::optional<sim::Scene> camera;  ///< that of the request, with the picture's focal length if it has none
  std::vector<PhotoFact> taken;      ///< what was taken from the metadata, in the order of a scene file
  std::vector<std::string> notes;
};

/// Completes the request by the picture's metadata: the exposure, so that the time is that of its middle; the
/// time unless one is given (the time in the camera's
/// file is that of another picture); the place unless one or the camera's site is given, and its height only
/// together with it; the field of view if the camera is a pinhole that gives neither it nor a size of its
/// own. Nothing is taken with no_metadata. Throws Error(usage).
PictureSays with_metadata(const CalibrationRequest& request, const std::optional<sim::Scene>& camera_scene,
                          const sim::PictureMetadata& metadata);

}  // namespace vegard::fit
