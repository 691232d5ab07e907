#include "sim/render/volumes/scene_grid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>

#include "sim/base/error.h"
#include "sim/base/grid/sparse_grid.h"
#include "sim/render/emitters/emitter_makers.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/render/volumes/point_deposit.h"
#include "sim/scene/file/volume_grid_file.h"

namespace vegard::sim {
namespace {

std::string formatted(double x, const char* format) {
  char text[32];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

/// An error about voxels that would take so many bytes. `would_do`: larger ones that will be accepted, or 0;
/// `thinnest`: the radius of the thinnest strand.
Error too_many_voxels(double bytes, const SceneGridOptions& options, double would_do, double thinnest) {
  const double limit = static_cast<double>(options.memory_limit), gb = 1024.0 * 1024.0 * 1024.0;
  const std::string part = "a --box about a part of it";
  return Error(ErrorKind::usage, "voxels of " + formatted(options.voxel, "%g") + " would take about " +
                                     formatted(bytes / gb, "%.2g") + " GB")
      .key("--memory-limit")
      .expected("at most " + formatted(limit / gb, "%.3g") + " GB")
      .hint(would_do > 0.0 ? "Voxels of " + formatted(would_do, "%g") + " would do, or " + part
            : std::isfinite(thinnest)
                ? "Choose with --of NAME, or " + part + ": larger voxels would miss strands"
                : "Choose with --of NAME, or " + part);
}

void add_relative_light(SparseGrid& grid) {
  const std::size_t lines = grid.channels.size() - 1;
  const auto light = [&](const SparseGrid::Brick& brick, int v) {
    float sum = 0.0f;
    for (std::size_t l = 0; l < lines; ++l) sum += brick[l * SparseGrid::kVoxels + v];
    return sum;
  };
  float most = 0.0f;
  for (const auto& [at, brick] : grid.bricks)
    for (int v = 0; v < SparseGrid::kVoxels; ++v) most = std::max(most, light(brick, v));
  if (most <= 0.0f) return;
  for (auto& [at, brick] : grid.bricks)
    for (int v = 0; v < SparseGrid::kVoxels; ++v)
      brick[lines * SparseGrid::kVoxels + v] = light(brick, v) / most;
}

bool any_density(const SparseGrid& grid) {
  const std::size_t first = (grid.channels.size() - 1) * SparseGrid::kVoxels;
  return std::any_of(grid.bricks.begin(), grid.bricks.end(), [&](const auto& brick) {
    return std::any_of(brick.second.begin() + first, brick.second.end(), [](float x) { return x != 0.0f; });
  });
}

/// Returns the longest side of the box around all fields, cropped.
double longest_side(const std::vector<const LightField*>& fields, const std::optional<Box3>& crop) {
  double longest = 0.0;
  for (int a = 0; a < 3; ++a) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const LightField* field : fields) {
      low = std::min(low, field->bounds().low[a]);
      high = std::max(high, field->bounds().high[a]);
    }
    if (crop) {
      low = std::max(low, crop->low[a]);
      high = std::min(high, crop->high[a]);
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

/// Rounded down to two digits.
double two_digits(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  return std::floor(x / unit * (1.0 + 1e-12)) * unit;
}

/// Rounded up to two digits.
double two_digits_up(double x) {
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1.0);
  // The number is read back from its text, so that a user who types the text gets this number.
  return std::stod(formatted(std::ceil(x / unit * (1.0 - 1e-12)) * unit, "%.2g"));
}

/// Some 300 to the longest side, and two to the radius of the thinnest strand, or one where two would be more
/// than 1200 to the side.
double usual_voxel(double side, double strand_radius) {
  constexpr double kUsual = 300.0, kManyForStrands = 1200.0;
  if (!(side > 0.0)) return SceneGridOptions::kVoxelOfBeams;
  double voxel = side / kUsual;
  if (voxel > 0.5 * strand_radius)
    voxel =
        0.5 * strand_radius * kManyForStrands >= side ? 0.5 * strand_radius : std::min(voxel, strand_radius);
  return two_digits(voxel);
}

/// The memory that a grid of a scene needs, before it is made: an upper bound, from the bricks that may be
/// lit.
class GridNeed {
 public:
  GridNeed(const Scene& scene, const std::vector<const LightField*>& fields, const SceneGridOptions& options,
           std::size_t lines)
      : scene_(scene),
        fields_(fields),
        options_(options),
        kept_(static_cast<double>(vdb_bytes_of_brick(lines + 1, true))),
        summed_(std::max(static_cast<double>(PointDeposit::bytes_of_brick(lines)), kept_)) {}

  double kept() const { return kept_; }
  double summed() const { return summed_; }
  bool stopped() const { return options_.stop != nullptr && options_.stop->load(); }

  /// Bricks of the sheets' light for each of the voxels.
  std::vector<double> bricks_of_sheets(const std::vector<double>& voxels,
                                       const std::function<void(double)>& progress) const {
    std::vector<BrickCounter> counters;
    for (const double voxel : voxels) counters.emplace_back(voxel, options_.box);
    if (!scene_.sheets.empty()) {
      PointOptions points;
      points.threads = options_.threads;
      points.progress = progress;
      points.stop = options_.stop;
      stream_points(scene_, points, [&](const EmissionPoints& some) {
        for (BrickCounter& counter : counters) counter.add(some);
      });
    }
    std::vector<double> bricks;
    for (const BrickCounter& counter : counters) bricks.push_back(counter.bricks());
    return bricks;
  }

  /// The smallest of some larger voxels that will be accepted, at most `max_voxel`; 0 if none of them is.
  double voxel_that_would_do(double bytes, double max_voxel) const {
    constexpr double kStep = 1.2, kMargin = 1.05;  // of counts, which are good to a hundredth
    constexpr int kTried = 24;
    const double limit = static_cast<double>(options_.memory_limit);
    // What is lit is a surface or less: bytes fall with the square of the voxel at most, until light fills
    // it.
    double next = options_.voxel * std::clamp(std::sqrt(bytes / limit), 1.05, 1e3);
    std::vector<double> voxels;
    for (int i = 0; i < kTried; ++i, next *= kStep) {
      const double voxel = two_digits_up(next);
      if (voxel <= max_voxel && (voxels.empty() || voxel > voxels.back())) voxels.push_back(voxel);
    }
    const std::vector<double> of_sheets = bricks_of_sheets(voxels, {});
    for (std::size_t i = 0; i < voxels.size() && !stopped(); ++i) {
      double bricks = of_sheets[i];
      if (kMargin * bricks * summed_ > limit) continue;
      SparseGrid grid;
      grid.voxel = voxels[i];
      for (const LightField* field : fields_) {
        if (kMargin * bricks * kept_ > limit) break;
        const BricksToSample listed =
            bricks_to_sample(*field, grid, options_.box, static_cast<int>(scene_.emission.lines.size()),
                             limit / kept_, limit, [&] { return !stopped(); });
        bricks += listed.too_many > 0.0 ? listed.too_many : static_cast<double>(listed.bricks.size());
      }
      if (kMargin * bricks * kept_ <= limit) return voxels[i];
    }
    return 0.0;
  }

 private:
  const Scene& scene_;
  const std::vector<const LightField*>& fields_;
  const SceneGridOptions& options_;
  double kept_, summed_;
};

SceneGrid grid_with_strands(const Scene& scene, const std::vector<const LightField*>& fields,
                            const SceneGridOptions& asked, double strand_radius) {
  SceneGridOptions options = asked;
  if (options.voxel == 0.0)
    options.voxel = scene.sheets.empty() ? usual_voxel(longest_side(fields, options.box), strand_radius)
                                         : SceneGridOptions::kVoxelOfBeams;
  SceneGrid out;
  const int all_lines = static_cast<int>(scene.emission.lines.size());
  std::vector<int> lines = options.lines;
  if (lines.empty()) {
    lines.resize(all_lines);
    std::iota(lines.begin(), lines.end(), 0);
  }
  out.grid.voxel = options.voxel;
  for (const int l : lines)
    out.grid.channels.push_back({emission_grid_name(scene.emission.lines[l]), "photons cm^-3 s^-1"});
  out.grid.channels.push_back({"density", ""});
  if (!fields.empty()) out.unit_cm = fields.front()->unit_cm();
  // A brick's memory is that of the worst of its stages: as sums, as numbers, and on its way into the file.
  const GridNeed need(scene, fields, options, lines.size());
  const auto stopped = [&] { return need.stopped(); };
  const double limit = static_cast<double>(options.memory_limit);
  const auto refuse = [&](double bytes) {
    const double would_do = need.voxel_that_would_do(bytes, strand_radius);
    if (!stopped()) throw too_many_voxels(bytes, options, would_do, strand_radius);
  };
  const double parts = (scene.sheets.empty() ? 0.0 : 2.0) + static_cast<double>(fields.size());
  double done = 0.0;
  const auto progress = [&](double share) {
    if (options.progress) options.progress((done + share) / parts);
  };
  if (!scene.sheets.empty()) {
    // Counted first, which takes next to no memory.
    const double bytes = need.bricks_of_sheets({options.voxel}, progress).front() * need.summed();
    if (!stopped() && bytes > limit) refuse(bytes);
    if (stopped()) return out;
    done += 1.0;
    constexpr double kCountedTooFew = 1.1;
    PointDeposit deposit(
        lines, options.voxel, options.box,
        static_cast<std::uint64_t>(kCountedTooFew * limit / need.summed() *
                                   static_cast<double>(PointDeposit::bytes_of_brick(lines.size()))));
    PointOptions points;
    points.threads = options.threads;
    points.progress = progress;
    points.stop = options.stop;
    stream_points(scene, points, [&](const EmissionPoints& some) { deposit.add(some); });
    if (stopped()) return out;
    if (deposit.is_full())
      refuse(static_cast<double>(deposit.bytes()) /
             static_cast<double>(PointDeposit::bytes_of_brick(lines.size())) * need.summed());
    if (stopped()) return out;
    deposit.move_to(out.grid);
    done += 1.0;
  }
  // The bricks of all fields are found before any is sampled, since sampling takes long.
  std::vector<BricksToSample> bricks_of;
  for (const LightField* field : fields) {
    bricks_of.push_back(
        bricks_to_sample(*field, out.grid, options.box, all_lines, limit / need.kept(), limit, [&] {
          progress(0.0);
          return !stopped();
        }));
    if (stopped()) return out;
    const double too_many = bricks_of.back().too_many;
    if (too_many > 0.0) refuse(std::max(too_many * need.kept(), limit));
    if (stopped()) return out;
  }
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const std::size_t before = out.grid.bricks.size();
    const auto room = [&](double share) {
      progress(share);
      return !stopped() && static_cast<double>(out.grid.bricks.size()) * need.kept() <= limit;
    };
    const double share = sample_field(*fields[f], all_lines, lines, bricks_of[f].bricks, options.box,
                                      options.threads, room, out.grid);
    if (stopped()) return out;
    const double more = static_cast<double>(out.grid.bricks.size() - before);
    if (static_cast<double>(out.grid.bricks.size()) * need.kept() > limit)
      refuse((static_cast<double>(before) + more / share) * need.kept());
    if (stopped()) return out;
    done += 1.0;
  }
  out.absorbs = any_density(out.grid);
  if (!out.absorbs) {
    add_relative_light(out.grid);
    out.grid.channels.back().unit = "of the brightest voxel";
  }
  return out;
}

}  // namespace

SceneGrid grid_of_fields(const Scene& scene, const std::vector<const LightField*>& fields,
                         const SceneGridOptions& options) {
  return grid_with_strands(scene, fields, options, std::numeric_limits<double>::infinity());
}

SceneGrid grid_of_scene(const Scene& scene, const SceneGridOptions& options) {
  if (const auto complaint = why_no_light_field(scene))
    throw Error(ErrorKind::usage, complaint->problem)
        .key("SCENE")
        .expected(complaint->expected)
        .hint("Leave it out with --of NAME");
  const ThinPart thinnest = thinnest_part(scene);
  if (options.voxel > thinnest.radius)
    throw Error(ErrorKind::usage, "strands of the " + thinnest.what + ", of radius " +
                                      formatted(thinnest.radius, "%.6g") + ", would fall between voxels of " +
                                      formatted(options.voxel, "%g"))
        .key("--voxel")
        .expected("at most their radius")
        .hint("half of it shows how they fall off; or leave it out with --of NAME");
  const VolumeFiles files = read_volume_files(scene);
  const std::vector<NamedField> named = light_fields(scene, files, options.threads, options.memory_limit);
  std::vector<const LightField*> fields;
  const auto differs = [&](FieldFrame frame) {
    return !scene.sheets.empty() || std::any_of(named.begin(), named.end(), [frame](const NamedField& other) {
      return other.frame != frame;
    });
  };
  for (const NamedField& one : named) {
    // A nebula's frame is its own, the Sun's kinds share theirs, and everything else is in kilometres.
    const bool alone = one.frame != FieldFrame::ground &&
                       (differs(one.frame) || (one.frame == FieldFrame::nebula && named.size() > 1));
    if (alone)
      throw Error(ErrorKind::usage,
                  "the " + one.what + " is in a frame of its own, and the scene has more that shines")
          .key("SCENE")
          .expected("one nebula, what is on the Sun, or light in kilometres")
          .hint("Choose with --of NAME");
    fields.push_back(one.field.get());
  }
  return grid_with_strands(scene, fields, options, thinnest.radius);
}

}  // namespace vegard::sim
