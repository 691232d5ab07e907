// The registry of emitters: everything that emits light in a scene except its sheets, one row (EmitterKind)
// per kind, with all that does not need a renderer: parameters, checks, names. Code for all kinds iterates
// over these rows; docs/architecture.md explains how to add a kind.
//
// The other half of a row, how the emitter is rendered, is in sim/render/emitters/emitter_makers.h; the name
// of the table joins the two. Only the first four members must be set.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/scene/rows/declaration.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

/// The name of a kind's light in messages. `any` counts as aurora unless the scene says otherwise.
enum class LightKind { aurora, nebula, sun, any };

/// Whether a kind has objects on the Sun, and their symmetry under rotation.
enum class OnSun { nothing, alike_all_round, alike_about_axis, uneven };

/// Where light of the scene is, for a hint when the picture shows none.
struct LightLocation {
  enum class Known { place, direction, words, file } known;
  std::string what;                             ///< "footprint 'arc'"
  EastNorth center_km{};                        ///< for a place: a point of the observer's tangent plane
  double azimuth_deg = 0.0, elevation_deg = 0;  ///< for a direction: that of the middle
  std::string words{};                          ///< for words or a file: "stands around the Earth"
};

/// A picture file that an emitter reads.
struct PictureOfScene {
  std::string path;      ///< path of the key, "footprint.arc.image"
  std::string name;      ///< name of the file, as in the scene
  bool is_cube = false;  ///< six files, one for each face (sim/scene/file/named_files.h)
};

struct EmitterKind {
  std::string table;  ///< name of the kind's table, "ejection"

  /// The kind's repeated table, then those of its parts (the nodes of nebulae). Empty for a table that a
  /// scene has only once, such as [sun].
  std::vector<RepeatedTable> repeated;

  /// The parameters of all tables of the kind, in the order of a scene file.
  std::vector<Declaration> (*rows)() = nullptr;

  LightKind light = LightKind::any;

  /// Checks that the elements are complete and consistent. Throws Error(scene) with the scene's file. Also
  /// called for scenes without such elements.
  void (*check)(const Scene&) = nullptr;

  /// True if the kind is drawn. Null: if the scene has an element and, for light of the Sun, shows the Sun.
  /// Must not be null for a table that a scene has only once.
  bool (*is_drawn)(const Scene&) = nullptr;

  /// True if the kind may emit light. Null: if it is drawn.
  bool (*may_emit)(const Scene&) = nullptr;

  /// True if the kind changes with the scene's clock. Null: never.
  bool (*moves)(const Scene&) = nullptr;

  /// True if the kind's light is computed from the scene's sheets. Null: never.
  bool (*made_of_sheets)(const Scene&) = nullptr;

  /// Null: `uneven` for light of the Sun if it is drawn, else `nothing`.
  OnSun (*on_sun)(const Scene&) = nullptr;

  /// Returns where the elements are. Null: unknown.
  std::vector<LightLocation> (*light_locations)(const Scene&) = nullptr;

  /// Returns the pictures that the elements read. Null: none.
  std::vector<PictureOfScene> (*pictures)(const Scene&) = nullptr;

  /// Keeps the elements at their places, which are given in the frame of `home`, in a scene whose site is
  /// another one. Returns a complaint if that is impossible. Null: always impossible, since the kind is
  /// placed in the observer's sky.
  std::optional<Complaint> (*stay_at)(Scene&, const Site& home) = nullptr;

  /// The kind's name in a sentence, "loop" in "the bright loop"; empty: the name of the table.
  std::string spoken{};

  /// Rank of the kind's first table in the list of parameters of a preview, lowest first; the camera and the
  /// sheets have the ranks 7 and 8.
  static constexpr int kLastInPreview = 9;
  int place_in_preview = kLastInPreview;
};

/// True if the scene has an element of the kind or, for a table that a scene has only once, draws it.
bool is_in_scene(const EmitterKind& kind, const Scene& scene);

bool is_drawn(const EmitterKind& kind, const Scene& scene);
bool may_emit(const EmitterKind& kind, const Scene& scene);
bool moves(const EmitterKind& kind, const Scene& scene);
bool is_made_of_sheets(const EmitterKind& kind, const Scene& scene);
OnSun what_is_on_sun(const EmitterKind& kind, const Scene& scene);

/// Returns all kinds in the order of a scene file.
const std::vector<EmitterKind>& emitter_kinds();

/// Returns the kind that has this table, as its own or as one of its parts; null if there is none.
const EmitterKind* kind_of_table(const std::string& table);

/// Adds a kind after the built-in ones; its elements are kept in Scene::added. For programs that link the
/// library, before any other call (sim::add_emitter() adds both halves of a row). Throws std::logic_error if
/// emitter_kinds() has been called, since the list never changes after that, or if the table exists.
void add_emitter_kind(const EmitterKind& kind);

/// True if any kind is drawn (is in the scene).
bool has_drawn_emitters(const Scene& scene);
bool has_emitters(const Scene& scene);

/// True if any kind is computed from the scene's sheets, which are then not drawn as beams (if any changes
/// with the scene's clock).
bool has_emitters_of_sheets(const Scene& scene);
bool has_moving_emitters(const Scene& scene);

/// Removes all emitters and hides the Sun; keeps the sheets.
void remove_emitters(Scene& scene);

// The built-in rows.
EmitterKind footprint_kind();
EmitterKind nebula_kind();  ///< with its nodes
EmitterKind volume_kind();
EmitterKind sun_kind();  ///< the photosphere
EmitterKind chromosphere_kind();
EmitterKind loop_kind();
EmitterKind corona_kind();
EmitterKind bundle_kind();
EmitterKind ejection_kind();

}  // namespace vegard::sim
