// Adds the file and the line of a faulty key to an error about a scene.
#pragma once

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Returns the error with the scene's file and the line of its key added, if it is an Error(scene) that lacks
/// them: code that works with the numbers of a scene does not know its file.
Error with_place(const Error& error, const Scene& scene);

/// Returns call(). An Error that it throws passes through with_place().
template <typename Call>
auto placing_errors(const Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    throw with_place(error, scene);
  }
}

}  // namespace vegard::sim
