// Makes the emitters of a scene. Each EmitterMaker completes a row of the registry of emitter kinds
// (sim/scene/emitters/emitter_kinds.h); the name of the table joins the two halves.
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

/// What emitters are made from; they refer to scene and files.
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
  std::uint64_t memory_limit;  ///< in bytes, for the data with which one element is located in space
};

/// Frame of a field. Fields in one frame can go into one grid, except that each nebula has a frame of its
/// own.
enum class FieldFrame { ground, sun, nebula };

struct NamedField {
  std::string what;  ///< "volume 'arc'", for messages
  std::unique_ptr<const LightField> field;
  FieldFrame frame = FieldFrame::ground;
};

/// The thinnest part of what is drawn. Voxels larger than its radius would miss some of it.
struct ThinPart {
  std::string what;                                         ///< "loop 'arcade'"; empty if nothing is thin
  double radius = std::numeric_limits<double>::infinity();  ///< in the unit of the field's lengths
};

struct EmitterMaker {
  std::string table;

  /// Adds the emitters of a scene in which the kind is drawn.
  void (*emitters)(const EmitterInputs<double>&, Emitters<double>&);
  void (*emitters_with_derivatives)(const EmitterInputs<FreeDual>&, Emitters<FreeDual>&);

  /// Adds the emitters as fields in space, for grids. Null: the kind has none (a surface). Throws
  /// Error(usage) if one would take more than the limit.
  void (*fields)(const FieldInputs&, std::vector<NamedField>&) = nullptr;

  /// Returns a complaint about the first element that has no field in space, with an empty hint. Null: all
  /// have one.
  std::optional<Complaint> (*why_no_field)(const Scene&) = nullptr;

  /// Returns the thinnest part of this kind. Null: it has no thin parts.
  ThinPart (*thinnest)(const Scene&) = nullptr;
};

/// Returns all makers, in the order in which light is added up, on which the last bits of a picture depend;
/// those added by programs come last. A kind may have two makers, whose emitters need not be neighbours.
const std::vector<EmitterMaker>& emitter_makers();

/// Adds a kind to the registry, both halves of its row. Throws std::logic_error as add_emitter_kind() does,
/// and if the halves have different tables.
void add_emitter(const EmitterKind& kind, const EmitterMaker& maker);

/// Makes the emitters of a scene. They must not outlive scene and files. T is double or FreeDual.
template <class T>
Emitters<T> make_emitters(const Scene& scene, const VolumeFiles& files, const NumberAs<T>& number,
                          int threads);

extern template Emitters<double> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<double>&,
                                               int);
extern template Emitters<FreeDual> make_emitters(const Scene&, const VolumeFiles&, const NumberAs<FreeDual>&,
                                                 int);

/// Makes the emitters as fields in space. They must not outlive scene and files. Throws Error(usage) if the
/// strands of a loop, bundle or rope are so thin that the data to locate them take more than `memory_limit`
/// bytes, and Error(scene) for a loop whose own grid does.
std::vector<NamedField> light_fields(const Scene& scene, const VolumeFiles& files, int threads,
                                     std::uint64_t memory_limit = std::uint64_t{4} << 30);

/// Returns why some emitter of the scene has no field in space; nothing if all have one.
std::optional<Complaint> why_no_light_field(const Scene& scene);

/// Returns the thinnest part of all that is drawn.
ThinPart thinnest_part(const Scene& scene);

// The built-in rows.
EmitterMaker footprint_maker();
EmitterMaker nebula_maker();
EmitterMaker volume_maker();
EmitterMaker photosphere_maker();
EmitterMaker chromosphere_maker();
EmitterMaker corona_maker();
EmitterMaker loop_maker();          ///< loops drawn strand by strand, and the fields of all loops
EmitterMaker gridded_loop_maker();  ///< loops that are drawn by a grid
EmitterMaker bundle_maker();
EmitterMaker ejection_maker();

}  // namespace vegard::sim
