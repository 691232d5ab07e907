// The kinds of frame stores (frame_store.h) beside arrays and tars, and the name of one array in a file of
// several: "FILE.mat#NAME" is the file of the frames in that array, "FILE.mat#NAME#12" one of them.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "fit/photo/frames/frame_store.h"

namespace vegard::fit {

/// Pages of a TIFF; the parameters are those of frame_store(). A TIFF whose first page is the only one of its
/// size is no file of frames, and a camera raw file never.
bool holds_tiff_pages(const std::string& name, std::string_view bytes);
std::unique_ptr<FrameStore> tiff_pages(const std::string& name, std::string_view bytes);

/// Images in several parts of a FITS file; the parameters are those of frame_store(). A FITS file with one
/// image, or with images of different sizes, is no file of frames: its first image counts.
bool holds_fits_images(const std::string& name, std::string_view bytes);
std::unique_ptr<FrameStore> fits_images(const std::string& name, std::string_view bytes);

/// Frames of a film in MP4, QuickTime, AVI, Matroska or WebM; the parameters are those of frame_store(). A
/// frame becomes a PPM or PGM whose first remark says what its numbers are (kPnmOfVideo). Its time counts
/// from that in the file's name, where the name tells its zone, else from QuickTime's creationdate; the
/// container's creation_time is no more than a clock. Frames are turned upright by the film's matrix.
bool begins_as_video(std::string_view beginning);
std::unique_ptr<FrameStore> video_frames(const std::string& name, std::string_view bytes);

/// Returns the path in the name of a file of frames: without "#NAME" if the rest is a file of arrays and the
/// whole name is no file. `array`: that NAME, empty without one.
std::string path_of_frames(const std::string& name, std::string* array = nullptr);

}  // namespace vegard::fit
