// Resumes an interrupted animation: finds out which of its frames are finished.
//
// A manifest beside the frames describes the animation to which they belong. It is written before the first
// frame and never changed; a frame is written completely or not at all (sim/base/file/whole_file.h). So a
// frame that exists beside the right manifest is finished, unless it is empty: vegard does not write empty
// files, and renders that frame again.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/output/animation/animation_frames.h"
#include "apps/output/picture_file.h"
#include "sim/scene/structs/scene.h"

namespace vegard::apps {

/// Returns the manifest: the scene with all its values (independent of how its file writes them), the files
/// that it names, the frames per second, the kind of file, the version of vegard. It does not depend on the
/// range of frames, time.frames, the options of a fit or the number of threads.
std::string manifest_text(const sim::Scene& scene, double frames_per_second, const FrameNames& names,
                          const PictureOptions& picture);

/// Makes the folder and the manifest, and returns those of the wanted `frames` that are finished. Throws
/// Error(existing_output) if there are frames, or a manifest, of something else and `overwrite` is false. If
/// it is true, the wanted frames among them are removed. Other frames would later be taken for frames of this
/// animation: they are removed too if the folder belongs to a movie alone (`own_folder`), else
/// Error(existing_output) is thrown even then. It is also thrown for a manifest that vegard has not written,
/// and for frames without a manifest in a movie's own folder. Partly written files of the wanted frames, left
/// by a killed process, are removed. Throws Error(unwritable_output).
std::set<int> begin_or_resume(const FrameNames& names, const std::string& manifest,
                              const std::vector<int>& frames, bool overwrite, bool own_folder);

/// Removes what begin_or_resume() has made, if there is no frame: the manifest, and the folder if
/// begin_or_resume() made it (`made_folder`) and nothing else is in it.
void remove_beginning(const FrameNames& names, bool made_folder);

/// Removes `frames`, then the manifest if no frames are left, and then the folder if nothing else is in it.
void remove_animation(const FrameNames& names, const std::vector<int>& frames);

}  // namespace vegard::apps
