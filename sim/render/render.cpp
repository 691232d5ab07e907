#include "sim/render/render.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>

#include "sim/base/number/constants.h"
#include "sim/emit/aurora/motion.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/render/film.h"
#include "sim/render/physical_blur.h"
#include "sim/render/picture.h"
#include "sim/render/render_memory.h"
#include "sim/render/volume_layer.h"
#include "sim/scene/freedom/keyframes.h"
#include "sim/scene/lines/emission_lines.h"
#include "sim/scene/structs/sensor.h"
#include "sim/scene/table/parameter_table.h"
#include "sim/view/camera/camera.h"
#include "sim/view/camera/cube_map.h"
#include "sim/view/colour/colour.h"
#include "sim/view/colour/line_colours.h"
#include "sim/view/sensor/sensor.h"
#include "sim/view/sky/night_sky.h"
#include "sim/view/sky/stars.h"

namespace vegard::sim {
namespace {

/// Returns a picture without light, of rayleighs per line.
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

/// Adds everything else in the picture around the aurora's light. `night_sky` is the layer of that name, or
/// what a display shows of it.
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

/// Puts the picture of a cube's face where the whole one has it.
void put_face(const Image& part, const CubeFace& face, Image& whole) {
  const int size = part.width, x = face.column * size, y = face.row * size;
  const std::size_t channels = static_cast<std::size_t>(part.channels()), run = size * channels;
  for (int row = 0; row < size; ++row)
    std::copy_n(part.data.begin() + static_cast<std::ptrdiff_t>(row * run), run,
                whole.data.begin() + static_cast<std::ptrdiff_t>(
                                         (static_cast<std::size_t>(y + row) * whole.width + x) * channels));
}
void put_face(const VolumePictures& parts, const CubeFace& face, const Scene& scene, VolumePictures& whole) {
  const auto put = [&](const Image& part, Image& all) {
    if (part.empty()) return;
    if (all.empty()) all = dark_lines(scene);
    put_face(part, face, all);
  };
  put(parts.rayleigh, whole.rayleigh);
  put(parts.hidden, whole.hidden);
}

/// Returns the scene before one of the pinholes that its picture is put together from.
Scene seen_by_face(const Scene& scene, const CubeFace& face) {
  Scene one = scene;
  one.camera = camera_of_face(scene.camera, face);
  return one;
}

/// Returns the film of the whole picture.
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

/// Returns the stars of a picture: those at a face's edge shine into the next one.
Image stars_of(const Scene& scene, const std::atomic<bool>* stop, int threads) {
  const std::vector<double> instants = instants_s(scene.time);
  if (scene.camera.model != LensModel::cube) return star_light(scene, instants, stop, threads);
  Image all(scene.camera.width, scene.camera.height, {"R", "G", "B"});
  for (const CubeFace& face : cube_faces(scene.camera.cube_layout))
    put_face(star_light(seen_by_face(scene, face), instants, stop, threads), face, all);
  return all;
}

/// Adds the volumes' light, of which none is of the air's excited atoms.
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

/// The light of a scene's lines as its camera takes it: on one film, or for a cube on six, one after the
/// other.
class LineCamera {
 public:
  LineCamera(const Scene& scene, const RenderOptions& options)
      : scene_(scene),
        options_(options),
        is_cube_(scene.camera.model == LensModel::cube),
        faces_(cube_faces(scene.camera.cube_layout)),
        first_face_(is_cube_ ? seen_by_face(scene, faces_.front()) : Scene()),
        film_(film_of(first())) {
    if (scene.blur.model == BlurModel::physical && is_spread_by_beams(first())) return;
    if (options.memory != nullptr) {
      exposer_ = &options.memory->exposer(film_);
      return;
    }
    BeamSampling sampling;
    sampling.path_draw = options.path_draw;
    own_exposer_ = make_exposer(first(), film_, options.threads, 0.0, sampling);
    exposer_ = own_exposer_.get();
  }

  /// The lines in rayleighs and what the sensor makes of them; no picture if the work was stopped.
  struct TakenLines {
    Image rayleigh, rgb;
    std::uint64_t deflection_points = 0;
  };
  /// Takes the light of everything, or of one sheet alone (-1: of all).
  TakenLines take(int only_sheet, const std::function<void(double)>& progress) {
    return is_cube_ ? take_cube(only_sheet, progress) : take_film(scene_, only_sheet, progress, volumes_);
  }

  /// What was taken of volumes, if there are any.
  VolumePictures& volumes() { return volumes_; }

 private:
  /// A cube is six pictures, all on a film of one size.
  const Scene& first() const { return is_cube_ ? first_face_ : scene_; }
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  TakenLines take_cube(int only_sheet, const std::function<void(double)>& progress) {
    TakenLines all;
    all.rayleigh = dark_lines(scene_);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      VolumePictures face_volumes;
      std::function<void(double)> part;
      if (progress)
        part = [&](double share) {
          progress((static_cast<double>(f) + share) / static_cast<double>(faces_.size()));
        };
      const TakenLines face =
          take_film(f == 0 ? first() : seen_by_face(scene_, faces_[f]), only_sheet, part, face_volumes);
      if (stopped()) return {};
      put_face(face.rayleigh, faces_[f], all.rayleigh);
      put_face(face_volumes, faces_[f], scene_, volumes_);
      // Every face is shone at by the same points.
      all.deflection_points = std::max(all.deflection_points, face.deflection_points);
    }
    all.rgb = through_the_sensor(scene_, all.rayleigh);
    return all;
  }

  /// Takes what one film sees; its volumes, if any, are put into `volumes`.
  TakenLines take_film(const Scene& view, int only_sheet, const std::function<void(double)>& progress,
                       VolumePictures& volumes) {
    return exposer_ == nullptr ? take_spread_by_beams(view, only_sheet, progress, volumes)
                               : take_exposed(view, only_sheet, progress, volumes);
  }
  TakenLines take_spread_by_beams(const Scene& view, int only_sheet,
                                  const std::function<void(double)>& progress,
                                  VolumePictures& volumes) const {
    TakenLines taken;
    taken.rayleigh = dark_lines(view);
    taken.deflection_points =
        add_lines_physically(view, options_.threads, progress, options_.stop, taken.rayleigh, only_sheet);
    dim_picture_by_air(view, taken.rayleigh, options_.threads);
    if (only_sheet < 0 && has_volumes(view) && !stopped())
      volumes = add_volumes_unblurred(view, film_, options_, taken.rayleigh);
    taken.rgb = through_the_sensor(view, taken.rayleigh);
    return taken;
  }
  TakenLines take_exposed(const Scene& view, int only_sheet, const std::function<void(double)>& progress,
                          VolumePictures& volumes) {
    exposer_->expose(view, exposure_, progress, options_.stop, only_sheet);
    TakenLines taken;
    taken.deflection_points = exposure_.deflection_points;
    if (stopped()) return taken;
    form_lines(view, exposure_, pixels_on(film_, view.camera), options_.threads, taken.rayleigh);
    if (exposure_.volumes.lines > 0)
      volumes = volume_pictures(view, film_, exposure_.volumes, true, options_.threads);
    taken.rgb = scene_.blur.order == BlurOrder::rgb
                    ? blurred_colours(view, film_, exposure_.rayleigh.data(), pixels_on(film_, view.camera),
                                      options_.threads)
                    : through_the_sensor(view, taken.rayleigh);
    return taken;
  }

  const Scene& scene_;
  const RenderOptions& options_;
  bool is_cube_;
  std::array<CubeFace, 6> faces_;
  Scene first_face_;  ///< where the picture is a cube
  FilmGeometry film_;
  std::unique_ptr<Exposer> own_exposer_;
  Exposer* exposer_ = nullptr;  ///< null: beams spread the light of metastable lines
  Exposure exposure_;
  VolumePictures volumes_;
};

/// Fills the aurora's light, that of all sheets and where layers are asked for that of each. Returns the
/// volumes' pictures.
VolumePictures fill_aurora(const Scene& scene, const RenderOptions& options, Rendering& result) {
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  const std::size_t exposures = options.sheet_layers ? 1 + scene.sheets.size() : 1;
  const auto progress_of = [&](std::size_t n) {
    if (!options.progress) return std::function<void(double)>();
    return std::function<void(double)>([&options, n, exposures](double share) {
      options.progress((static_cast<double>(n) + share) / static_cast<double>(exposures));
    });
  };
  LineCamera camera(scene, options);
  LineCamera::TakenLines all = camera.take(-1, progress_of(0));
  result.rayleigh = std::move(all.rayleigh);
  result.aurora = std::move(all.rgb);
  result.deflection_points = all.deflection_points;
  for (std::size_t s = 0; s + 1 < exposures && !stopped(); ++s) {
    LineCamera::TakenLines one = camera.take(static_cast<int>(s), progress_of(1 + s));
    result.sheets.push_back({scene.sheets[s].name, std::move(one.rayleigh), std::move(one.rgb)});
  }
  return std::move(camera.volumes());
}

/// Fills the light of the night sky and of the stars.
void add_sky_layers(const Scene& scene, const RenderOptions& options, Rendering& result) {
  if (has_night_sky(scene))
    result.night_sky =
        options.memory != nullptr ? options.memory->night_sky() : night_sky_light(scene, options.threads);
  if (has_stars(scene) && (options.memory == nullptr || scene.camera.model == LensModel::cube))
    result.stars = stars_of(scene, options.stop, options.threads);
  else if (has_stars(scene))
    result.stars = options.memory->stars(options.stop);
}

/// Fills the user's own pictures behind and before the light.
void add_given_pictures(const Scene& scene, const CompositePictures& pictures, Rendering& result) {
  if (!pictures.background.empty()) {
    result.background = Image(scene.camera.width, scene.camera.height, {"R", "G", "B"});
    add_light(pictures.background, scene.composite.background_gain, result.background);
  }
  if (!pictures.foreground.empty()) {
    result.foreground = pictures.foreground;
    scale_light(scene.composite.foreground_gain, result.foreground);
  }
}

/// Returns the light on the ground. It is that of the scene as given: it does not depend on the picture's
/// beams.
GroundIllumination ground_illumination(const Scene& as_given, const RenderOptions& options) {
  RenderOptions sky_options;
  sky_options.threads = options.threads;
  sky_options.stop = options.stop;
  const auto on_ground = [&] { return light_on_ground(as_given, sky_options); };
  return options.memory != nullptr ? options.memory->on_ground(as_given, options.stop, on_ground)
                                   : on_ground();
}

constexpr std::array kMovingLayers = {&Rendering::rayleigh,  &Rendering::aurora,     &Rendering::rgb,
                                      &Rendering::night_sky, &Rendering::background, &Rendering::stars,
                                      &Rendering::ground,    &Rendering::foreground, &Rendering::volume,
                                      &Rendering::hidden,    &Rendering::literal};

/// Adds a share of a layer; one that is empty has no light.
void add_share(const Image& layer, float share, Image& sum) {
  if (layer.empty()) return;
  if (sum.empty()) {
    sum = layer;
    std::fill(sum.data.begin(), sum.data.end(), 0.0f);
  }
  for (std::size_t i = 0; i < sum.data.size(); ++i) sum.data[i] += share * layer.data[i];
}

void add_share(const Rendering& one, float share, Rendering& sum) {
  for (const auto layer : kMovingLayers) add_share(one.*layer, share, sum.*layer);
  sum.deflection_points += one.deflection_points;
  sum.sheets.resize(one.sheets.size());
  for (std::size_t s = 0; s < one.sheets.size(); ++s) {
    sum.sheets[s].name = one.sheets[s].name;
    add_share(one.sheets[s].rayleigh, share, sum.sheets[s].rayleigh);
    add_share(one.sheets[s].aurora, share, sum.sheets[s].aurora);
  }
}

/// Renders a scene with keys: the mean of its instants, layer by layer.
Rendering render_moving(const Scene& scene, const RenderOptions& options) {
  const std::vector<double> instants = instants_s(scene.time);
  std::vector<Scene> stills;
  bool moves = false;
  for (const double instant : instants) {
    stills.push_back(scene_at(scene, instant));
    moves = moves || !same_values(stills.back(), stills.front());
  }
  if (!moves) return render(stills.front(), options);
  Rendering mean;
  for (std::size_t i = 0; i < stills.size(); ++i) {
    Scene& still = stills[i];
    still.time.start_s = instants[i];
    still.time.instants = 1;
    RenderOptions of_one = options;
    of_one.memory = nullptr;
    if (options.progress)
      of_one.progress = [&, i](double share) {
        options.progress((static_cast<double>(i) + share) / static_cast<double>(stills.size()));
      };
    const Rendering one = render(still, of_one);
    if (one.rgb.empty()) return {};  // stopped
    add_share(one, 1.0f / static_cast<float>(stills.size()), mean);
    still = Scene();
  }
  return mean;
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
  if (!as_given.keys.empty()) return render_moving(as_given, options);
  const Scene scene = is_panorama(as_given.camera.model) ? with_enough_beams_around(as_given)
                                                         : with_enough_beams(as_given, film_of(as_given));
  const auto stopped = [&] { return options.stop != nullptr && options.stop->load(); };
  if (options.memory != nullptr) options.memory->look_at(scene, options.threads);
  Rendering result;
  const VolumePictures volumes = fill_aurora(scene, options, result);
  if (stopped()) return {};
  add_volume_layers(scene, volumes, options.threads, result);
  add_sky_layers(scene, options, result);
  if (stopped()) return {};
  if (options.pictures != nullptr) add_given_pictures(scene, *options.pictures, result);
  if (scene.ground.shown) {
    const GroundIllumination light = ground_illumination(as_given, options);
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
  RenderOptions sky_options;
  sky_options.threads = options.threads;
  sky_options.stop = options.stop;
  sky_options.progress = options.progress;
  const Rendering all = render(sky, sky_options);
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

Image display_picture(const Scene& moving, const Rendering& rendering) {
  const Scene scene = still_scene(moving);
  Image light = shown_light(scene, rendering);
  darken(Vignetting(scene), light);
  return encoded(scene, light);
}

}  // namespace vegard::sim
