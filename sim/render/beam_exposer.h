// Exposes a film to a scene's beams and volumes, without any blur.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/render/exposure.h"

namespace vegard::sim {

struct SplatRecord;

class BeamExposer final : public Exposer {
 public:
  /// The arguments are those of make_exposer().
  BeamExposer(const Scene& scene, const FilmGeometry& film, int threads, double beyond = 0.0,
              const BeamSampling& sampling = {}, std::shared_ptr<const Volumes> volumes = nullptr);
  ~BeamExposer() override;

  void expose(const Scene& scene, Exposure& out, const std::function<void(double)>& progress = {},
              const std::atomic<bool>* stop = nullptr, int only_sheet = -1) override;
  void expose_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free,
                               Exposure& out) override;
  /// `line` makes no difference.
  void expose_profiles(const Scene& scene, int sheet, const std::vector<std::vector<float>>& rates,
                       Exposure& out, int line = -1) override;
  std::vector<float> split_by_age(int sheet, double wavelength_nm,
                                  const std::vector<float>& rates) const override;
  bool spreads() const override { return false; }

  /// Sets which sheets emit from now on, and whether volumes do. Initially all do.
  void set_emitting(std::vector<bool> sheets, bool volumes);

  /// Computes the light of expose() in double precision with one thread; for tests.
  void expose_reference(const Scene& scene, std::vector<double>& rayleigh);

  /// Appends the samples that one thread of expose() would add to the film, in its order
  /// (sim/render/beams/kernel.h); for benchmarks.
  void record_splats(const Scene& scene, SplatRecord& record);

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::sim
