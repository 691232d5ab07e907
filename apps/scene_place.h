// Messages about a scene's values say where in its file they stand.
#pragma once

#include "sim/base/error.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// The same error with the scene's file and the line of its key, if it is about the scene and does not have
/// them: those who work with the numbers of a scene do not know its file.
sim::Error with_place(const sim::Error& error, const sim::Scene& scene);

/// call(), with the place of what is wrong with the scene in its errors.
template <typename Call>
auto placing_errors(const sim::Scene& scene, const Call& call) {
  try {
    return call();
  } catch (const sim::Error& error) {
    throw with_place(error, scene);
  }
}

}  // namespace vegard::apps
