#include "sim/render/beam_exposer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "sim/base/parallel.h"
#include "sim/light/sample.h"
#include "sim/light/sheet_profile.h"
#include "sim/render/beams/beams.h"
#include "sim/render/beams/kernel.h"
#include "sim/render/beams/kernel_scene.h"
#include "sim/render/beams/sheet_nodes.h"
#include "sim/view/film/panorama.h"
#include "sim/view/film/tangent_film.h"

namespace vegard::sim {
namespace {

constexpr int kShards = 8;  // of the derivatives; fixed, so that sums do not depend on the threads

/// Whether distortion is free; it may be none at present.
bool frees_distortion(const Camera& camera, const std::vector<ParameterId>& free) {
  return std::any_of(free.begin(), free.end(), [&](const ParameterId& id) {
    const int number = camera_number_of(camera, id);
    return number >= k1_number && number <= p2_number;
  });
}

/// Returns the local inputs that a number is, in some sheet.
std::set<int> local_inputs_of(const Scene& scene, const ParameterId& number) {
  std::set<int> inputs;
  for (std::size_t s = 0; s < scene.sheets.size(); ++s)
    if (const int k = local_input_of(scene, static_cast<int>(s), number); k >= 0) inputs.insert(k);
  return inputs;
}

/// Neighbours in the list of free parameters, whose derivatives one pass of the kernel computes.
struct DerivativePass {
  std::size_t first = 0, count = 0;
};

/// Returns the smallest number of passes, at least one, of which none has more than kTangentWidth parameters,
/// nor more parameters common to all beams than the kernel carries (kMaxCarried - beam_inputs,
/// sim/light/sample.h). `free` are parameters of the scene.
std::vector<DerivativePass> derivative_passes(const Scene& scene, const std::vector<ParameterId>& free) {
  constexpr std::size_t kMaxShared = kMaxCarried - beam_inputs;
  std::vector<DerivativePass> passes(1);
  std::set<int> shared;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::set<int> own = local_inputs_of(scene, free[i]);
    std::set<int> joined = shared;
    joined.insert(own.begin(), own.end());
    if (passes.back().count == kTangentWidth || joined.size() > kMaxShared) {
      passes.push_back({i, 0});
      joined = own;
    }
    ++passes.back().count;
    shared = joined;
  }
  return passes;
}

BeamLayout laid_out(Scene scene, const FilmGeometry& film, double beyond, const BeamSampling& sampling) {
  scene.seed += sampling.draw;
  if (sampling.mean)
    return BeamLayout(scene, beyond, sheet_nodes(scene, film, sampling.smooth_px, sampling.fineness));
  return BeamLayout(scene, beyond);
}

/// Which of a pass's parameters are the local inputs and the energies of each sheet.
class PassParameters {
 public:
  PassParameters(const Scene& scene, const std::vector<ParameterId>& free, const DerivativePass& pass,
                 const BeamLayout& layout, std::size_t profiles)
      : energy_parameter_(profiles, -1), chains_(scene.sheets.size()) {
    for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
      SharedChain& chain = chains_[s];
      std::fill_n(chain.parameter_of_local, local_inputs, -1);
      chain.parameter_of_energy = energy_parameter_.data();
      // The order is reversed so that the first entry counts for a number that is listed twice.
      for (std::size_t i = pass.count; i-- > 0;) {
        const ParameterId& id = free[pass.first + i];
        const int k = local_input_of(scene, static_cast<int>(s), id);
        if (k >= 0) chain.parameter_of_local[k] = static_cast<int>(i);
        if (id == parameter_with(ParameterRole::energy, static_cast<int>(s)))
          set_energy(scene, static_cast<int>(s), static_cast<int>(i), layout);
      }
    }
  }
  PassParameters(const PassParameters&) = delete;
  PassParameters& operator=(const PassParameters&) = delete;

  const SharedChain& chain(int sheet) const { return chains_[sheet]; }

  /// The factor of each parameter's derivatives: the mean over the instants; the kernel's energy tangents are
  /// by log(E0).
  std::vector<float> scale(const Scene& scene, int instants) const {
    const float mean = 1.0f / static_cast<float>(instants);
    std::vector<float> scale(kTangentWidth, mean);
    for (std::size_t s = 0; s < scene.sheets.size(); ++s)
      if (energy_parameter_[s] >= 0)
        scale[energy_parameter_[s]] = mean / static_cast<float>(scene.sheets[s].energy_kev);
    return scale;
  }

 private:
  void set_energy(const Scene& scene, int sheet, int parameter, const BeamLayout& layout) {
    energy_parameter_[sheet] = parameter;
    const bool is_ladder = profiles_of_sheet(scene, sheet).ladder.count > 0;
    for (int age = 1; !is_ladder && age < layout.ages().count(sheet); ++age)
      energy_parameter_[layout.ages().first_profile(scene, sheet, age)] = parameter;
  }

  std::vector<int> energy_parameter_;  ///< by profile, to which the chains point; -1: none
  std::vector<SharedChain> chains_;    ///< by sheet
};

}  // namespace

struct BeamExposer::Workspace {
  FilmGeometry film;
  int threads = 1;
  std::uint64_t draw = 0;
  BeamLayout layout;
  std::vector<LargeZeros<std::int64_t>> slot_films;
  std::vector<PackedChunk> slot_chunks;                // kept: their memory is large enough to cost something
  std::vector<std::unique_ptr<TangentFilm>> tangents;  // of the shares of the beams, likewise
  std::shared_ptr<const Volumes> volumes;              // if the scene has any
  std::vector<bool> shining;                           // sheets; empty: all
  bool volumes_shine = true;

  bool is_dark(const Chunk& chunk) const { return !shining.empty() && !shining[chunk.sheet]; }

  /// Returns the kernel's data of each sheet.
  std::vector<KernelScene> kernels(const Scene& scene, const std::vector<HeightProfile>& profiles) const {
    std::vector<KernelScene> all;
    for (std::size_t s = 0; s < scene.sheets.size(); ++s) {
      all.push_back(
          kernel_scene(scene, scene.sheets[s], layout.path_step(static_cast<int>(s)), film, profiles));
      all.back().seed += draw;
      all.back().nodes = layout.path_nodes(static_cast<int>(s));
    }
    return all;
  }

  /// Lets the beams of one sheet, or of all (-1), fall on the slots' films. Returns the deflection points.
  std::uint64_t fall(const Scene& scene, const std::vector<HeightProfile>& profiles, int stride,
                     int only_sheet, const std::function<void(double)>& progress = {},
                     const std::atomic<bool>* stop = nullptr) {
    const std::vector<KernelScene> sheet_kernels = kernels(scene, profiles);
    clear_slots(stride);
    std::atomic<std::uint64_t> points{0};
    std::atomic<std::size_t> done{0};
    parallel_for(layout.chunks().size(), threads, [&](std::size_t c, int slot) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
      const Chunk& chunk = layout.chunks()[c];
      if (is_dark(chunk) || (only_sheet >= 0 && chunk.sheet != only_sheet)) {
        ++done;
        return;
      }
      PackedChunk& packed = slot_chunks[slot];
      layout.pack(scene, chunk, sheet_kernels[chunk.sheet], packed);
      points += fall_on_film(sheet_kernels[chunk.sheet], packed.groups.data(), packed.groups.size(),
                             slot_films[slot].data());
      const std::size_t finished = ++done;
      if (progress) progress(static_cast<double>(finished) / static_cast<double>(layout.chunks().size()));
    });
    return points;
  }

  void clear_slots(int stride) {
    const std::size_t size = static_cast<std::size_t>(film.rows) * film.columns * stride;
    slot_films.resize(threads);
    slot_chunks.resize(threads);
    parallel_for(slot_films.size(), threads, [&](std::size_t s, int) { slot_films[s].reset(size); });
  }

  /// Adds the volumes' light to what has been collected.
  void add_volumes(const Scene& scene, Exposure& out, const std::function<void(double)>& progress = {},
                   const std::atomic<bool>* stop = nullptr, bool whole_resolution = false) const {
    out.volumes = {};
    if (!volumes || !volumes_shine) return;
    out.volumes = volumes->light(scene, film, progress, stop, whole_resolution);
    for (std::size_t i = 0; i < out.rayleigh.size(); ++i) out.rayleigh[i] += out.volumes.rayleigh[i];
  }

  /// Sums the slots' films (integers: any order gives the same) into planes of rayleighs.
  void collect(int lines, int stride, Exposure& out) const {
    out.geometry = film;
    out.lines = lines;
    const std::size_t cells = out.cells();
    out.rayleigh.resize(cells * lines);
    const double rayleighs_per_unit = 1.0 / (kFilmUnitsPerRayleigh * layout.instants());
    parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
      for (std::size_t i = row * film.columns; i < (row + 1) * film.columns; ++i) {
        for (int l = 0; l < lines; ++l) {
          std::int64_t sum = 0;
          for (const auto& slot : slot_films) sum += slot[i * stride + l];
          out.rayleigh[l * cells + i] = static_cast<float>(static_cast<double>(sum) * rayleighs_per_unit);
        }
      }
    });
    if (film.turn_columns > 0)
      parallel_for(static_cast<std::size_t>(lines), threads,
                   [&](std::size_t l, int) { close_turn(film, out.rayleigh.data() + l * cells); });
  }

  /// Lets all beams fall on the slots' films and their derivatives on the shards' tangent films. Returns the
  /// deflection points.
  std::uint64_t fall_with_tangents(const Scene& scene, const std::vector<KernelScene>& kernels,
                                   const Seeds& seeds, const PassParameters& parameters, int lines) {
    const std::vector<Chunk>& chunks = layout.chunks();
    const std::size_t shards = std::min<std::size_t>(kShards, std::max<std::size_t>(1, chunks.size()));
    tangents.resize(shards);
    std::atomic<std::uint64_t> points{0};
    parallel_for(shards, threads, [&](std::size_t shard, int slot) {
      if (tangents[shard] && tangents[shard]->lines() == lines)
        tangents[shard]->clear();
      else
        tangents[shard] = std::make_unique<TangentFilm>(film.columns, film.rows, lines);
      PackedChunk& packed = slot_chunks[slot];
      for (std::size_t c = chunks.size() * shard / shards; c < chunks.size() * (shard + 1) / shards; ++c) {
        const Chunk& chunk = chunks[c];
        if (is_dark(chunk)) continue;
        layout.pack(scene, chunk, kernels[chunk.sheet], seeds, packed);
        points += fall_on_film_with_tangents(kernels[chunk.sheet], parameters.chain(chunk.sheet),
                                             packed.groups.data(), packed.chains.data(), packed.groups.size(),
                                             slot_films[slot].data(), *tangents[shard]);
      }
    });
    return points;
  }

  /// Sums the shards' tangents of a pass whose parameters begin at `first`. The entries beyond its own
  /// parameters are zero: the next pass overwrites them, and the last one fills the row to its end.
  void collect_tangents(std::size_t first, bool is_last, const std::vector<float>& scale,
                        Exposure& out) const {
    const std::size_t cells = out.cells(), out_stride = static_cast<std::size_t>(out.free_stride);
    const int lines = out.lines;
    constexpr int kTile = TangentFilm::kTileColumns;
    // Most tiles are lit by one share alone, or by two.
    std::vector<std::vector<const float*>> lit((film.columns + kTile - 1) / kTile);
    for (std::size_t tile = 0; tile < lit.size(); ++tile)
      for (const auto& share : tangents)
        if (share->tile_if_any(static_cast<int>(tile)) != nullptr)
          lit[tile].push_back(share->tile_if_any(static_cast<int>(tile)));
    parallel_for(static_cast<std::size_t>(film.rows), threads, [&](std::size_t row, int) {
      for (int column = 0; column < film.columns; ++column) {
        const std::vector<const float*>& tiles = lit[column / kTile];
        const std::size_t in_tile = (row * kTile + column % kTile) * lines * kTangentWidth;
        float* to = out.derivative.data() + ((row * film.columns + column) * out_stride + first);
        for (int l = 0; l < lines; ++l, to += cells * out_stride) {
          float sum[kTangentWidth] = {};
          for (const float* tile : tiles) {
            const float* cell = tile + in_tile + static_cast<std::size_t>(l) * kTangentWidth;
            for (int i = 0; i < kTangentWidth; ++i) sum[i] += cell[i];
          }
          for (int i = 0; i < kTangentWidth; ++i) to[i] = sum[i] * scale[i];
          if (is_last) std::fill(to + kTangentWidth, to + (out_stride - first), 0.0f);
        }
      }
    });
  }
};

BeamExposer::BeamExposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond,
                         const BeamSampling& sampling, std::shared_ptr<const Volumes> volumes)
    : work_(new Workspace{film,
                          thread_count(threads),
                          sampling.draw + sampling.path_draw,
                          laid_out(scene, film, beyond, sampling),
                          {},
                          {},
                          {},
                          std::move(volumes),
                          {},
                          true}) {
  if (!work_->volumes && has_volumes(scene)) work_->volumes = std::make_shared<Volumes>(scene, threads);
}

BeamExposer::~BeamExposer() = default;

void BeamExposer::set_emitting(std::vector<bool> sheets, bool volumes) {
  work_->shining = std::move(sheets);
  work_->volumes_shine = volumes;
}

void BeamExposer::expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress,
                         const std::atomic<bool>* stop, int only_sheet) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  out.deflection_points = w.fall(scene, w.layout.profiles(scene), stride, only_sheet, progress, stop);
  out.free = out.free_stride = 0;
  w.collect(lines, stride, out);
  out.volumes = {};
  if (only_sheet < 0)
    w.add_volumes(scene, out, w.layout.chunks().empty() ? progress : nullptr, stop, out.one_ray);
}

void BeamExposer::expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                                          Exposure& out) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  const std::vector<HeightProfile> profiles = w.layout.profiles(scene);
  std::vector<KernelScene> kernels = w.kernels(scene, profiles);
  if (frees_distortion(scene.camera, free))
    for (KernelScene& kernel : kernels) kernel.plain_pinhole = false;

  const std::vector<DerivativePass> passes = derivative_passes(scene, free);
  out.free = static_cast<int>(free.size());
  // The last pass writes a whole register, wherever it begins.
  const std::size_t end = passes.back().first + kTangentWidth;
  out.free_stride = static_cast<int>((end + kTangentWidth - 1) / kTangentWidth * kTangentWidth);
  const std::size_t cells = static_cast<std::size_t>(w.film.rows) * w.film.columns;
  out.derivative.resize(cells * lines * out.free_stride);
  for (const DerivativePass& pass : passes) {
    const Seeds seeds(scene, free, pass.first, pass.count);
    const PassParameters parameters(scene, free, pass, w.layout, profiles.size());
    w.clear_slots(stride);
    out.deflection_points = w.fall_with_tangents(scene, kernels, seeds, parameters, lines);
    w.collect(lines, stride, out);
    w.collect_tangents(pass.first, &pass == &passes.back(), parameters.scale(scene, w.layout.instants()),
                       out);
  }
  w.add_volumes(scene, out, {}, nullptr, true);
  if (w.volumes && w.volumes_shine)
    w.volumes->add_light_derivatives(scene, w.film, free, out.free_stride, out.derivative.data());
}

void BeamExposer::expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                                  Exposure& out, int /*line*/) {
  constexpr int kLanes = 8;
  Workspace& w = *work_;
  std::vector<HeightProfile> profiles = w.layout.profiles(scene);
  const LightAges& ages = w.layout.ages();
  const int rungs = profiles_of_sheet(scene, sheet).count();
  std::vector<int> own_profiles;  // its profiles: interval by interval of age the rungs
  for (int age = 0; age < ages.count(sheet); ++age)
    for (int rung = 0; rung < rungs; ++rung)
      own_profiles.push_back(ages.first_profile(scene, sheet, age) + rung);
  const auto largest = [](const std::vector<float>& numbers) {
    float most = 0.0f;
    for (const float x : numbers) most = std::max(most, std::abs(x));
    return most;
  };
  // The rates are scaled to the sheet's own light, so that the film's integer units are as fine for them.
  float usual = 0.0f;
  for (const int own : own_profiles) usual = std::max(usual, largest(profiles[own].rate));
  if (!(usual > 0.0f)) usual = 1.0f;
  out.geometry = w.film;
  out.lines = static_cast<int>(rates.size());
  out.free = out.free_stride = 0;
  out.deflection_points = 0;
  const std::size_t cells = out.cells();
  out.rayleigh.resize(cells * rates.size());
  for (HeightProfile& each : profiles) each = HeightProfile{};
  Exposure some;
  for (std::size_t first = 0; first < rates.size(); first += kLanes) {
    const int lanes = static_cast<int>(std::min<std::size_t>(kLanes, rates.size() - first));
    const int stride = lanes <= 4 ? 4 : kLanes;
    for (HeightProfile& each : profiles) each.stride = stride;
    std::vector<float> back(lanes, 0.0f);
    for (int l = 0; l < lanes; ++l) {
      const float most = largest(rates[first + l]);
      if (most > 0.0f) back[l] = most / usual;
    }
    for (std::size_t part = 0; part < own_profiles.size(); ++part) {
      HeightProfile& profile = profiles[own_profiles[part]];
      profile.lines = lanes;
      profile.rate.assign(static_cast<std::size_t>(HeightProfile::kAltitudes) * stride, 0.0f);
      for (int l = 0; l < lanes; ++l) {
        const std::vector<float>& rate = rates[first + l];
        assert(rate.size() == static_cast<std::size_t>(HeightProfile::kAltitudes) * own_profiles.size());
        const float most = largest(rate);
        if (!(most > 0.0f)) continue;
        const float* part_rate = rate.data() + part * HeightProfile::kAltitudes;
        for (int a = 0; a < HeightProfile::kAltitudes; ++a)
          profile.rate[static_cast<std::size_t>(a) * stride + l] = part_rate[a] * (usual / most);
      }
    }
    out.deflection_points += w.fall(scene, profiles, stride, sheet);
    w.collect(lanes, stride, some);
    parallel_for(static_cast<std::size_t>(lanes), w.threads, [&](std::size_t l, int) {
      for (std::size_t i = 0; i < cells; ++i)
        out.rayleigh[(first + l) * cells + i] = some.rayleigh[l * cells + i] * back[l];
    });
  }
}

std::vector<float> BeamExposer::split_by_age(int sheet, double wavelength_nm,
                                             const std::vector<float>& rates) const {
  return work_->layout.ages().split_rates(sheet, wavelength_nm, rates);
}

void BeamExposer::expose_reference(const Scene& scene, std::vector<double>& rayleigh) {
  Workspace& w = *work_;
  const int lines = static_cast<int>(scene.emission.lines.size());
  const int stride = lines <= 4 ? 4 : 8;
  const std::vector<HeightProfile> profiles = w.layout.profiles(scene);
  const std::size_t cells = static_cast<std::size_t>(w.film.rows) * w.film.columns;
  std::vector<double> film(cells * stride, 0.0);
  const std::vector<KernelScene> kernels = w.kernels(scene, profiles);
  PackedChunk packed;
  for (const Chunk& chunk : w.layout.chunks()) {
    const KernelScene& k = kernels[chunk.sheet];
    w.layout.pack(scene, chunk, k, packed);
    fall_on_film_reference(k, packed.groups.data(), packed.groups.size(), film.data());
  }
  rayleigh.resize(cells * lines);
  for (std::size_t i = 0; i < cells; ++i)
    for (int l = 0; l < lines; ++l) rayleigh[l * cells + i] = film[i * stride + l] / w.layout.instants();
}

void BeamExposer::record_splats(const Scene& scene, SplatRecord& record) {
  Workspace& w = *work_;
  const std::vector<HeightProfile> profiles = w.layout.profiles(scene);
  const std::vector<KernelScene> kernels = w.kernels(scene, profiles);
  PackedChunk packed;
  for (const Chunk& chunk : w.layout.chunks()) {
    const KernelScene& k = kernels[chunk.sheet];
    w.layout.pack(scene, chunk, k, packed);
    sim::record_splats(k, packed.groups.data(), packed.groups.size(), record);
  }
}

}  // namespace vegard::sim
