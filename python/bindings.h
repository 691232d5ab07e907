// The units of the module, each of which adds its part, and what they share.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <vector>

#include "fit/answer/fit_result.h"
#include "fit/photo/photo.h"
#include "fit/scene_cost.h"
#include "sim/scene/structs/scene.h"

namespace vegard::python {

namespace py = pybind11;

/// A scene as Python holds it: never changed in place, so that work on it can go on in another thread while
/// the interpreter puts a changed one here.
struct SceneHandle {
  std::shared_ptr<const sim::Scene> scene;
};

struct PhotoHandle {
  std::shared_ptr<const fit::Photo> photo;
};

/// A cost with all that must outlive it. One evaluation at a time, whoever asks.
struct CostHandle {
  std::shared_ptr<const sim::Scene> scene;
  std::vector<std::shared_ptr<const fit::Photo>> photos;
  std::shared_ptr<fit::SceneCost> cost;
  std::shared_ptr<std::mutex> alone;
};

/// The photographs that work on a scene is about: `given` is a PhotoHandle, a file's name, a list of
/// PhotoHandle, or None for those of the scene's [[fit.photo]]. `for_fit`: whether files are averaged as a
/// fit reads them. Throws sim::Error, py::type_error.
std::vector<std::shared_ptr<const fit::Photo>> photographs_given(const sim::Scene& scene,
                                                                 const py::object& given, bool for_fit);

/// The files that such work rests on. A scene that is no file counts by the text that would be written of it.
std::vector<fit::InputFile> inputs_of_work(const sim::Scene& scene, const std::vector<fit::Photo>& photos);

/// Throws sim::Error(usage) for an argument that is not from `min` to `max`, NaN too: the limits of the
/// option of the same name of a command.
void require_within(const char* argument, double value, double min, double max);

/// The same for a number of threads; 0 means all cores.
void require_threads(int threads);

void bind_errors(py::module_& m);
void bind_long_work(py::module_& m);
py::class_<SceneHandle> bind_scene(py::module_& m);
void bind_cameras(py::module_& m, py::class_<SceneHandle>& scene);
void bind_pictures(py::module_& m, py::class_<SceneHandle>& scene);
void bind_photographs(py::module_& m, py::class_<SceneHandle>& scene);
void bind_fits(py::module_& m, py::class_<SceneHandle>& scene);
void bind_maps(py::module_& m, py::class_<SceneHandle>& scene);
void bind_stars(py::module_& m);

}  // namespace vegard::python
