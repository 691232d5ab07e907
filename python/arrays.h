// Buffers of C++ as NumPy arrays, without a copy, and arrays as C++ takes them.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

#include "sim/base/image.h"

namespace vegard::python {

namespace py = pybind11;

/// An array over `data`, of that shape and strides in bytes, which keeps `owner` alive. Read-only: others may
/// look at the same numbers.
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

/// The same, row-major and without gaps.
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

/// A vector that nobody else has becomes the array's own, which may be written.
template <class T>
py::array_t<T> array_of(std::vector<T>&& values, const std::vector<py::ssize_t>& shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = kept->data();
  const py::capsule capsule(kept.get(), [](void* at) { delete static_cast<std::vector<T>*>(at); });
  kept.release();
  return py::array_t<T>(shape, data, capsule);
}

/// (height, width, channels) of an image that `owner` keeps; None if it is empty.
py::object image_array(std::shared_ptr<const void> owner, const sim::Image& image);

/// The same of an image that is the array's own.
py::array_t<float> image_array(sim::Image&& image);

/// Two arrays of doubles brought to one shape by NumPy's rules, each without gaps.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;
std::pair<Doubles, Doubles> broadcast(const py::object& first, const py::object& second);

std::vector<py::ssize_t> shape_of(const py::array& array);

}  // namespace vegard::python
