// The registry of emitters: whatever shines in a scene beside its sheets, one row a kind. Whoever needs to
// know of all kinds goes through these rows; docs/architecture.md says what a new kind takes.
#pragma once

#include <string>
#include <vector>

#include "sim/scene/emitters/emitter_kind.h"

namespace vegard::sim {

/// In the order of a scene file.
const std::vector<EmitterKind>& emitter_kinds();

/// The kind that has this table, as its own or as what its elements are made of; null if it is none's.
const EmitterKind* kind_of_table(const std::string& table);

/// Adds a kind after the built-in ones; its elements stand in Scene::added. It is for programs that link the
/// library, which do so before anything else (sim::add_emitter() adds both halves of a row): throws
/// std::logic_error once somebody has asked for the kinds, which never change from then on, and for a table
/// that there is.
void add_emitter_kind(const EmitterKind& kind);

/// Whether any kind is drawn, and whether any is in the scene.
bool has_drawn_emitters(const Scene& scene);
bool has_emitters(const Scene& scene);

/// Whether any goes by the scene's sheets, which are then not drawn as beams; and whether any changes with
/// the scene's clock.
bool has_emitters_of_sheets(const Scene& scene);
bool has_moving_emitters(const Scene& scene);

/// Leaves the sheets alone.
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
