// Encodes frames on a disk as one movie file, by FFmpeg in a module (movie_writer.h).
//
// A movie is marked as spherical, so that players show it in all directions, with Google's "Spherical Video"
// metadata of version 1 (an XML text in a box of its own in the track) and version 2 (boxes st3d and sv3d in
// the description of the samples; both in https://github.com/google/spatial-media, docs). The pictures are
// unchanged.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/output/animation/movie_writer.h"

namespace vegard::apps {

/// The constant rate factor of H.264 for a quality from 1 to 100: 0.5 at 100, which no eye tells from what
/// was rendered, to 50. x264's own default, 23, leaves 57 % of the fine contrast of
/// rays; ours, 8, leaves 91 % (tests).
double rate_factor_of(int quality);
inline constexpr int kMovieQuality = 84;

/// The kind of movie that a name asks for: by .mp4 or .mov.
std::optional<MovieKind> movie_kind_of(const std::string& path);

/// Encodes RGB pictures of 8 or 16 bits, all of the same even width and height: an MP4 as H.264 if FFmpeg has
/// it, else as MPEG-4 part 2; for a path that ends in .mov as ProRes 422 HQ. Decodes the movie again to check
/// that it is complete, then moves it durably to its name; without `overwrite` it never replaces another
/// file. Returns the name of the codec, or an empty text if `stop` ended the work: nothing is left behind
/// then. The same pictures give the same bytes in every run on one machine. `all_around`: the pictures are
/// equirectangular, and an MP4 is marked so. Throws
/// Error(existing_output), Error(unwritable_output), Error(unreadable_input) for a picture.
std::string write_movie(const std::string& path, const std::vector<std::string>& pictures,
                        double frames_per_second, bool overwrite,
                        const std::function<void(double)>& progress = {},
                        const std::atomic<bool>* stop = nullptr, bool all_around = false,
                        int quality = kMovieQuality);

/// Returns the box "moov" of an MP4 file with both kinds of metadata added to its video track; `moov` begins
/// with the box's own size and type. Chunks of the file that precede the box keep their places. Throws
/// Error(unreadable_input), with the movie's name, if it is not such a box or has no video.
std::string spherical_moov(const std::string& moov, const std::string& name);

/// Adds both to the file of an equirectangular movie whose last box is "moov". Throws
/// Error(unreadable_input), Error(unwritable_output).
void mark_as_spherical(const std::string& path, const std::string& name);

}  // namespace vegard::apps
