// Cameras from the stars in their pictures.
#include <pybind11/stl.h>

#include <filesystem>
#include <optional>

#include "fit/photo/photo.h"
#include "fit/photo/pointing/blind/sky_place.h"
#include "fit/photo/pointing/blind/star_doubts.h"
#include "fit/photo/pointing/calibration.h"
#include "fit/photo/pointing/lens_form.h"
#include "fit/photo/pointing/scene_camera.h"
#include "fit/photo/pointing/star_check.h"
#include "fit/photo/pointing/star_table.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "sim/base/error.h"
#include "sim/base/text.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/sky/star_place.h"

namespace vegard::python {
namespace {

struct Stars {
  std::shared_ptr<const fit::Calibration> calibration;
  sim::Camera camera;
  fit::CalibrationOrigin origin;
};

/// What is asked for, in C++'s words.
struct StarRequest {
  std::string file;  ///< a table's name, or what stands for it
  std::optional<std::string> text;
  std::optional<double> first_pixel;
  std::shared_ptr<const fit::Photo> photo;
  std::optional<std::pair<int, int>> size_px;
  fit::SkyOfPicture sky;
  std::string time, mask;
  fit::LensSettings lens;
  std::optional<sim::Camera> start;
  double faintest = 4.0, min_elevation_deg = 5.0, min_signal = 4.0;
  bool blind() const { return file.empty(); }
};

sim::Error bad_argument(const std::string& name, const std::string& problem) {
  return sim::Error(sim::ErrorKind::usage, problem).key(name);
}

/// A table's columns as the text of one. Numbers come back to the last bit.
std::string table_text(const py::object& columns) {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;
  for (const py::handle key : columns) {
    names.push_back(py::str(key));
    std::vector<std::string> column;
    for (const py::handle value : columns[py::reinterpret_borrow<py::object>(key)]) {
      std::string cell = py::isinstance<py::str>(value)
                             ? value.cast<std::string>()
                             : std::string(py::repr(py::float_(py::reinterpret_borrow<py::object>(value))));
      if (cell.find_first_of(",\n\r\"") != std::string::npos)
        throw py::value_error("a comma, a quote or a line break in a name of stars");
      column.push_back(std::move(cell));
    }
    if (!cells.empty() && column.size() != cells.front().size())
      throw py::value_error("the columns of stars have different lengths");
    cells.push_back(std::move(column));
  }
  std::string text = sim::joined(names, ",") + "\n";
  for (std::size_t row = 0; !cells.empty() && row < cells.front().size(); ++row) {
    for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? "," : "") + cells[c][row];
    text += "\n";
  }
  return text;
}

fit::SkyOfPicture sky_of(const std::optional<std::string>& time,
                         const std::optional<std::vector<double>>& site) {
  fit::SkyOfPicture sky;
  if (time) {
    sky.julian_date = sim::julian_date(*time);
    if (!sky.julian_date)
      throw bad_argument("time", "'" + *time + "' is no time")
          .expected("ISO 8601 such as 2014-02-21T19:30:40Z, or with a zone");
  }
  if (site) {
    if (site->size() != 2 && site->size() != 3)
      throw py::value_error("site is neither (latitude, longitude) nor (latitude, longitude, height in m)");
    sky.observer = sim::Observer{(*site)[0], (*site)[1], site->size() == 3 ? (*site)[2] : 0.0};
  }
  return sky;
}

fit::Frame frame_of(const StarRequest& request) {
  if (request.photo) {
    const sim::Image& light = request.photo->linear;
    if (request.size_px && *request.size_px != std::make_pair(light.width, light.height))
      throw bad_argument("size", "the photograph has another size").expected("no size with photo");
    return {light.width, light.height, true};
  }
  constexpr int kMaxSide = 65535;
  const auto [width, height] = *request.size_px;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide)
    throw bad_argument("size", "no such size").expected("two numbers from 1 to 65535");
  return {width, height, true};
}

/// The stars of the photograph, recognised without a guess; they are what the calibration starts from too.
std::vector<fit::StarSighting> recognised(const StarRequest& request, const fit::Frame& frame,
                                          const std::vector<char>& usable, fit::LensSettings& lens) {
  if (!request.sky.julian_date || !request.sky.observer)
    throw bad_argument(request.sky.julian_date ? "site" : "time", "stars are found by when and where")
        .expected("time and site");
  fit::StarFinderSettings finder;
  finder.min_signal = request.min_signal;
  fit::RecognitionSettings known;
  known.zenith = fit::zenith_of(*request.sky.observer, *request.sky.julian_date);
  const fit::PictureStars picture = fit::recognise_picture(request.photo->linear, finder, usable, known);
  if (!picture.recognition.found)
    throw sim::unreadable(request.photo->file_name, fit::words_of(picture.recognition))
        .expected("a picture whose stars are recognised");
  const fit::LocalStars local =
      fit::local_stars(picture, frame, *request.sky.observer, *request.sky.julian_date, request.faintest,
                       request.min_elevation_deg);
  if (local.elsewhere)
    throw sim::unreadable(
        request.photo->file_name,
        "the time or the site is not this picture's: " + std::to_string(local.below_horizon) + " of its " +
            std::to_string(local.recognised) + " recognised stars were below the horizon there then");
  if (!lens.model || *lens.model == local.camera.model) lens.start = local.camera;
  return local.stars;
}

Stars calibrated(const StarRequest& request) {
  const fit::Frame frame = frame_of(request);
  fit::LensSettings lens = request.lens;
  if (request.start) lens.start = fit::sky_camera_of(*request.start, frame);
  std::vector<char> usable;
  if (request.photo && !request.mask.empty()) usable = fit::pixels_left_by(request.mask, *request.photo);
  std::vector<fit::StarSighting> stars;
  if (request.blind())
    stars = recognised(request, frame, usable, lens);
  else if (request.text)
    stars =
        fit::parse_star_table(*request.text, request.file, request.sky, request.first_pixel.value_or(0.5));
  else
    stars = fit::read_star_table(request.file, request.sky, request.first_pixel);
  if (!request.blind()) fit::check_star_places(stars, frame, request.file);

  const std::string from = request.blind() ? request.photo->file_name : request.file;
  fit::Calibration calibration = fit::calibrate(lens, stars, frame, from);
  fit::StarEvidence evidence;
  evidence.sky = request.sky;
  evidence.photo = request.photo.get();
  evidence.usable = usable;
  evidence.is_table = !request.blind();
  evidence.faintest = request.faintest;
  evidence.min_elevation_deg = request.min_elevation_deg;
  evidence.min_signal = request.min_signal;
  fit::add_star_doubts(calibration, evidence);

  Stars answer;
  sim::Scene scene;
  scene.camera = fit::scene_camera_of(calibration);
  sim::validate(scene);
  answer.camera = scene.camera;
  answer.origin.stars = std::filesystem::path(from).filename().string();
  if (!request.blind() && request.photo) answer.origin.image = request.photo->file_name;
  answer.origin.site_known = request.sky.observer.has_value();
  if (request.sky.observer) {
    answer.origin.site.latitude_deg = request.sky.observer->latitude_deg;
    answer.origin.site.longitude_deg = request.sky.observer->longitude_deg;
    answer.origin.site.altitude_m = request.sky.observer->height_m;
  }
  if (request.sky.julian_date)
    answer.origin.site.time_utc = sim::text_of_julian_date(*request.sky.julian_date);
  answer.calibration = std::make_shared<const fit::Calibration>(std::move(calibration));
  return answer;
}

Stars calibrate(const py::object& stars, const std::optional<PhotoHandle>& photo,
                const std::optional<std::pair<int, int>>& size, const std::optional<std::string>& time,
                const std::optional<std::vector<double>>& site, const std::optional<std::string>& lens,
                bool centre_free, const std::optional<sim::Camera>& camera,
                const std::optional<double>& first_pixel, const std::optional<std::string>& mask,
                double faintest) {
  StarRequest request;
  if (stars.is_none() && !photo)
    throw bad_argument("stars", "no stars").expected("a table of stars, or a photograph");
  if (!photo && !size) throw bad_argument("size", "the picture's size is missing").expected("size or photo");
  if (py::isinstance<py::str>(stars) || py::hasattr(stars, "__fspath__")) {
    request.file = py::module_::import("os").attr("fspath")(stars).cast<std::string>();
  } else if (!stars.is_none()) {
    request.file = "stars";
    request.text = table_text(stars);
  }
  request.first_pixel = first_pixel;
  if (photo) request.photo = photo->photo;
  request.size_px = size;
  request.sky = sky_of(time, site);
  request.mask = mask.value_or("");
  request.lens.centre_free = centre_free;
  if (lens) {
    request.lens.model = fit::lens_model(*lens);
    if (!request.lens.model)
      throw bad_argument("lens", "no lens '" + *lens + "'")
          .expected("pinhole, equidistant, equisolid, stereographic, orthographic or polynomial");
  }
  request.start = camera;
  request.faintest = faintest;
  const py::gil_scoped_release others_may_run;
  return calibrated(request);
}

py::dict numbers_of(const Stars& self) {
  py::dict numbers;
  for (const fit::CameraEstimate& one : self.calibration->estimates)
    numbers[py::str(one.key())] =
        py::make_tuple(one.value, one.free ? py::object(py::float_(one.sigma)) : py::object(py::none()));
  return numbers;
}

py::array_t<double> residuals_of(const Stars& self) {
  std::vector<double> all;
  for (const fit::StarResidual& one : self.calibration->residuals) {
    all.push_back(one.dx_px);
    all.push_back(one.dy_px);
  }
  const auto count = static_cast<py::ssize_t>(self.calibration->residuals.size());
  return array_of(std::move(all), {count, 2});
}

py::array_t<bool> used_of(const Stars& self) {
  py::array_t<bool> used(static_cast<py::ssize_t>(self.calibration->residuals.size()));
  auto out = used.mutable_unchecked<1>();
  for (py::ssize_t i = 0; i < used.size(); ++i)
    out(i) = self.calibration->residuals[static_cast<std::size_t>(i)].used;
  return used;
}

py::dict find_stars(const PhotoHandle& photo, double min_signal, int most) {
  require_within("min_signal", min_signal, 1.0, 1e6);
  require_within("most", most, 1.0, 1e6);
  std::vector<fit::FoundStar> found;
  {
    const py::gil_scoped_release others_may_run;
    found = fit::find_stars(photo.photo->linear, {min_signal, most});
  }
  const std::pair<const char*, double fit::FoundStar::*> columns[] = {{"x_px", &fit::FoundStar::x_px},
                                                                      {"y_px", &fit::FoundStar::y_px},
                                                                      {"sigma_px", &fit::FoundStar::sigma_px},
                                                                      {"flux", &fit::FoundStar::flux},
                                                                      {"signal", &fit::FoundStar::signal}};
  py::dict table;
  for (const auto& [name, column] : columns) {
    std::vector<double> values;
    for (const fit::FoundStar& star : found) values.push_back(star.*column);
    const auto count = static_cast<py::ssize_t>(values.size());
    table[name] = array_of(std::move(values), {count});
  }
  return table;
}

}  // namespace

void bind_stars(py::module_& m) {
  py::class_<Stars>(m, "Calibration", "A camera from stars.")
      .def_readonly("camera", &Stars::camera,
                    "What was found (Camera); scene.camera = calibration.camera uses it.")
      .def_property_readonly(
          "numbers", &numbers_of,
          "(value, sigma) of the camera's numbers by their keys, 'azimuth_deg' for example, in the\n"
          "scene's units; sigma is None where a number was held (dict).")
      .def_property_readonly(
          "rms_px", [](const Stars& s) { return s.calibration->rms_px; },
          "Of the distances of the stars in use, in pixels (float).")
      .def_property_readonly(
          "without_rms_px", [](const Stars& s) { return s.calibration->without_rms_px; },
          "The same of each star by a fit without it (float).")
      .def_property_readonly(
          "lens", [](const Stars& s) { return fit::words_of(s.calibration->form); },
          "The lens that was chosen, in words (str).")
      .def_property_readonly(
          "names",
          [](const Stars& s) {
            std::vector<std::string> names;
            for (const fit::StarSighting& star : s.calibration->stars) names.push_back(star.name);
            return names;
          },
          "Of the stars; some may be empty (list of str).")
      .def_property_readonly("residuals_px", &residuals_of,
                             "(stars, 2), float64: x and y of observed minus computed places, in pixels.")
      .def_property_readonly("used", &used_of, "(stars,), bool: which stars were not left out as mistaken.")
      .def_property_readonly(
          "warnings", [](const Stars& s) { return s.calibration->warnings; },
          "Doubts about it (list of str).")
      .def(
          "to_toml", [](const Stars& s) { return fit::camera_toml(*s.calibration, s.origin); },
          "The file that `vegard calibrate` writes, with [camera] and, where it is known, [site] (str).")
      .def("__repr__", [](const Stars& s) {
        return "<vegard.Calibration: " + fit::words_of(s.calibration->form) + ", " +
               std::to_string(s.calibration->used()) + " of " + std::to_string(s.calibration->stars.size()) +
               " stars>";
      });
  m.def(
      "calibrate", &calibrate, py::arg("stars") = py::none(), py::kw_only(), py::arg("photo") = py::none(),
      py::arg("size") = py::none(), py::arg("time") = py::none(), py::arg("site") = py::none(),
      py::arg("lens") = py::none(), py::arg("centre_free") = true, py::arg("camera") = py::none(),
      py::arg("first_pixel") = py::none(), py::arg("mask") = py::none(), py::arg("faintest") = 4.0,
      "Finds a camera's pointing, lens and distortion from stars (Calibration): what `vegard calibrate` "
      "does.\n\n"
      "stars: a table's file; or its columns, a dict of arrays or a DataFrame: x_px, y_px and azimuth_deg,\n"
      "  elevation_deg (as seen, in degrees), or ra_deg, dec_deg (J2000), or star (names); None: those of "
      "the photo,\n"
      "  recognised without a guess\n"
      "photo: the picture, a Photo\n"
      "size: (width, height) of the picture in pixels, if there is no photo\n"
      "time: ISO 8601 in UTC or with a zone; for ra_deg, star and the photo's own stars\n"
      "site: (latitude, longitude) or (latitude, longitude, height) in degrees, north and east, and m\n"
      "lens: only this model's, 'equidistant' for example; None: the stars choose\n"
      "centre_free: whether the lens's centre may be elsewhere than in the picture's middle\n"
      "camera: a Camera to start from\n"
      "first_pixel: where the table has the centre of the first pixel; None: 0.5\n"
      "mask: an image of the photo's size, white where stars are looked for\n"
      "faintest: magnitude of the faintest catalogue star that is looked for, at most 4.5");
  m.def("find_stars", &find_stars, py::arg("photo"), py::arg("min_signal") = 4.0, py::arg("most") = 400,
        "Points of light in a photograph, the brightest first: a dict of x_px, y_px, sigma_px (of one "
        "coordinate), flux\n"
        "and signal (height in standard deviations of the noise around), each (points,) float64.");
}

}  // namespace vegard::python
