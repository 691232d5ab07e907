// What a scene knows of a kind of emitter, as one row of the registry (sim/scene/emitters/emitter_kinds.h).
//
// How it shines is the other half of the row, sim/render/volumes/emitter_makers.h, joined to this one by the
// name of the table. Every column but the first four may be left as it is here.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// What people call a kind's light. Of `any` it is aurora, if the scene does not say otherwise.
enum class LightKind { aurora, nebula, sun, any };

/// What a kind puts on the Sun, by what turns it on itself.
enum class OnSun { nothing, alike_all_round, alike_about_axis, uneven };

/// Where light comes from, for whoever sees none.
struct LightLocation {
  enum class Known { place, direction, words, file } known;
  std::string what;                             ///< "footprint 'arc'"
  EastNorth center_km{};                        ///< of a place: a point of the observer's tangent plane
  double azimuth_deg = 0.0, elevation_deg = 0;  ///< of a direction: of its middle
  std::string words{};                          ///< else: "stands around the Earth"
};

/// A picture that light is made of.
struct PictureOfScene {
  std::string path;      ///< of its key, "footprint.arc.image"
  std::string name;      ///< of a file, as the scene has it
  bool is_cube = false;  ///< six files, one of each face (sim/scene/file/named_files.h)
};

struct EmitterKind {
  std::string table;  ///< its name, "ejection"

  /// Its elements, and then what they are made of (of nebulae the nodes). Empty for a table that a scene has
  /// once, [sun].
  std::vector<RepeatedTable> repeated;

  /// The parameters of all of its tables, in the order of a scene file.
  std::vector<Declaration> (*rows)() = nullptr;

  LightKind light = LightKind::any;

  /// That what one number of an element needs is there. Throws Error(scene) with the scene's file. Also
  /// called for scenes without such elements.
  void (*check)(const Scene&) = nullptr;

  /// Why the light does not depend on a number, or why it has no derivative; none if neither is so. It is
  /// asked for every number, of other tables too.
  std::optional<Complaint> (*why_inert)(const Scene&, const ParameterPath&) = nullptr;

  /// Whether it is there to be drawn. Null: if there is an element, and for light of the Sun the Sun too. A
  /// table that a scene has once has to say it.
  bool (*is_drawn)(const Scene&) = nullptr;

  /// Whether there is light in it at all. Null: if it is drawn.
  bool (*may_emit)(const Scene&) = nullptr;

  /// Whether it changes with the scene's clock. Null: it never does.
  bool (*moves)(const Scene&) = nullptr;

  /// Whether its light goes by the scene's sheets. Null: it never does.
  bool (*made_of_sheets)(const Scene&) = nullptr;

  /// Null: of light of the Sun uneven, if it is drawn; of other light nothing.
  OnSun (*on_sun)(const Scene&) = nullptr;

  /// Of its elements, for whoever sees none of them. Null: it has none to tell.
  std::vector<LightLocation> (*light_locations)(const Scene&) = nullptr;

  /// What it reads from pictures. Null: nothing.
  std::vector<PictureOfScene> (*pictures)(const Scene&) = nullptr;

  /// Lets a scene's elements stay where they are, seen from `home`, while the scene is another station's: a
  /// complaint if one of them cannot. Null: none can, since it stands in the observer's sky.
  std::optional<Complaint> (*stay_at)(Scene&, const Site& home) = nullptr;

  /// As people call it in a sentence, "the bright loop"; empty: as its table.
  std::string spoken{};

  /// In which order a preview offers the numbers of its first table: those of small places first, the
  /// camera's and the sheets' come seventh and eighth.
  static constexpr int kLastInPreview = 9;
  int place_in_preview = kLastInPreview;
};

/// Whether the scene has an element of it; of a table that a scene has once, whether it is drawn.
bool is_in_scene(const EmitterKind& kind, const Scene& scene);

bool is_drawn(const EmitterKind& kind, const Scene& scene);
bool may_emit(const EmitterKind& kind, const Scene& scene);
bool moves(const EmitterKind& kind, const Scene& scene);
bool is_made_of_sheets(const EmitterKind& kind, const Scene& scene);
OnSun what_is_on_sun(const EmitterKind& kind, const Scene& scene);

}  // namespace vegard::sim
