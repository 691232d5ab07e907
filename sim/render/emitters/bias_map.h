// Which of the pictures that have been read a chromosphere's bias is from.
#pragma once

#include "sim/base/image.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// Null if it has none. It lives as long as `files`.
inline const Image* bias_map(const VolumeFiles& files, const Chromosphere& chromosphere) {
  const auto found = files.pictures.find(chromosphere.biasmap);
  return found == files.pictures.end() ? nullptr : &found->second;
}

}  // namespace vegard::sim
