// Converts C++ buffers to NumPy arrays without a copy, and arrays to C++.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "sim/base/image.h"

namespace vegard::python {

namespace py = pybind11;

/// Returns an array over `data` with this shape and these strides in bytes, which keeps `owner` alive. It is
/// read-only, since other objects may use the same data.
template <class T>
py::array_t<T> array_over(std::shared_ptr<const void> owner, const T* data, std::vector<py::ssize_t> shape,
                          std::vector<py::ssize_t> strides) {
  auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
  const py::capsule capsule(kept.get(),
                            [](void* at) { delete static_cast<std::shared_ptr<const void>*>(at); });
  kept.release();
  py::array_t<T> array(std::move(shape), std::move(strides), data, capsule);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Returns such an array, row-major and without gaps.
template <class T>
py::array_t<T> array_over(std::shared_ptr<const void> owner, const T* data,
                          const std::vector<py::ssize_t>& shape) {
  std::vector<py::ssize_t> strides(shape.size());
  py::ssize_t step = sizeof(T);
  for (std::size_t axis = shape.size(); axis-- > 0;) {
    strides[axis] = step;
    step *= shape[axis];
  }
  return array_over(std::move(owner), data, shape, strides);
}

/// Moves a vector into an array, which is writable.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, const std::vector<py::ssize_t>& shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = kept->data();
  const py::capsule capsule(kept.get(), [](void* at) { delete static_cast<std::vector<T>*>(at); });
  kept.release();
  return py::array_t<T>(shape, data, capsule);
}

/// Returns an array (height, width, channels) over an image that `owner` keeps alive; None if it is empty.
py::object image_array(std::shared_ptr<const void> owner, const sim::Image& image);

/// Moves an image into such an array.
py::array_t<float> image_array(sim::Image&& image);

/// An array of doubles, row-major and without gaps.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// Broadcasts two arrays to one shape by NumPy's rules.
std::pair<Doubles, Doubles> broadcast(const py::object& first, const py::object& second);

std::vector<py::ssize_t> shape_of(const py::array& array);

}  // namespace vegard::python
