// The pointing and the position on the Earth that recognised stars give, without a time and with one.
//
// Without: where in the sky the picture's middle is, what is up, how wide it is. Given the site and the day,
// when that part of the sky stood there in a dark sky; given that the camera was level, when it was so as
// well. With time and site: the same camera under the observer's own sky.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/photo/mask/circle.h"
#include "fit/photo/pointing/blind/picture_stars.h"
#include "sim/view/sky/star_place.h"

namespace vegard::fit {

struct SkyPlace {
  sim::Equatorial centre;                    ///< of the middle of the picture, J2000
  double up_deg = 0.0;                       ///< the picture's upward direction there, from north to the east
  double width_deg = 0.0, height_deg = 0.0;  ///< the angles across its middle; of what has an image: no wider
                                             ///< than the lens, the fisheye's circle and the picture
  double px_per_deg = 0.0;                   ///< on the lens's axis
};

/// `circle`: the fisheye's, if the picture shows one: beyond it the lens sees nothing.
SkyPlace sky_place(const GrownCamera& camera, const Frame& frame, const std::optional<Circle>& circle = {});

/// "right ascension 75.95°, declination 78.75° (J2000); ...", a sentence a line.
std::string words_of(const SkyPlace& place, const GrownCamera& camera);

struct Interval {
  double from_jd = 0.0, to_jd = 0.0;
};

/// When within the day that follows `noon_jd` the middle of the picture is above the horizon with the Sun 6
/// degrees below it; if `level`, and the camera rolled by less than 2 degrees as well. To the minute.
std::vector<Interval> times_of_night(const GrownCamera& camera, const Frame& frame,
                                     const sim::Observer& observer, double noon_jd, bool level);

/// "2014-02-21T17:10:00Z to 2014-02-21T23:40:00Z, …", or that there is none.
std::string words_of(const std::vector<Interval>& intervals);

/// The recognised stars as the observer sees them, and the camera turned to that sky.
struct LocalSky {
  std::vector<StarSighting> stars;
  SkyCamera camera;
  int below_horizon = 0;  ///< how many of them stand more than a degree below it
};
LocalSky local_sky(const StarRecognition& recognition, const sim::Observer& observer, double julian_date);

/// A planet within `reach_deg` of a point that is as bright as a recognised star and no star itself.
struct SeenPlanet {
  std::string name;
  double x_px = 0.0, y_px = 0.0;
  double off_deg = 0.0;
  bool has_point = false;  ///< else the place is the computed one
};
/// Those in the picture at that time.
std::vector<SeenPlanet> planets_in(const PictureStars& stars, const Frame& frame, double julian_date,
                                   double reach_deg = 0.3);

/// star,ra_deg,dec_deg,magnitude,x_px,y_px: a table as `vegard calibrate` takes it with --time and --site.
std::string stars_csv(const StarRecognition& recognition);

}  // namespace vegard::fit
