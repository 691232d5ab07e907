#include "sim/render/render.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/render/film.h"
#include "sim/render/physical_blur.h"
#include "sim/render/picture.h"
#include "sim/render/render_memory.h"
#include "sim/render/volume_layer.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/sensor.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/cube_map.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

/// A picture without light, of rayleighs per line.
Image dark_lines(const Scene& scene) {
  std::vector<std::string> names;
  for (double nm : scene.emission.lines) names.push_back(line_name(nm));
  return Image(scene.camera.width, scene.camera.height, names);
}

Image through_the_sensor(const Scene& scene, const Image& rayleigh) {
  return rgb_from_rayleigh(rayleigh, line_colours(scene));
}

void add_behind(const Scene& scene, const Rendering& layers, const Image& night_sky, Image& rgb) {
  add_sky(scene.sky, rgb);
  if (!night_sky.empty()) add_light(night_sky, 1.0, rgb);
  if (!layers.background.empty()) add_light(layers.background, 1.0, rgb);
  if (!layers.stars.empty()) add_light(layers.stars, 1.0, rgb);
}

/// Everything else in the picture around the aurora's light. `night_sky` is the layer of that name, or what a
/// display shows of it.
void compose_layers(const Scene& scene, const Rendering& layers, const Image& night_sky, Image& rgb) {
  if (layers.volume.empty()) {
    add_behind(scene, layers, night_sky, rgb);
  } else {
    Image behind(rgb.width, rgb.height, {"R", "G", "B"});
    add_behind(scene, layers, night_sky, behind);
    if (!layers.literal.empty()) cover(layers.literal, behind);
    if (!layers.hidden.empty()) hide(layers.hidden, behind);
    add_light(behind, 1.0, rgb);
  }
  if (!layers.ground.empty()) cover(layers.ground, rgb);
  if (!layers.foreground.empty()) cover(layers.foreground, rgb);
}

/// A picture of a cube's face, where the whole one has it.
void put_face(const Image& of_face, const CubeFace& face, Image& whole) {
  const int size = of_face.width, x = face.column * size, y = face.row * size;
  const std::size_t channels = static_cast<std::size_t>(of_face.channels()), run = size * channels;
  for (int row = 0; row < size; ++row)
    std::copy_n(of_face.data.begin() + static_cast<std::ptrdiff_t>(row * run), run,
                whole.data.begin() + static_cast<std::ptrdiff_t>(
                                         (static_cast<std::size_t>(y + row) * whole.width + x) * channels));
}
void put_face(const VolumePictures& of_face, const CubeFace& face, const Scene& scene,
              VolumePictures& whole) {
  const auto put = [&](const Image& part, Image& all) {
    if (part.empty()) return;
    if (all.empty()) all = dark_lines(scene);
    put_face(part, face, all);
  };
  put(of_face.rayleigh, whole.rayleigh);
  put(of_face.hidden, whole.hidden);
}

/// The scene before one of the pinholes that its picture is put together from.
Scene seen_by_face(const Scene& scene, const CubeFace& face) {
  Scene one = scene;
  one.camera = camera_of_face(scene.camera, face);
  return one;
}

/// The whole picture's.
FilmGeometry film_of(const Scene& scene) {
  return film_for(scene, 0, 0, scene.camera.width, scene.camera.height, 1.0, 1.0);
}

/// Does with_enough_beams() for a panorama, by a fisheye of as many pixels per degree, which has no seams.
Scene with_enough_beams_around(const Scene& scene) {
  constexpr double kHighSite_m = 100e3;
  Scene fisheye = scene;
  fisheye.camera = Camera();
  fisheye.camera.model = LensModel::equidistant;
  fisheye.camera.focal_px = pixels_per_degree(scene.camera) / kRadiansPerDegree;
  fisheye.camera.width = fisheye.camera.height = static_cast<int>(std::ceil(kPi * fisheye.camera.focal_px));
  fisheye.camera.elevation_deg = scene.site.altitude_m > kHighSite_m ? -90.0 : 90.0;
  Scene enough = scene;
  enough.sheets = with_enough_beams(fisheye, film_of(fisheye)).sheets;
  return enough;
}

/// The stars of a picture: those at a face's edge shine into the next one.
Image stars_of(const Scene& scene, const std::atomic<bool>* stop, int threads) {
  const std::vector<double> instants = instants_s(scene.time);
  if (scene.camera.model != LensModel::cube) return star_light(scene, instants, stop, threads);
  Image all(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  for (const CubeFace& face : cube_faces(scene.camera.cube_layout))
    put_face(star_light(seen_by_face(scene, face), instants, stop, threads), face, all);
  return all;
}

/// The volumes' light, of which none is of the air's excited atoms.
VolumePictures add_volumes_unblurred(const Scene& scene, const FilmGeometry& film,
                                     const RenderOptions& options, Image& rayleigh) {
  Exposure exposure;
  exposure.geometry = film;
  exposure.volumes = Volumes(scene, options.threads).light(scene, film, {}, options.stop);
  dim_by_air(scene, exposure, options.threads);
  VolumePictures volumes = volume_pictures(scene, film, exposure.volumes, false, options.threads);
  for (std::size_t i = 0; i < rayleigh.data.size(); ++i) rayleigh.data[i] += volumes.rayleigh.data[i];
  return volumes;
}

/// Fills what a rendering has of volumes and of literal nebulae.
void add_volume_layers(const Scene& scene, const VolumePictures& volumes, int threads, Rendering& result) {
  result.literal = literal_layer(scene, threads);
  if (!volumes.hidden.empty()) result.hidden = hidden_colours(scene, volumes.hidden);
  if (!volumes.empty())
    result.volume = volume_layer(scene, through_the_sensor(scene, volumes.rayleigh), result.hidden);
  if (result.literal.empty()) return;
  if (result.volume.empty()) {
    result.volume = result.literal;
    return;
  }
  // Colours behind the volumes' own share of each channel; coverage behind that of all.
  for (int y = 0; y < result.literal.height; ++y)
    for (int x = 0; x < result.literal.width; ++x) {
      for (int c = 0; c < 3; ++c)
        result.volume.at(x, y, c) +=
            (result.hidden.empty() ? 1.0f : 1.0f - result.hidden.at(x, y, c)) * result.literal.at(x, y, c);
      float& coverage = result.volume.at(x, y, 3);
      coverage += (1.0f - coverage) * result.literal.at(x, y, 3);
    }
}

}  // namespace

Image rayleigh_image(const Scene& scene, const Exposure& exposure, int threads) {
  assert(exposure.lines == static_cast<int>(scene.emission.lines.size()));
  Image rayleigh;
  blur_lines(scene, exposure.geometry, exposure.rayleigh.data(), pixels_on(exposure.geometry, scene.camera),
             threads, rayleigh);
  return rayleigh;
}

Rendering render(const Scene& as_given, const RenderOptions& options) {
  const int width = as_given.camera.width, height = as_given.camera.height;
  // A cube is six pictures, all on a film of one size.
  const bool is_cube = as_given.camera.model == LensModel::cube;
  const std::array<CubeFace, 6> faces = cube_faces(as_given.camera.cube_layout);
  const Scene scene = is_panorama(as_given.camera.model) ? with_enough_beams_around(as_given)
                                                         : with_enough_beams(as_given, film_of(as_given));
  const Scene first_face = is_cube ? seen_by_face(scene, faces.front()) : Scene();
  const Scene& first = is_cube ? first_face : scene;
  const FilmGeometry film = film_of(first);
  BeamSampling sampling;
  sampling.path_draw = options.path_draw;
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  const std::size_t exposures = options.sheet_layers ? 1 + scene.sheets.size() : 1;
  const auto progress_of = [&](std::size_t n) {
    if (!options.progress) return std::function<void(double)>();
    return std::function<void(double)>([&options, n, exposures](double share) {
      options.progress((static_cast<double>(n) + share) / static_cast<double>(exposures));
    });
  };

  if (options.memory != nullptr) options.memory->look_at(scene, options.threads);
  Rendering result;
  VolumePictures volumes;
  {
    std::unique_ptr<Exposer> own_exposer;
    Exposure exposure;
    Exposer* exposer = nullptr;
    const bool by_beams = scene.blur.model == BlurModel::physical && is_spread_by_beams(first);
    if (!by_beams)
      exposer = options.memory != nullptr
                    ? &options.memory->exposer(film)
                    : (own_exposer = make_exposer(first, film, options.threads, 0.0, sampling)).get();
    const bool blurs_colours = scene.blur.order == BlurOrder::rgb;
    // Returns the lines of one camera, with its linear RGB; its volumes, if any, are put into `of_volumes`.
    const auto lines_before = [&](const Scene& view, const std::function<void(double)>& progress,
                                  int only_sheet, std::uint64_t& points, VolumePictures& of_volumes,
                                  Image& aurora) {
      if (!exposer) {
        Image lines = dark_lines(view);
        points = add_lines_physically(view, options.threads, progress, options.stop, lines, only_sheet);
        dim_picture_by_air(view, lines, options.threads);
        if (only_sheet < 0 && has_volumes(view) && !stopped())
          of_volumes = add_volumes_unblurred(view, film, options, lines);
        aurora = through_the_sensor(view, lines);
        return lines;
      }
      exposer->expose(view, exposure, progress, options.stop, only_sheet);
      points = exposure.deflection_points;
      if (stopped()) return Image();
      Image lines;
      form_lines(view, exposure, pixels_on(film, view.camera), options.threads, lines);
      if (exposure.volumes.lines > 0)
        of_volumes = volume_pictures(view, film, exposure.volumes, true, options.threads);
      aurora = blurs_colours ? blurred_colours(view, film, exposure.rayleigh.data(),
                                               pixels_on(film, view.camera), options.threads)
                             : through_the_sensor(view, lines);
      return lines;
    };
    const auto lines_of = [&](std::size_t n, int only_sheet, std::uint64_t& points, Image& aurora) {
      const std::function<void(double)> progress = progress_of(n);
      if (!is_cube) return lines_before(scene, progress, only_sheet, points, volumes, aurora);
      Image all = dark_lines(scene);
      points = 0;
      for (std::size_t f = 0; f < faces.size(); ++f) {
        std::uint64_t points_of_face = 0;
        VolumePictures of_volumes;
        std::function<void(double)> part;
        if (progress)
          part = [&](double share) {
            progress((static_cast<double>(f) + share) / static_cast<double>(faces.size()));
          };
        const Image one = lines_before(f == 0 ? first : seen_by_face(scene, faces[f]), part, only_sheet,
                                       points_of_face, of_volumes, aurora);
        if (stopped()) return Image();
        put_face(one, faces[f], all);
        put_face(of_volumes, faces[f], scene, volumes);
        points = std::max(points, points_of_face);  // every face is shone at by the same
      }
      aurora = through_the_sensor(scene, all);
      return all;
    };
    result.rayleigh = lines_of(0, -1, result.deflection_points, result.aurora);
    if (stopped()) return {};
    for (std::size_t s = 0; s + 1 < exposures; ++s) {
      std::uint64_t points_of_sheet = 0;
      SheetLayer layer{scene.sheets[s].name, {}, {}};
      layer.rayleigh = lines_of(1 + s, static_cast<int>(s), points_of_sheet, layer.aurora);
      if (stopped()) return {};
      result.sheets.push_back(std::move(layer));
    }
  }
  add_volume_layers(scene, volumes, options.threads, result);
  if (has_night_sky(scene))
    result.night_sky =
        options.memory != nullptr ? options.memory->night_sky() : night_sky_light(scene, options.threads);
  if (has_stars(scene) && (options.memory == nullptr || is_cube))
    result.stars = stars_of(scene, options.stop, options.threads);
  else if (has_stars(scene))
    result.stars = options.memory->stars(options.stop);
  if (stopped()) return {};
  if (options.pictures != nullptr && !options.pictures->background.empty()) {
    result.background = Image(width, height, {"R", "G", "B"});
    add_light(options.pictures->background, scene.composite.background_gain, result.background);
  }
  if (options.pictures != nullptr && !options.pictures->foreground.empty()) {
    result.foreground = options.pictures->foreground;
    scale_light(scene.composite.foreground_gain, result.foreground);
  }
  if (scene.ground.shown) {
    RenderOptions of_sky;
    of_sky.threads = options.threads;
    of_sky.stop = options.stop;
    // The light on the ground is that of the scene as given: it does not depend on this picture's beams.
    const auto on_ground = [&] { return light_on_ground(as_given, of_sky); };
    const GroundIllumination light = options.memory != nullptr
                                         ? options.memory->on_ground(as_given, options.stop, on_ground)
                                         : on_ground();
    if (stopped()) return {};
    result.ground = ground_layer(scene, light, options.threads);
  }
  if (stopped()) return {};
  result.rgb = result.aurora;
  compose_layers(scene, result, result.night_sky, result.rgb);
  return result;
}

GroundIllumination light_on_ground(const Scene& scene, const RenderOptions& options) {
  const Scene sky = sky_over_ground(scene);
  RenderOptions of_sky;
  of_sky.threads = options.threads;
  of_sky.stop = options.stop;
  of_sky.progress = options.progress;
  const Rendering all = render(sky, of_sky);
  if (all.rgb.empty()) return {};  // stopped
  return light_of_sky(sky, all.rayleigh, all.rgb, all.night_sky, all.stars);
}

Image sky_light(const Scene& scene) {
  Image sky(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  add_sky(scene.sky, sky);
  return sky;
}

Image shown_light(const Scene& scene, const Rendering& rendering) {
  Image light = rendering.aurora, night_sky = rendering.night_sky;
  clip_out_of_gamut(light);
  clip_out_of_gamut(night_sky);
  compose_layers(scene, rendering, night_sky, light);
  return light;
}

Image light_on_sensor(const Scene& scene, const Rendering& rendering) {
  return response_kind(scene.sensor.response) == ResponseKind::cie ? shown_light(scene, rendering)
                                                                   : rendering.rgb;
}

Image display_picture(const Scene& scene, const Rendering& rendering) {
  Image light = shown_light(scene, rendering);
  darken(Vignetting(scene), light);
  return encoded(scene, light);
}

}  // namespace vegard::sim
