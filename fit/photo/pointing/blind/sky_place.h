// The pointing that recognised stars give.
//
// Without a time it is the place of the picture's middle in the sky, the upward direction and the width.
// Given the site and the day, it is also the time at which that part of the sky was up in a dark sky, and at
// which a level camera was level. With time and site it is the camera in the observer's own sky.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/mask/circle.h"
#include "fit/photo/pointing/blind/star_recognition.h"
#include "fit/photo/pointing/identification.h"
#include "fit/photo/pointing/sky_camera.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct SkyPlace {
  sim::Equatorial centre;                    ///< the middle of the picture, J2000
  double up_deg = 0.0;                       ///< the picture's upward direction there, from north to the east
  double width_deg = 0.0, height_deg = 0.0;  ///< the angles across its middle, no wider than the lens, the
                                             ///< fisheye's circle and the picture
  double px_per_deg = 0.0;                   ///< on the lens's axis
};

/// Returns the place. `circle`: the fisheye's circle, if the picture shows one, beyond which there is no
/// image.
SkyPlace sky_place(const GrownCamera& camera, const Frame& frame, const std::optional<Circle>& circle = {});

/// "the picture's middle: right ascension 75.950 deg, declination +78.750 deg (J2000)".
std::string middle_words(const SkyPlace& place);
/// "field of view: 92.10 x 68.20 deg; ...", with the lens.
std::string width_words(const SkyPlace& place, const GrownCamera& camera);
/// Returns "right ascension 75.95°, declination 78.75° (J2000); ...", with one sentence per line.
std::string words_of(const SkyPlace& place, const GrownCamera& camera);

struct Interval {
  double from_jd = 0.0, to_jd = 0.0;
};

/// Returns the times, to the minute, within the day after `noon_jd` at which the middle of the picture is
/// above the horizon and the Sun at least 6 degrees below it; if `level`, those at which the camera's roll is
/// below 2 degrees as well.
std::vector<Interval> times_of_night(const GrownCamera& camera, const Frame& frame,
                                     const sim::Observer& observer, double noon_jd, bool level);

/// Returns "2014-02-21T17:10:00Z to 2014-02-21T23:40:00Z, …", or that there is none.
std::string words_of(const std::vector<Interval>& intervals);

/// The recognised stars as the observer sees them, and the camera turned to that sky.
struct LocalSky {
  std::vector<StarSighting> stars;
  SkyCamera camera;
  int below_horizon = 0;  ///< number of stars more than a degree below it (sim::horizon_elevation_deg())
};
/// Returns the observer's zenith in the axes of equatorial_sky().
Eigen::Vector3d zenith_of(const sim::Observer& observer, double julian_date);

LocalSky local_sky(const StarRecognition& recognition, const sim::Observer& observer, double julian_date);

/// A planet in the picture.
struct SeenPlanet {
  std::string name;
  double x_px = 0.0, y_px = 0.0;
  double off_deg = 0.0;
  bool has_point = false;  ///< false: the place is the computed one
};
/// Returns the planets in the picture at that time. A planet has a point if one is within `reach_deg` of it
/// that is as bright as a recognised star and is no star itself.
std::vector<SeenPlanet> planets_in(const PictureStars& stars, const Frame& frame, double julian_date,
                                   double reach_deg = 0.3);

/// Returns a table with the columns star,ra_deg,dec_deg,magnitude,x_px,y_px, which `vegard calibrate` reads
/// with
/// --time and --site.
std::string stars_csv(const StarRecognition& recognition);

struct LocalStars {
  /// True if more than a tenth of the recognised stars were below the horizon: time or site do not belong to
  /// this picture, and only the counts are set.
  bool elsewhere = false;
  int recognised = 0, below_horizon = 0;
  std::vector<StarSighting> stars;  ///< for the calibration
  SkyCamera camera;                 ///< the start of the calibration
  double faintest = 0.0;            ///< magnitude to which stars were identified
  Identification again;             ///< the catalogue's stars identified among all points, in the local sky
};

/// Converts the stars of a recognised picture. Stars of the catalogue are those up to the magnitude
/// `faintest`, or as much deeper as a narrow field needs (field_sky()), and at least `min_elevation_deg`, and
/// at least 0, above the horizon.
LocalStars local_stars(const PictureStars& picture, const Frame& frame, const sim::Observer& observer,
                       double julian_date, double faintest, double min_elevation_deg);

}  // namespace vegard::fit
