#include "sim/render/emitters/loop_grid.h"

#include "sim/base/error.h"
#include "sim/emit/grid/grid_bricks.h"
#include "sim/emit/grid/grid_emitter.h"
#include "sim/emit/grid/grid_filter.h"
#include "sim/emit/sun/line_light.h"
#include "sim/emit/sun/strand/macro_loop.h"
#include "sim/emit/sun/strand/strand_grid.h"
#include "sim/light/emitter.h"

namespace vegard::sim {
namespace {

/// Bricks and the volume that they are drawn as.
struct LoopVolume {
  Volume volume;
  GridBricks bricks;

  LoopVolume(const Scene& scene, std::uint32_t index, double instant_s, int threads,
             std::uint64_t memory_limit = std::uint64_t{4} << 30)
      : volume(as_volume(scene, scene.loops[index])),
        bricks(bricks_of(scene, index, instant_s, threads, memory_limit)) {}

 private:
  static Volume as_volume(const Scene& scene, const Loop& loop) {
    Volume volume;
    volume.name = loop.name;
    volume.frame = VolumeFrame::sun;
    volume.density_rayleigh = line_light<double>(scene, loop.rayleigh, loop.temperature_mk, plain_number);
    return volume;
  }

  /// Every line shines by the one density.
  static GridBricks bricks_of(const Scene& scene, std::uint32_t index, double instant_s, int threads,
                              std::uint64_t memory_limit) {
    const std::vector<int> channel(scene.emission.lines.size(), 0);
    const SparseGrid grid = loop_grid(scene, index, instant_s, threads, memory_limit);
    try {
      return GridBricks(grid, channel, -1, scene.file, scene.site, scene.site);
    } catch (const Error& error) {
      throw Error(error).kind(ErrorKind::scene).key("loop." + scene.loops[index].name + ".voxel");
    }
  }
};

template <class T>
class LoopGridEmitter : public Emitter<T> {
 public:
  LoopGridEmitter(const Scene& scene, std::uint32_t index, double instant_s, const NumberAs<T>& number,
                  int threads)
      : loop_(scene, index, instant_s, threads), drawn_(loop_.bricks, loop_.volume, number, &scene.sun) {}

  void march(const RayBundle<T>& rays, const BundleLight<T>& out) const override { drawn_.march(rays, out); }
  bool is_mixed() const override { return true; }

 private:
  LoopVolume loop_;
  GridEmitter<T> drawn_;
};

class LoopGridField : public LightField {
 public:
  LoopGridField(const Scene& scene, std::uint32_t index, int threads, std::uint64_t memory_limit)
      : loop_(scene, index, scene.time.start_s, threads, memory_limit),
        field_(loop_.bricks, loop_.volume, &scene.sun),
        lines_(scene.emission.lines.size()),
        square_radius_(scene.sun.radius * scene.sun.radius) {}

  double unit_cm() const override { return field_.unit_cm(); }
  Box3 bounds() const override { return field_.bounds(); }
  bool is_dark(const Box3& box) const override { return field_.is_dark(box); }
  void sample(std::size_t count, const double* const point[3], float* const emission[],
              float* density) const override {
    field_.sample(count, point, emission, density);
    // Dark within the photosphere, as the strands themselves are.
    for (std::size_t i = 0; i < count; ++i) {
      const double x = point[0][i], y = point[1][i], z = point[2][i];
      if (!(x * x + y * y + z * z < square_radius_)) continue;
      density[i] = 0.0f;
      for (std::size_t l = 0; l < lines_; ++l) emission[l][i] = 0.0f;
    }
  }

 private:
  LoopVolume loop_;
  GridField field_;
  std::size_t lines_;
  double square_radius_;
};

}  // namespace

SparseGrid loop_grid(const Scene& scene, std::uint32_t index, double instant_s, int threads,
                     std::uint64_t memory_limit) {
  const Loop& loop = scene.loops[index];
  SparseGrid grid;
  grid.voxel = loop.voxel;
  grid.channels.push_back({"density", ""});
  const auto filter = [&](const Mask5& mask) {
    filter_grid(grid, mask, threads);
    // Each pass may add a layer of bricks on all sides.
    if (grid.bricks.size() * (SparseGrid::kVoxels * sizeof(float)) > memory_limit)
      throw Error(ErrorKind::usage, "its grid would take more than it may after blur and sharpen")
          .expected("larger voxels, or fewer passes");
  };
  try {
    add_strands(strands_of<double>(scene.sun, loop, scene.seed, plain_number, instant_s), {1.0},
                {threads, memory_limit}, grid);
    for (int pass = 0; pass < loop.blur; ++pass) filter(blur_mask());
    for (int pass = 0; pass < loop.sharpen; ++pass) filter(sharpen_mask());
  } catch (const Error& error) {
    throw Error(error).kind(ErrorKind::scene).file(scene.file).key("loop." + loop.name + ".voxel");
  }
  return grid;
}

template <class T>
std::unique_ptr<Emitter<T>> loop_grid_emitter(const Scene& scene, std::uint32_t index, double instant_s,
                                              const NumberAs<T>& number, int threads) {
  return std::make_unique<LoopGridEmitter<T>>(scene, index, instant_s, number, threads);
}

std::unique_ptr<LightField> loop_grid_field(const Scene& scene, std::uint32_t index, int threads,
                                            std::uint64_t memory_limit) {
  return std::make_unique<LoopGridField>(scene, index, threads, memory_limit);
}

template std::unique_ptr<Emitter<double>> loop_grid_emitter(const Scene&, std::uint32_t, double,
                                                            const NumberAs<double>&, int);
template std::unique_ptr<Emitter<FreeDual>> loop_grid_emitter(const Scene&, std::uint32_t, double,
                                                              const NumberAs<FreeDual>&, int);

}  // namespace vegard::sim
