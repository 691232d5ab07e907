// Errors about a scene, reported with the place of what is wrong in its file.
#pragma once

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The same error with the scene's file and the line of its key, if it is about the scene and does not have
/// them: those who work with the numbers of a scene do not know its file.
Error with_place(const Error& error, const Scene& scene);

/// call(), with the place of what is wrong with the scene in its errors.
template <typename Call>
auto placing_errors(const Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const Error& error) {
    throw with_place(error, scene);
  }
}

}  // namespace vegard::sim
