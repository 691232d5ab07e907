// A picture that is formed again and again, as a fit does, and what it asks of it: means of its light over
// sets of cells, at unit gain and without the sky, with their exact derivatives; and the means of the night
// sky's known lights, at the scene's own gain.
//
// The picture is formed as render() forms it (sim/render/picture.h), on any film.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/base/image.h"
#include "sim/render/cell_weights.h"
#include "sim/render/film.h"
#include "sim/scene/structs/scene.h"
#include "sim/scene/table/parameter_id.h"
#include "sim/view/camera/camera.h"

namespace vegard::sim {

/// Values [mean * 3 + channel]; derivatives [value index * free + parameter].
struct PictureMeans {
  std::vector<double> value;
  int free = 0;
  std::vector<double> derivative;
  /// Airglow, twilight and light pollution, which no gain scales; empty where the scene has none.
  std::vector<double> offset;
  std::vector<double> offset_derivative;  ///< as `derivative`
};

struct PictureModelOptions {
  bool keeps_negative_light = false;  ///< else what is not shown counts as none, cell by cell
  double beyond = 0.0;                ///< as Exposer
  BeamSampling sampling;              ///< likewise
  int threads = 0;                    ///< 0: all cores
};

/// Later scenes may differ from the constructor's in continuous parameters only; march.shrink is to be 1, and
/// blur.order "lines". Not for use by two threads at once.
class PictureModel {
 public:
  PictureModel(const Scene& scene, const FilmGeometry& film, CellWeights weights,
               const PictureModelOptions& options = {});
  ~PictureModel();

  void evaluate(const Scene& scene, PictureMeans& out);

  /// `free`: addresses of numbers inside `scene`, as Exposer has them, those of height profiles among them.
  void evaluate_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free, PictureMeans& out);

  /// The film's cells at the last evaluation: rayleighs, one channel per line, and R, G, B at unit gain as
  /// they are averaged.
  const Image& rayleigh() const;
  const Image& rgb() const;

  /// Deflection points of the last evaluation.
  std::uint64_t deflection_points() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::sim
