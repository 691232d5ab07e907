// The registry of emitters: everything that emits light in a scene except its sheets, one row per kind. Code
// for all kinds iterates over these rows; docs/architecture.md explains how to add a kind.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/emitters/emitter_kind.h"

namespace vegard::sim {

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
