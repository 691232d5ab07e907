// The picture as a fit needs it, formed again and again: means of its light over sets of cells, at unit gain
// and without the sky, with their exact derivatives; and the means of the known light of the night sky, at
// the scene's own gain.
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
  /// Means of airglow, twilight and light pollution, which the fitted gain does not scale; empty where the
  /// scene has none.
  std::vector<double> offset;
  std::vector<double> offset_derivative;  ///< as `derivative`
};

struct PictureModelOptions {
  bool keeps_negative_light = false;  ///< false: light that is not shown is taken as 0, cell by cell
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

  /// `free`: parameters of the scene, as in Exposer, including those that change height profiles.
  void evaluate_with_derivatives(const Scene& scene, const std::vector<ParameterId>& free, PictureMeans& out);

  /// The film's cells at the last evaluation: rayleighs, one channel per line; and R, G, B at unit gain, the
  /// values that are averaged.
  const Image& rayleigh() const;
  const Image& rgb() const;

  /// Deflection points of the last evaluation.
  std::uint64_t deflection_points() const;

 private:
  struct Workspace;
  std::unique_ptr<Workspace> work_;
};

}  // namespace vegard::sim
