#include "sim/render_film.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>

#include "sim/base/parallel.h"
#include "sim/emit/aurora/beam.h"
#include "sim/emit/aurora/sheet.h"
#include "sim/light/emission_line.h"
#include "sim/render_kernel.h"
#include "sim/view/tangent_film.h"

namespace vegard::sim {
namespace {

constexpr int kBeamsPerChunk = 256;
constexpr int kShards = 8;            // of the derivatives; fixed, so that sums do not depend on the threads
constexpr double kFarthestKm = 4000;  // a foot farther than this is far below the horizon

/// A stretch of one sheet, all its layers.
struct Chunk {
  int sheet, first, count;
};

/// Turns numbers of a scene into dual numbers: the tangent is 1 for the parameter that lives at that address.
class Seeds {
 public:
  Seeds(const std::vector<const double*>& free, std::size_t first, std::size_t count)
      : free_(free), first_(first), count_(count) {}
  int parameter_at(const double* address) const {
    for (std::size_t i = 0; i < count_; ++i)
      if (free_[first_ + i] == address) return static_cast<int>(i);
    return -1;
  }
  FreeDual operator()(const double& number, double scale = 1.0) const {
    FreeDual dual(number * scale);
    const int i = parameter_at(&number);
    if (i >= 0) dual.d.t[i] = scale;
    return dual;
  }

 private:
  const std::vector<const double*>& free_;
  std::size_t first_, count_;
};

struct NoSeeds {
  double operator()(const double& number, double scale = 1.0) const { return number * scale; }
};

template <class T, class Seeding>
SheetShape<T> shape_of(const Sheet& s, double inclination_deg, const Seeding& seed) {
  SheetShape<T> shape;
  shape.center_east_km = seed(s.center_km.east);
  shape.center_north_km = seed(s.center_km.north);
  shape.bearing_rad = seed(s.bearing_deg, kRadiansPerDegree);
  shape.length_km = seed(s.length_km);
  shape.thickness_km = seed(s.thickness_km);
  shape.wavelength_km = seed(s.wavelength_km);
  shape.phase_rad = seed(s.phase_rad);
  shape.phase_shift_rad = seed(s.phase_shift_rad);
  shape.width_km = seed(s.width_km);
  shape.energy_flux_mw_m2 = seed(s.energy_flux_mw_m2);
  shape.side = inclination_deg < 0.0 ? -1.0 : 1.0;
  return shape;
}

/// A scene number (in degrees) as a local input, in radians.
LocalDual local(double degrees, LocalInput input, double scale = kRadiansPerDegree) {
  LocalDual dual(degrees * scale);
  dual.d.t[input] = scale;
  return dual;
}

PitchLaw pitch_law(const std::string& name) {
  if (name == "product") return PitchLaw::product;
  if (name == "increment") return PitchLaw::increment;
  if (name == "constant") return PitchLaw::constant;
  return PitchLaw::reduced;
}

/// What all beams of a sheet share. Kernel scenes differ between sheets in their deflections only.
KernelScene kernel_scene(const Scene& scene, const Sheet& sheet, const FilmGeometry& film,
                         const std::vector<HeightProfile>& profiles) {
  KernelScene k;
  k.fall = fall_frame(local(scene.field.inclination_deg, inclination),
                      local(scene.field.declination_deg, declination));
  k.deflection.law = pitch_law(sheet.pitch_law);
  k.deflection.loss_cone_rad = local(sheet.loss_cone_deg, loss_cone);
  k.deflection.pitch_step_rad = local(sheet.pitch_step_rad, pitch_step, 1.0);
  k.deflection.path_step = sheet.path_step;
  const Camera& c = scene.camera;
  k.view = pinhole_view(local(c.azimuth_deg, camera_azimuth), local(c.elevation_deg, camera_elevation),
                        local(c.roll_deg, camera_roll), local(c.hfov_deg, camera_hfov), c.width);
  k.film = film;
  k.center_x_px = 0.5 * c.width;
  k.center_y_px = 0.5 * c.height;
  k.observer_altitude_km = scene.site.altitude_m * 1e-3;
  k.nearest_cell = scene.film.splat == "nearest";
  k.unit_weight = scene.film.weight == "unit";
  k.seed = scene.seed;
  k.profiles = profiles.data();
  return k;
}

/// True if nothing that falls from this beam can reach the film: both ends, and whatever strays from the line
/// between them by the pitch angles, project outside the same edge.
bool out_of_sight(const Beam<double>& beam, const KernelScene& k) {
  const double stray =
      beam.length_km * (std::abs(k.deflection.loss_cone_rad.v) + std::abs(k.deflection.pitch_step_rad.v));
  double x[2], y[2], nearest = 1e30;
  for (int end = 0; end < 2; ++end) {
    double in_camera[3];
    for (int i = 0; i < 3; ++i) {
      in_camera[i] = 0.0;
      for (int j = 0; j < 3; ++j)
        in_camera[i] += k.view.camera_from_enu[i][j].v *
                        (beam.start_in_enu_km[j] + end * beam.length_km * k.fall.along[j].v);
    }
    nearest = std::min(nearest, in_camera[2]);
    if (in_camera[2] > 0.0) {
      x[end] = in_camera[0] / in_camera[2];
      y[end] = in_camera[1] / in_camera[2];
    }
  }
  if (nearest <= 2.0 * stray + 1.0) return false;
  const double focal = k.view.focal_px.v;
  const double farthest = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(y[0]), std::abs(y[1])});
  const double margin = stray / (nearest - stray) * (1.0 + farthest) * focal + 2.0;
  const FilmGeometry& f = k.film;
  const double left = f.x0_px - k.center_x_px - margin;
  const double right = f.x0_px + f.columns * f.cell_width_px - k.center_x_px + margin;
  const double top = f.y0_px - k.center_y_px - margin;
  const double bottom = f.y0_px + f.rows * f.cell_height_px - k.center_y_px + margin;
  return std::max(x[0], x[1]) * focal < left || std::min(x[0], x[1]) * focal > right ||
         std::max(y[0], y[1]) * focal < top || std::min(y[0], y[1]) * focal > bottom;
}

void put(const LocalDual& from, int place, GroupNumber& to) {
  to.value[place] = from.v;
  for (int k = 0; k < local_inputs; ++k) to.tangent[k][place] = from.d.t[k];
}
void put(double from, int place, GroupNumber& to) { to.value[place] = from; }

void narrow(const Tangents<double, kTangentWidth>& from, double scale, float* to) {
  for (int i = 0; i < kTangentWidth; ++i) to[i] = static_cast<float>(from.t[i] * scale);
}

/// The beams of a chunk that can be seen, packed into groups of one layer each.
struct PackedChunk {
  std::vector<BeamGroup> groups;
  std::vector<GroupChain> chains;
};

}  // namespace

double blur_sigma_px(const Scene& scene, int line) {
  return scene.blur.width_deg[line] * scene.camera.width / scene.camera.hfov_deg;
}

int blur_radius_px(const Scene& scene, int line) {
  if (scene.blur.kernel != "paper") return -1;
  const EmissionLine* known = find_emission_line(scene.emission.lines[line]);
  const double reach = known != nullptr && known->lifetime_s > 10.0 ? 10.5 / 4.75 : 2.5 / 2.0;
  return static_cast<int>(reach * blur_sigma_px(scene, line));
}

FilmGeometry film_for(const Scene& scene, double x_px, double y_px, double width_px, double height_px,
                      double cell_width_px, double cell_height_px) {
  double widest = 0.0;
  for (std::size_t l = 0; l < scene.emission.lines.size(); ++l)
    widest = std::max(widest, blur_sigma_px(scene, static_cast<int>(l)));
  const int across = static_cast<int>(std::ceil(4.0 * widest / cell_width_px)) + 2;
  const int down = static_cast<int>(std::ceil(4.0 * widest / cell_height_px)) + 2;
  FilmGeometry film;
  film.cell_width_px = cell_width_px;
  film.cell_height_px = cell_height_px;
  film.x0_px = x_px - across * cell_width_px;
  film.y0_px = y_px - down * cell_height_px;
  film.columns = static_cast<int>(std::ceil(width_px / cell_width_px)) + 2 * across;
  film.rows = static_cast<int>(std::ceil(height_px / cell_height_px)) + 2 * down;
  return film;
}

struct Exposer::Workspace {
  FilmGeometry film;
  int threads = 1;
  std::vector<std::vector<std::vector<BeamPlace>>> places;  // [sheet][layer][beam]
  std::vector<StretchOfSheet> stretches;                    // [sheet]
  std::vector<Chunk> chunks;
  std::vector<std::vector<std::int64_t>> slot_films;
  std::vector<PackedChunk> slot_chunks;  // kept: their memory is large enough to cost something

  /// Packs a chunk. T is double, or LocalDual with a chain to the free parameters.
  template <class T>
  void pack(const Scene& scene, const Chunk& chunk, const KernelScene& k, const Seeds* seeds,
            PackedChunk& out) const {
    out.groups.clear();
    out.chains.clear();
    const Sheet& sheet = scene.sheets[chunk.sheet];
    const bool literal = sheet.spacing_rule == "literal";
    const SheetShape<double> shape = shape_of<double>(sheet, scene.field.inclination_deg, NoSeeds());
    SheetShape<FreeDual> free_shape;
    if (seeds != nullptr) free_shape = shape_of<FreeDual>(sheet, scene.field.inclination_deg, *seeds);
    FallFrame<double> fall;
    for (int i = 0; i < 3; ++i) {
      fall.along[i] = k.fall.along[i].v;
      fall.across1[i] = k.fall.across1[i].v;
      fall.across2[i] = k.fall.across2[i].v;
    }
    for (int layer = 0; layer < sheet.layers; ++layer) {
      int place_in_group = kGroup;
      for (int b = chunk.first; b < chunk.first + chunk.count; ++b) {
        const BeamPlace& place = places[chunk.sheet][layer][b];
        const BeamFoot<double> foot =
            beam_foot(shape, stretches[chunk.sheet], place, layer, sheet.layers, literal);
        if (foot.flux_km2_mw_m2 <= 0.0) continue;
        if (foot.east_km * foot.east_km + foot.north_km * foot.north_km > kFarthestKm * kFarthestKm) continue;
        const Beam<double> plain = start_beam(foot.east_km, foot.north_km, fall, k.observer_altitude_km,
                                              sheet.top_km, HeightProfile::kBottomKm);
        // A field line that does not descend would be negative light; one that grazes the Earth never comes
        // down to the bottom, and has no length.
        if (plain.vertical <= 0.0 || !(plain.length_km > 0.0)) continue;
        if (out_of_sight(plain, k)) continue;
        if (place_in_group == kGroup) {
          place_in_group = 0;
          out.groups.emplace_back();
          BeamGroup& fresh = out.groups.back();
          fresh = BeamGroup{};
          fresh.layer_address =
              static_cast<std::uint32_t>(chunk.sheet) * 256 + static_cast<std::uint32_t>(layer);
          fresh.sheet = chunk.sheet;
          if (seeds != nullptr) out.chains.emplace_back(GroupChain{});
        }
        BeamGroup& group = out.groups.back();
        if constexpr (std::is_same_v<T, LocalDual>) {
          LocalDual east(foot.east_km), north(foot.north_km);
          east.d.t[foot_east] = 1.0;
          north.d.t[foot_north] = 1.0;
          const Beam<LocalDual> beam =
              start_beam(east, north, k.fall, k.observer_altitude_km, sheet.top_km, HeightProfile::kBottomKm);
          for (int i = 0; i < 3; ++i) put(beam.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
          put(beam.length_km, place_in_group, group.length_km);
          put(beam.vertical, place_in_group, group.vertical);
          const BeamFoot<FreeDual> free_foot =
              beam_foot(free_shape, stretches[chunk.sheet], place, layer, sheet.layers, literal);
          GroupChain& chain = out.chains.back();
          narrow(free_foot.east_km.d, 1.0, chain.foot_east[place_in_group]);
          narrow(free_foot.north_km.d, 1.0, chain.foot_north[place_in_group]);
          const double flux = free_foot.flux_km2_mw_m2.v;
          narrow(free_foot.flux_km2_mw_m2.d, flux > 0.0 ? 1.0 / flux : 0.0, chain.log_flux[place_in_group]);
        } else {
          for (int i = 0; i < 3; ++i) put(plain.start_in_enu_km[i], place_in_group, group.start_in_enu_km[i]);
          put(plain.length_km, place_in_group, group.length_km);
          put(plain.vertical, place_in_group, group.vertical);
        }
        group.flux_km2_mw_m2[place_in_group] = foot.flux_km2_mw_m2;
        group.end_of_path[place_in_group] = 1.0 - place.depth * sheet.path_spread;
        group.index[place_in_group] = static_cast<std::uint32_t>(b);
        ++place_in_group;
      }
    }
  }

  std::vector<HeightProfile> profiles(const Scene& scene) const {
    std::vector<HeightProfile> all;
    for (const Sheet& sheet : scene.sheets)
      all.push_back(maxwellian_profile(scene.emission.lines, sheet.energy_kev));
    return all;
  }

  void clear_slots(int stride) {
    const std::size_t size = static_cast<std::size_t>(film.rows) * film.columns * stride;
    slot_films.resize(threads);
    slot_chunks.resize(threads);
    parallel_for(slot_films.size(), threads, [&](std::size_t s, int) { slot_films[s].assign(size, 0); });
  }

  /// Sums the slots' films (integers: any order gives the same) into planes of rayleighs.
  void collect(int lines, int stride, Exposure& out) const {
    out.geometry = film;
    out.lines = lines;
    const std::size_t cells = out.cells();
    out.rayleigh.resize(cells * lines);
    parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
      for (std::size_t i = row * film.columns; i < (row + 1) * film.columns; ++i) {
        for (int l = 0; l < lines; ++l) {
          std::int64_t sum = 0;
          for (const auto& slot : slot_films) sum += slot[i * stride + l];
          out.rayleigh[l * cells + i] = static_cast<float>(static_cast<double>(sum) / kFilmUnitsPerRayleigh);
        }
      }
    });
  }
};

Exposer::Exposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond)
    : work_(std::make_unique<Workspace>()) {
  work_->film = film;
  work_->threads = thread_count(threads);
  for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
    const Sheet& sheet = scene.sheets[s];
    work_->stretches.push_back(stretch_of(sheet));
    work_->places.emplace_back();
    for (int layer = 0; layer < sheet.layers; ++layer)
      work_->places.back().push_back(beam_places(sheet, static_cast<std::uint32_t>(s),
                                                 static_cast<std::uint32_t>(layer), scene.seed, beyond));
    const int beams = static_cast<int>(work_->places.back().front().size());
    for (int first = 0; first < beams; first += kBeamsPerChunk)
      work_->chunks.push_back({static_cast<int>(s), first, std::min(kBeamsPerChunk, beams - first)});
  }
}

Exposer::~Exposer() = default;

void Exposer::expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
                     const std::atomic<bool>* stop) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  const std::vector<HeightProfile> profiles = w.profiles(scene);
  std::vector<KernelScene> kernels;
  for (const Sheet& sheet : scene.sheets) kernels.push_back(kernel_scene(scene, sheet, w.film, profiles));
  w.clear_slots(stride);
  std::atomic<std::uint64_t> points{0};
  std::atomic<std::size_t> done{0};
  parallel_for(w.chunks.size(), w.threads, [&](std::size_t c, int slot) {
    if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
    const Chunk& chunk = w.chunks[c];
    PackedChunk& packed = w.slot_chunks[slot];
    w.pack<double>(scene, chunk, kernels[chunk.sheet], nullptr, packed);
    points += fall_on_film(kernels[chunk.sheet], packed.groups.data(), packed.groups.size(),
                           w.slot_films[slot].data());
    const std::size_t finished = ++done;
    if (progress) progress(static_cast<double>(finished) / static_cast<double>(w.chunks.size()));
  });
  out.deflection_points = points;
  out.free = out.free_stride = 0;
  w.collect(lines, stride, out);
}

void Exposer::expose_with_derivatives(const Scene& scene, const std::vector<const double*>& free,
                                      Exposure& out) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  const std::vector<HeightProfile> profiles = w.profiles(scene);
  std::vector<KernelScene> kernels;
  for (const Sheet& sheet : scene.sheets) kernels.push_back(kernel_scene(scene, sheet, w.film, profiles));

  const int passes = std::max<int>(1, static_cast<int>((free.size() + kTangentWidth - 1) / kTangentWidth));
  out.free = static_cast<int>(free.size());
  out.free_stride = passes * kTangentWidth;
  const std::size_t cells = static_cast<std::size_t>(w.film.rows) * w.film.columns;
  out.derivative.resize(cells * lines * out.free_stride);

  const std::size_t shards = std::min<std::size_t>(kShards, std::max<std::size_t>(1, w.chunks.size()));
  for (int pass = 0; pass < passes; ++pass) {
    const std::size_t first = static_cast<std::size_t>(pass) * kTangentWidth;
    const Seeds seeds(free, first, std::min<std::size_t>(kTangentWidth, free.size() - first));
    std::vector<int> of_energy;
    for (const Sheet& sheet : scene.sheets) of_energy.push_back(seeds.parameter_at(&sheet.energy_kev));

    w.clear_slots(stride);
    std::vector<std::unique_ptr<TangentFilm>> tangents(shards);
    std::atomic<std::uint64_t> points{0};
    parallel_for(shards, w.threads, [&](std::size_t shard, int slot) {
      tangents[shard] = std::make_unique<TangentFilm>(w.film.columns, w.film.rows, lines);
      PackedChunk& packed = w.slot_chunks[slot];
      for (std::size_t c = w.chunks.size() * shard / shards; c < w.chunks.size() * (shard + 1) / shards;
           ++c) {
        const Chunk& chunk = w.chunks[c];
        const Sheet& sheet = scene.sheets[chunk.sheet];
        SharedChain shared;
        const double* at[local_inputs] = {nullptr,
                                          nullptr,
                                          &scene.field.inclination_deg,
                                          &scene.field.declination_deg,
                                          &scene.camera.azimuth_deg,
                                          &scene.camera.elevation_deg,
                                          &scene.camera.roll_deg,
                                          &scene.camera.hfov_deg,
                                          &sheet.loss_cone_deg,
                                          &sheet.pitch_step_rad};
        for (int k = 0; k < local_inputs; ++k) {
          shared.parameter_of_local[k] = at[k] != nullptr ? seeds.parameter_at(at[k]) : -1;
          if (shared.parameter_of_local[k] >= 0) shared.only_beam_inputs = false;
        }
        shared.parameter_of_energy = of_energy.data();
        w.pack<LocalDual>(scene, chunk, kernels[chunk.sheet], &seeds, packed);
        // The kernel's energy tangents are by log(E0).
        points += fall_on_film_with_tangents(kernels[chunk.sheet], shared, packed.groups.data(),
                                             packed.chains.data(), packed.groups.size(),
                                             w.slot_films[slot].data(), *tangents[shard]);
      }
    });
    out.deflection_points = points;
    w.collect(lines, stride, out);

    std::vector<float> scale(kTangentWidth, 1.0f);
    for (std::size_t s = 0; s < scene.sheets.size(); ++s)
      if (of_energy[s] >= 0) scale[of_energy[s]] = static_cast<float>(1.0 / scene.sheets[s].energy_kev);
    const std::size_t out_stride = static_cast<std::size_t>(out.free_stride);
    constexpr int kTile = TangentFilm::kTileColumns;
    parallel_for(static_cast<std::size_t>(w.film.rows), w.threads, [&](std::size_t row, int) {
      for (int column = 0; column < w.film.columns; ++column) {
        for (int l = 0; l < lines; ++l) {
          float sum[kTangentWidth] = {};
          for (std::size_t shard = 0; shard < shards; ++shard) {
            const float* tile = tangents[shard]->tile_if_any(column / kTile);
            if (tile == nullptr) continue;
            const float* cell = tile + ((row * kTile + column % kTile) * lines + l) * kTangentWidth;
            for (int i = 0; i < kTangentWidth; ++i) sum[i] += cell[i];
          }
          float* to = out.derivative.data() +
                      ((l * cells + row * w.film.columns + column) * out_stride + pass * kTangentWidth);
          for (int i = 0; i < kTangentWidth; ++i) to[i] = sum[i] * scale[i];
        }
      }
    });
  }
}

void Exposer::expose_reference(const Scene& scene, std::vector<double>& rayleigh) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  const std::vector<HeightProfile> profiles = w.profiles(scene);
  const std::size_t cells = static_cast<std::size_t>(w.film.rows) * w.film.columns;
  std::vector<double> film(cells * stride, 0.0);
  PackedChunk packed;
  for (const Chunk& chunk : w.chunks) {
    const KernelScene k = kernel_scene(scene, scene.sheets[chunk.sheet], w.film, profiles);
    w.pack<double>(scene, chunk, k, nullptr, packed);
    fall_on_film_reference(k, packed.groups.data(), packed.groups.size(), film.data());
  }
  rayleigh.resize(cells * lines);
  for (std::size_t i = 0; i < cells; ++i)
    for (int l = 0; l < lines; ++l) rayleigh[l * cells + i] = film[i * stride + l];
}

void Exposer::record_splats(const Scene& scene, SplatRecord& record) {
  Workspace& w = *work_;
  const std::vector<HeightProfile> profiles = w.profiles(scene);
  PackedChunk packed;
  for (const Chunk& chunk : w.chunks) {
    const KernelScene k = kernel_scene(scene, scene.sheets[chunk.sheet], w.film, profiles);
    w.pack<double>(scene, chunk, k, nullptr, packed);
    sim::record_splats(k, packed.groups.data(), packed.groups.size(), record);
  }
}

}  // namespace vegard::sim
