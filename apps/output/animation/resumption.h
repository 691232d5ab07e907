// Going on with an animation that was interrupted: which of its frames are finished.
//
// Beside the frames stands a manifest that says what they are frames of. It is written before the first frame
// and never changed; a frame appears whole or not at all (sim/base/file/whole_file.h). So a frame that exists
// beside the right manifest is finished, unless it is empty: that is none of ours, and made again.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/output/animation/animation_frames.h"
#include "apps/output/picture_file.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// What makes one animation another: the scene with all its values (not how its file words them), the
/// files that it names, the frames per second, the kind of file, the version of vegard. The range of
/// frames, time.frames, the options of a fit and the number of threads do not.
std::string manifest_text(const sim::Scene& scene, double frames_per_second, const FrameNames& names,
                          const PictureOptions& picture);

/// Makes the folder and the manifest, and gives those of the wanted `frames` that are finished. Throws
/// Error(existing_output) if there are frames, or a manifest, of something else and `overwrite` is false; if
/// it is true, the wanted frames among them are removed. Others of them would later be taken for frames of
/// this animation: they are removed too if the folder is a movie's own, else it throws even then. What a
/// killed process has left half written of the wanted frames is removed. Throws Error(unwritable_output).
std::set<int> begin_or_resume(const FrameNames& names, const std::string& manifest,
                              const std::vector<int>& frames, bool overwrite, bool own_folder);

/// Removes what begin_or_resume() has made, if there is no frame: the manifest, and the folder if it was made
/// and nothing else is in it.
void remove_beginning(const FrameNames& names, bool made_folder);

/// Removes `frames`; the manifest if it has no frames any more, and then the folder if nothing else is in it.
void remove_animation(const FrameNames& names, const std::vector<int>& frames);

}  // namespace vegard::apps
