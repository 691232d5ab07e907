#include "python/arrays.h"

namespace vegard::python {

py::object image_array(std::shared_ptr<const void> owner, const sim::Image& image) {
  if (image.empty()) return py::none();
  return array_over(std::move(owner), image.data.data(), {image.height, image.width, image.channels()});
}

py::array_t<float> image_array(sim::Image&& image) {
  const std::vector<py::ssize_t> shape = {image.height, image.width, image.channels()};
  return array_of(std::move(image.data), shape);
}

std::pair<Doubles, Doubles> broadcast(const py::object& first, const py::object& second) {
  const py::list both = py::module_::import("numpy").attr("broadcast_arrays")(first, second);
  return {Doubles(py::object(both[0])), Doubles(py::object(both[1]))};
}

std::vector<py::ssize_t> shape_of(const py::array& array) {
  return {array.shape(), array.shape() + array.ndim()};
}

}  // namespace vegard::python
