// How the kinds of emitters shine: the other half of each row of the registry (sim/scene/emitters/
// emitter_kinds.h), joined to it by the name of the table.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/light/emitter.h"
#include "sim/render/emitters/volume_files.h"
#include "sim/scene/emitters/emitter_kinds.h"
#include "sim/scene/structs/scene.h"

namespace vegard::sim {

template <class T>
using Emitters = std::vector<std::unique_ptr<Emitter<T>>>;

/// What emitters are made of; they look into scene and files.
template <class T>
struct EmitterInputs {
  const Scene& scene;
  const VolumeFiles& files;
  const NumberAs<T>& number;  ///< gives the scene's numbers as T
  int threads;
};

struct FieldInputs {
  const Scene& scene;
  const VolumeFiles& files;
  int threads;
  std::uint64_t memory_limit;  ///< in bytes, of what one element takes to know where it is
};

/// Whose frame a field is in: fields of one frame can go into one grid, but a nebula's is its own alone.
enum class FieldFrame { ground, sun, nebula };

struct NamedField {
  std::string what;  ///< "volume 'arc'", for messages
  std::unique_ptr<const LightField> field;
  FieldFrame frame = FieldFrame::ground;
};

/// Voxels larger than that would miss some of it.
struct ThinPart {
  std::string what;                                         ///< "loop 'arcade'"; empty if nothing is thin
  double radius = std::numeric_limits<double>::infinity();  ///< in the unit of the field's lengths
};

struct EmitterMaker {
  std::string table;

  /// Adds the emitters of a scene in which the kind is drawn.
  void (*emitters)(const EmitterInputs<double>&, Emitters<double>&);
  void (*emitters_with_derivatives)(const EmitterInputs<FreeDual>&, Emitters<FreeDual>&);

  /// Adds the same as fields in space, for grids. Null: it has none (a surface). Throws Error(usage) where
  /// one would take more than the limit.
  void (*fields)(const FieldInputs&, std::vector<NamedField>&) = nullptr;

  /// The first element that has no field in space; its complaint's hint is left empty. Null: all have.
  std::optional<Complaint> (*why_no_field)(const Scene&) = nullptr;

  /// The thinnest of it. Null: it is as thick as it is large.
  ThinPart (*thinnest)(const Scene&) = nullptr;
};

/// In the order in which light is added up, on which the last bits of a picture depend: those that programs
/// have added come last. A kind may have two, whose emitters then stand apart.
const std::vector<EmitterMaker>& emitter_makers();

/// Adds a kind to the registry, both halves of its row, as add_emitter_kind() does. Throws std::logic_error
/// as that does, and for halves of different tables.
void add_emitter(const EmitterKind& kind, const EmitterMaker& maker);

/// The emitters of a scene. They must not outlive scene and files. T is double or FreeDual.
template <class T>
Emitters<T> make_emitters(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number,
                          int threads);

extern template Emitters<double> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<double>&,
                                               int);
extern template Emitters<FreeDual> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<FreeDual>&,
                                                 int);

/// The emitters as fields in space. They must not outlive scene and files. Throws Error(usage) for strands so
/// thin that where they are takes more than `memory_limit` bytes, of each loop, bundle or rope, and
/// Error(scene) for a loop whose own grid does.
std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads,
                                     std::uint64_t memory_limit = std::uint64_t{4} << 30);

/// Why some emitter of the scene is none in space; none if all are.
std::optional<Complaint> why_no_light_field(const Scene& scene);

/// Of all that is drawn the thinnest.
ThinPart thinnest_part(const Scene& scene);

// The built-in rows.
EmitterMaker footprint_maker();
EmitterMaker nebula_maker();
EmitterMaker volume_maker();
EmitterMaker photosphere_maker();
EmitterMaker chromosphere_maker();
EmitterMaker corona_maker();
EmitterMaker loop_maker();          ///< strand by strand, and all loops' fields
EmitterMaker gridded_loop_maker();  ///< of loops that are drawn by a grid
EmitterMaker bundle_maker();
EmitterMaker ejection_maker();

}  // namespace vegard::sim
