// The scene: all settings of what is simulated, how it is seen and how it is fitted. Data only, no behaviour;
// its parts stand in headers of their own, which code that needs no more should include.
//
// Each number that a user can set also has one row in sim/scene/rows or sim/scene/emitters, which declares
// its unit, limits and meaning. A member's unit is at the end of its name.
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "sim/scene/structs/body.h"
#include "sim/scene/structs/camera.h"
#include "sim/scene/structs/fit.h"
#include "sim/scene/structs/footprint.h"
#include "sim/scene/structs/keyframe.h"
#include "sim/scene/structs/light.h"
#include "sim/scene/structs/nebula.h"
#include "sim/scene/structs/sensor.h"
#include "sim/scene/structs/sheet.h"
#include "sim/scene/structs/site.h"
#include "sim/scene/structs/sky.h"
#include "sim/scene/structs/sun.h"
#include "sim/scene/structs/volume.h"

namespace vegard::sim {

struct Scene {
  // Defaulted in scene.cpp: here, every file that uses a scene would compile them again.
  Scene();
  Scene(const Scene& other);
  Scene(Scene&& other) noexcept;
  Scene& operator=(const Scene& other);
  Scene& operator=(Scene&& other) noexcept;
  ~Scene();

  std::uint64_t seed = 1;
  Body body;
  Site site;
  Field field;
  Camera camera;
  std::vector<Sheet> sheets;
  std::vector<Footprint> footprints;
  std::vector<Nebula> nebulae;
  std::vector<Node> nodes;
  std::vector<Volume> volumes;
  Sun sun;
  std::vector<Chromosphere> chromospheres;
  std::vector<Loop> loops;
  std::vector<Corona> coronae;
  std::vector<Bundle> bundles;
  std::vector<Ejection> ejections;
  March march;
  std::vector<OwnLine> own_lines;
  Emission emission;
  Blur blur;
  Film film;
  Sensor sensor;
  Sky sky;
  LowerAir air;
  Airglow airglow;
  Twilight twilight;
  LightPollution light_pollution;
  Stars stars;
  Moon moon;
  Ground ground;
  Composite composite;
  Time time;
  Substorm substorm;
  Fit fit;
  std::vector<Keyframe> keys;  ///< what moves (sim/scene/freedom/keyframes.h)
  /// Elements of the kinds of emitters that a program adds (sim/scene/emitters/emitter_kinds.h), by the name
  /// of their table: each a std::vector of the kind's struct.
  std::map<std::string, std::any> added;
  // No output contains the next two, and no result depends on them.
  std::string file;                  ///< the file that the scene was read from
  std::map<std::string, int> lines;  ///< line of each key in that file, by path (sim/scene/structs/line_of.h)
  /// Texts of the tables that the scene names as files, by the path of the key
  /// (sim/scene/table/table_files.h).
  std::map<std::string, std::string> tables;
};

}  // namespace vegard::sim
